"""The elements that are compared."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.model.shell.elements import sampling
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.model.shell.elements.one_point import OnePoint
from foilstudy.model.shell.elements.protocol import Element
from foilstudy.model.shell.elements.sampled import Sampled, SampledKernel
from foilstudy.model.shell.elements.sampling import StrainSampling
from foilstudy.model.shell.section import Section


@dataclass(frozen=True)
class Variant:
    """One element by the general kernel and, where there is one, by its own.

    Attributes
    ----------
    label : str
        For figures and tables.
    family : str
        Variants of a family share a colour.
    general : Element
        By the general kernel, in which operations cost alike for all variants.
    fast : Element or None
        The same with a vectorised force.
    """

    label: str
    family: str
    general: Element
    fast: Element | None = None

    @property
    def element(self) -> Element:
        """The faster kernel if there is one."""
        return self.fast or self.general


@dataclass(frozen=True)
class _CornerSampled:
    """The default's sampling and checkerboard control, but for the treatment of bending."""

    fold: float
    bending_points: int = 1
    name: str = "corner, sampled"

    def kernel(self, section: Section) -> SampledKernel:
        share = Corner().share(section)
        return SampledKernel(section, sampling.corner(share, self.fold, self.bending_points))


def _sampled(family: str, label: str, variant: StrainSampling) -> Variant:
    return Variant(label, family, Sampled(variant))


def _one_point(chi: float) -> Variant:
    general = Sampled(sampling.one_point(chi))
    return Variant(f"one point, χ = {chi:g}", "one point", general, OnePoint(chi))


def _corner(label: str, fold: float, bending_points: int = 1, fast: Element | None = None):
    return Variant(f"corner, {label}", "corner", _CornerSampled(fold, bending_points), fast)


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
    "corner_1": _corner("fold 1 (default)", 1.0, fast=Corner()),
    "corner_1_bend_4": _corner("fold 1, 2×2 bending", 1.0, bending_points=2),
}
"""By the name that files give them, in the order of the tables."""
