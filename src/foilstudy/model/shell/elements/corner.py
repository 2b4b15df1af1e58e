"""The default element: membrane strains at the corners, bending in the middle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from foilstudy.model.shell.elements import corner_kernel
from foilstudy.model.shell.elements.sampled import SampledKernel
from foilstudy.model.shell.elements.sampling import corner

if TYPE_CHECKING:
    from foilstudy.model.shell.sheet_model import SheetModel


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

    def share(self, sheet: SheetModel) -> float:
        """The share for a sheet's thickness and element size."""
        size2 = sheet.patch.size_around * sheet.patch.size_along
        return min(self.stabilisation * sheet.thickness**2 / size2, self.largest_share)

    def kernel(self, sheet: SheetModel) -> CornerKernel:
        return CornerKernel(sheet, self.share(sheet))


class CornerKernel(SampledKernel):
    """The tangent of the general kernel, the force of the vectorised one."""

    def __init__(self, sheet: SheetModel, share: float):
        super().__init__(sheet, corner(share))
        patch = sheet.patch
        self._data = corner_kernel.pack(self._samples, sheet.law, patch.periodic)
        self._spacings = (patch.size_around, patch.size_along)
        self._factors = (sheet.thickness**2 / 12, share)

    def force(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        return corner_kernel.internal_force(
            points, self._sheet.patch.elements_around, self._data, self._spacings, self._factors,
            out,
        )  # fmt: skip
