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
from foilstudy.linalg.errors import PerturbedPivot, SolveError, refuse_not_finite
from foilstudy.linalg.pardiso import PardisoFactorisation
from foilstudy.linalg.superlu import SuperLUFactorisation
from foilstudy.linalg.updated import Updated


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
    matrix: sparse.csr_matrix | SymmetricBlocks | Updated, residual_tolerance: float = 1e-8
) -> Factorisation:
    """Factor a symmetric matrix and check it on one right-hand side.

    Parameters
    ----------
    matrix : csr_matrix, SymmetricBlocks or Updated
        Real or complex symmetric (not Hermitian), both triangles stored; or blocks of a real one
        that has to be positive definite, which take less time; or a sparse one with a term of low
        rank, of which the sparse part must be regular, too.
    residual_tolerance : float
        Largest accepted relative residual of the check, |A x - b| / (|A| |x|), scaled to a unit
        diagonal: unknowns may have units of their own, such as m and rad.

    Raises
    ------
    SolveError
        If the matrix is singular to working precision, blocks are not positive definite, or the
        check fails.
    """
    plain = matrix
    if isinstance(matrix, Updated):
        plain = matrix.sparse
        factor = UpdatedFactorisation(factorise(plain, residual_tolerance), matrix)
    elif backend() == "pardiso":
        factor = _by_pardiso(matrix)
    else:
        factor = SuperLUFactorisation(matrix)
    sizes = _sizes(plain)
    probe = sizes * np.cos(np.arange(matrix.shape[0], dtype=float))
    solution = factor.solve(probe)
    amplification = (abs(plain) @ (1 / sizes) / sizes).max() * np.abs(sizes * solution).max()
    residual = np.abs((matrix @ solution - probe) / sizes).max() / amplification
    if not (residual <= residual_tolerance and amplification <= _SINGULAR):
        raise SolveError(
            f"a {matrix.shape[0]} x {matrix.shape[0]} matrix is singular or badly scaled: relative "
            f"residual {residual:.1e}, amplification {amplification:.1e}"
        )
    return factor


def _by_pardiso(matrix: sparse.csr_matrix | SymmetricBlocks) -> Factorisation:
    """Factors of a matrix, or of it scaled to a diagonal of size one.

    Pardiso calls a pivot zero beside the largest entry of the matrix, whatever the units are: the
    rotations (N m/rad) of rings of a millimetre are so beside its forces (N/m).
    """
    try:
        return PardisoFactorisation(matrix)
    except PerturbedPivot:
        if isinstance(matrix, SymmetricBlocks):
            raise
        return ScaledFactorisation(matrix)


class ScaledFactorisation:
    """By Pardiso, of the matrix scaled to a diagonal of size one, by powers of two: exactly.

    Raises
    ------
    SolveError
        If that is singular, too.
    """

    def __init__(self, matrix: sparse.csr_matrix):
        self._scale = 2.0 ** -np.round(np.log2(_sizes(matrix)))
        outer = sparse.diags_array(self._scale)
        self._factor = PardisoFactorisation((outer @ matrix @ outer).tocsr())
        self.negative_eigenvalues = self._factor.negative_eigenvalues

    def solve(self, rhs: np.ndarray) -> np.ndarray:
        """Solve for one or several right-hand sides."""
        scale = self._scale if rhs.ndim == 1 else self._scale[:, None]
        return scale * self._factor.solve(scale * rhs)


def _sizes(matrix: sparse.csr_matrix | SymmetricBlocks) -> np.ndarray:
    """Square roots of the diagonal; of the largest entry of a row where that is zero."""
    sizes = np.abs(matrix.diagonal())
    if not sizes.all():  # of no definite matrix
        largest = abs(matrix).max(axis=1).toarray().ravel()
        sizes = np.where(sizes > 0, sizes, np.where(largest > 0, largest, 1.0))
    return np.sqrt(sizes)


class UpdatedFactorisation:
    """Of A + U W U^T, by the factors of A (Woodbury's formula).

    With G = W^-1 + U^T A^-1 U, the inverse is A^-1 - A^-1 U G^-1 U^T A^-1, and by the two ways of
    eliminating [[A, U], [U^T, -W^-1]] the sum has as many negative eigenvalues more than A as G
    has positive ones more than W.

    Parameters
    ----------
    base : Factorisation
        Of A.
    matrix : Updated

    Raises
    ------
    SolveError
        If the sum is singular.
    """

    def __init__(self, base: Factorisation, matrix: Updated):
        self._base, self._factors = base, matrix.factors
        self._solved = base.solve(matrix.factors)
        core = np.diag(1 / matrix.weights) + matrix.factors.T @ self._solved
        core = 0.5 * (core + core.T)
        refuse_not_finite(core, "the core of a term of low rank")
        self.negative_eigenvalues = None
        if base.negative_eigenvalues is not None:
            more = (np.linalg.eigvalsh(core) > 0).sum() - (matrix.weights > 0).sum()
            self.negative_eigenvalues = base.negative_eigenvalues + int(more)
        try:
            self._inverse = np.linalg.inv(core)
        except np.linalg.LinAlgError as error:
            raise SolveError("a matrix with a term of low rank is singular") from error

    def solve(self, rhs: np.ndarray) -> np.ndarray:
        """Solve for one or several right-hand sides."""
        plain = self._base.solve(rhs)
        return plain - self._solved @ (self._inverse @ (self._factors.T @ plain))
