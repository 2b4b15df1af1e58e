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
from foilstudy.linalg.blocks import SymmetricBlocks
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


_SINGULAR = 1e13
"""|A| |x| for a right-hand side of size 1, both scaled to a unit diagonal, above which a matrix
counts as singular; times 1e-16 it is the error of a solution. Sheets between rings give about the
square of element size over thickness, 1e4 in the published case; sheets without rings 9e13."""


def factorise(
    matrix: sparse.csr_matrix | SymmetricBlocks, residual_tolerance: float = 1e-8
) -> Factorisation:
    """Factor a symmetric matrix and check it on one right-hand side.

    Parameters
    ----------
    matrix : csr_matrix or SymmetricBlocks
        Real or complex symmetric (not Hermitian), both triangles stored; or blocks of a real one
        that has to be positive definite, which take less time.
    residual_tolerance : float
        Largest accepted relative residual of the check, |A x - b| / (|A| |x|), scaled to a unit
        diagonal: unknowns may have units of their own, such as m and rad.

    Raises
    ------
    SolveError
        If the matrix is singular to working precision, blocks are not positive definite, or the
        check fails.
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


def _sizes(matrix: sparse.csr_matrix | SymmetricBlocks) -> np.ndarray:
    """Square roots of the diagonal; of the largest entry of a row where that is zero."""
    sizes = np.abs(matrix.diagonal())
    if not sizes.all():  # of no definite matrix
        largest = abs(matrix).max(axis=1).toarray().ravel()
        sizes = np.where(sizes > 0, sizes, np.where(largest > 0, largest, 1.0))
    return np.sqrt(sizes)
