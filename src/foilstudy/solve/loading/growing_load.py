"""A loaded sheet as equations of its unknowns and its load factor, for `solve.continuation`."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.solve.loading.loaded_sheet import LoadedSheet
from foilstudy.solve.residual import least_scale


class GrowingLoad:
    """Equilibria of a sheet under any multiple of its load.

    Parameters
    ----------
    loaded : LoadedSheet
        Its own factor does not matter.
    residual_tolerance : float
        To which the equilibria will be asked for: the scale of residuals is never so small that
        rounding alone would exceed it.

    Attributes
    ----------
    loaded : LoadedSheet
    """

    def __init__(self, loaded: LoadedSheet, residual_tolerance: float = 1e-8):
        self.loaded = loaded
        self._floor = least_scale(loaded.sheet, residual_tolerance)

    def residual(self, q: np.ndarray, factor: float) -> np.ndarray:
        """See `Equations`."""
        return self.loaded.at(factor).value_and_gradient(q)[1]

    def linearised(self, q: np.ndarray, factor: float) -> tuple[sparse.csr_matrix, np.ndarray]:
        """See `Equations`."""
        loaded = self.loaded
        _, force = loaded.load.work_and_force(loaded.points(q))
        return loaded.at(factor).hessian(q), -loaded.constraints.reduced(force)

    def scale(self, q: np.ndarray, factor: float) -> float:
        """Norm of the internal forces, N, or of what lets rounding pass."""
        return max(self.loaded.internal_force_size(q), self._floor)

    def force(self, q: np.ndarray, factor: float) -> float:
        """The load factor itself."""
        return factor
