"""What can be followed: equilibria r(q, factor) = 0 of a potential that depends on one number."""

from __future__ import annotations

from typing import Protocol

import numpy as np
import scipy.sparse as sparse


class Equations(Protocol):
    """Conditions of equilibrium in n unknowns and a factor, of a load or of a motion."""

    def residual(self, q: np.ndarray, factor: float) -> np.ndarray:
        """Derivative of the potential by the unknowns, (n,), N; not finite out of bounds."""
        ...

    def linearised(self, q: np.ndarray, factor: float) -> tuple[sparse.csr_matrix, np.ndarray]:
        """Derivatives of the residual by the unknowns, symmetric (n, n), and by the factor (n,)."""
        ...

    def scale(self, q: np.ndarray, factor: float) -> float:
        """Norm to which that of the residual is compared, N."""
        ...

    def force(self, q: np.ndarray, factor: float) -> float:
        """What is plotted along the path: a load or a reaction, N."""
        ...
