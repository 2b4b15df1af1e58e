"""The default element: membrane strains at the corners, bending in the middle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.shell.elements import corner_kernel
from foilstudy.model.shell.elements.corner_data import pack
from foilstudy.model.shell.elements.corner_relief import CornerRelief
from foilstudy.model.shell.elements.mean_strains import CornerMeanStrains
from foilstudy.model.shell.elements.sampled import SampledKernel
from foilstudy.model.shell.elements.sampling import corner
from foilstudy.model.shell.section import Section


@dataclass(frozen=True)
class Corner:
    """Corner-sampled element with a vectorised force; see `sampling.corner`.

    The checkerboard control is a share of the membrane stiffness that falls with (t/h)^2, as
    bending does, so that it never stiffens a fold more than bending itself.

    Attributes
    ----------
    stabilisation : float
        Factor on (t/h)^2.
    largest_share : float
        Bound of the share on meshes nearly as fine as the thickness.
    """

    stabilisation: float = 5.0
    largest_share: float = 0.1
    name: str = "corner"

    def share(self, section: Section) -> float:
        """The share for a section's thickness and element size."""
        size2 = section.patch.size_around * section.patch.size_along
        return min(self.stabilisation * section.thickness**2 / size2, self.largest_share)

    def kernel(self, section: Section) -> CornerKernel:
        return CornerKernel(section, self.share(section))

    def mean_strains(self, section: Section) -> CornerMeanStrains:
        return CornerMeanStrains(section, corner(self.share(section)))

    def relief(self, section: Section) -> CornerRelief:
        """What inelastic strains of some elements make of the force."""
        return self.kernel(section).relief()


class CornerKernel(SampledKernel):
    """The tangent of the general kernel, the force of the vectorised one."""

    def __init__(self, section: Section, share: float):
        super().__init__(section, corner(share))
        patch = section.patch
        self._data = pack(self._samples, section.stiffness, patch.periodic, share)
        self._spacings = (patch.size_around, patch.size_along)
        self._bend = section.thickness**2 / 12

    def force(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        return corner_kernel.internal_force(
            points, self._section.patch.elements_around, self._data, None, self._spacings,
            self._bend, out,
        )  # fmt: skip

    def relief(self) -> CornerRelief:
        """The same kernel for elements some of which have inelastic strains."""
        return CornerRelief(self._data, self._section, self._bend)
