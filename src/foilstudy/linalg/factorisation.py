"""Symmetric factorisation with solve, inertia and residual check.

MKL Pardiso where it is installed (x86-64), otherwise SciPy's SuperLU, which is slower and finds
the inertia from its U factor.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Protocol

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg import pardiso
from foilstudy.linalg.errors import SolveError
from foilstudy.linalg.pardiso import PardisoFactorisation
from foilstudy.linalg.superlu import SuperLUFactorisation


class Factorisation(Protocol):
    """A factored symmetric matrix."""

    negative_eigenvalues: int | None
    """None for a complex matrix."""

    def solve(self, rhs: np.ndarray) -> np.ndarray:
        """Solve for one or several right-hand sides, shape (n,) or (n, k)."""
        ...


@lru_cache(maxsize=1)
def backend() -> str:
    """Name of the solver in use: ``pardiso`` or ``superlu``."""
    return "pardiso" if pardiso.available() else "superlu"


_SINGULAR = 1e12
"""|A| |x| for a right-hand side of size 1, both scaled to a unit diagonal, above which a matrix
counts as singular. Sheets between rings give up to 1e4, sheets without rings 1e15."""


def factorise(matrix: sparse.csr_matrix, residual_tolerance: float = 1e-8) -> Factorisation:
    """Factor a symmetric matrix and check it on one right-hand side.

    Parameters
    ----------
    matrix : csr_matrix
        Real or complex symmetric (not Hermitian), both triangles stored.
    residual_tolerance : float
        Largest accepted relative residual of the check, |A x - b| / (|A| |x|), scaled to a unit
        diagonal: unknowns may have units of their own, such as m and rad.

    Raises
    ------
    SolveError
        If the matrix is singular to working precision or the check fails.
    """
    if backend() == "pardiso":
        factor = PardisoFactorisation(matrix)
    else:
        factor = SuperLUFactorisation(matrix)
    sizes = _sizes(matrix)
    probe = sizes * np.cos(np.arange(matrix.shape[0], dtype=float))
    solution = factor.solve(probe)
    amplification = (abs(matrix) @ (1 / sizes) / sizes).max() * np.abs(sizes * solution).max()
    residual = np.abs((matrix @ solution - probe) / sizes).max() / amplification
    if not (residual <= residual_tolerance and amplification <= _SINGULAR):
        raise SolveError(
            f"a {matrix.shape[0]} x {matrix.shape[0]} matrix is singular or badly scaled: relative "
            f"residual {residual:.1e}, amplification {amplification:.1e}"
        )
    return factor


def _sizes(matrix: sparse.csr_matrix) -> np.ndarray:
    """Square roots of the diagonal; of the largest entry of a row where that is zero."""
    sizes = np.abs(matrix.diagonal())
    if not sizes.all():
        largest = abs(matrix).max(axis=1).toarray().ravel()
        sizes = np.where(sizes > 0, sizes, np.where(largest > 0, largest, 1.0))
    return np.sqrt(sizes)
