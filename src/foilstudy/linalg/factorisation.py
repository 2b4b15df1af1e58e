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

    negative_eigenvalues: int

    def solve(self, rhs: np.ndarray) -> np.ndarray:
        """Solve for one or several right-hand sides, shape (n,) or (n, k)."""
        ...


@lru_cache(maxsize=1)
def backend() -> str:
    """Name of the solver in use: ``pardiso`` or ``superlu``."""
    return "pardiso" if pardiso.available() else "superlu"


def factorise(matrix: sparse.csr_matrix, residual_tolerance: float = 1e-8) -> Factorisation:
    """Factor a symmetric matrix and check it on one right-hand side.

    Parameters
    ----------
    matrix : csr_matrix
        Symmetric, both triangles stored.
    residual_tolerance : float
        Largest accepted relative residual of the check, |A x - b| / (|A| |x|).

    Raises
    ------
    SolveError
        If the matrix is singular to working precision or the check fails.
    """
    if backend() == "pardiso":
        factor = PardisoFactorisation(matrix)
    else:
        factor = SuperLUFactorisation(matrix)
    probe = np.cos(np.arange(matrix.shape[0], dtype=float))
    solution = factor.solve(probe)
    scale = abs(matrix).sum(axis=1).max() * np.abs(solution).max()
    residual = np.abs(matrix @ solution - probe).max() / scale
    if not residual <= residual_tolerance:
        raise SolveError(
            f"the factorisation of a {matrix.shape[0]} x {matrix.shape[0]} matrix has a relative "
            f"residual of {residual:.1e}; the matrix is singular or badly scaled"
        )
    return factor
