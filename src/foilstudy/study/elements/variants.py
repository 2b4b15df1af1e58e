"""The elements that are compared; cheap to import."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.model.shell.elements import sampling
from foilstudy.study.kernel.plan import Lazy


@dataclass(frozen=True)
class Variant:
    """One element by the general kernel and, where there is one, by its own.

    Attributes
    ----------
    label : str
        For figures and tables.
    family : str
        Variants of a family share a colour.
    general_kernel : Lazy
        Makes the element by the general kernel, in which operations cost alike for all variants.
    own_kernel : Lazy or None
        Makes the same with a vectorised force.
    """

    label: str
    family: str
    general_kernel: Lazy
    own_kernel: Lazy | None = None

    @property
    def element(self):
        """With the faster kernel if there is one."""
        return (self.own_kernel or self.general_kernel)()


_ELEMENTS = "foilstudy.model.shell.elements"


def _sampled(
    family: str, label: str, variant: sampling.StrainSampling, own: Lazy | None = None
) -> Variant:
    return Variant(label, family, Lazy(f"{_ELEMENTS}.sampled:Sampled", (variant,)), own)


def _one_point(chi: float) -> Variant:
    own = Lazy(f"{_ELEMENTS}.one_point:OnePoint", (chi,))
    return _sampled("one point", f"one point, χ = {chi:g}", sampling.one_point(chi), own)


def _corner(label: str, fold: float, bending_points: int = 1, own: Lazy | None = None) -> Variant:
    general = Lazy("foilstudy.study.elements.corner:CornerSampled", (fold, bending_points))
    return Variant(f"corner, {label}", "corner", general, own)


_DEFAULT = Lazy(f"{_ELEMENTS}.corner:Corner")

VARIANTS: dict[str, Variant] = {
    "one_point_0p01": _one_point(0.01),
    "one_point_0p05": _one_point(0.05),
    "one_point_0p2": _one_point(0.2),
    "one_point_1": _one_point(1.0),
    "gauss_2": _sampled("Gauss", "Gauss 2×2", sampling.gauss(2)),
    "gauss_3": _sampled("Gauss", "Gauss 3×3", sampling.gauss(3)),
    "patch_wise": _sampled("patch-wise", "patch-wise", sampling.patch_wise()),
    "cas_0": _sampled("CAS", "CAS, fold 0", sampling.continuous_assumed_strain(0.0)),
    "cas_1": _sampled("CAS", "CAS, fold 1", sampling.continuous_assumed_strain(1.0)),
    "staggered_0": _sampled("staggered", "staggered, fold 0", sampling.staggered(0.0)),
    "staggered_third": _sampled("staggered", "staggered, fold 1/3", sampling.staggered(1 / 3)),
    "staggered_1": _sampled("staggered", "staggered, fold 1", sampling.staggered(1.0)),
    "corner_0": _corner("fold 0", 0.0),
    "corner_half": _corner("fold 1/2", 0.5),
    "corner_1": _corner("fold 1 (default)", 1.0, own=_DEFAULT),
    "corner_1_bend_4": _corner("fold 1, 2×2 bending", 1.0, bending_points=2),
}
"""By the name that files give them, in the order of the tables."""
