"""All eigenpairs of a symmetric pencil below a limit, by shift-invert block Lanczos.

Blocks, because a sparse triangular solve is bound by memory: sixteen right-hand sides at once cost
about a fifth of sixteen single ones. No restart: with the shift inside the wanted range about twice
as many vectors as modes are enough.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse
from scipy.linalg import cholesky, eigh, solve_triangular
from scipy.sparse.linalg import ArpackError, LinearOperator, eigsh

from foilstudy.linalg.errors import SolveError, refuse_not_finite
from foilstudy.linalg.factorisation import Factorisation, factorise
from foilstudy.linalg.updated import Updated, combined

_BLOCK = 16
_SHIFT = 0.45
"""Shift relative to the limit; the middle of the range converges fastest from both sides."""
_TOLERANCE = 1e-6
"""Residual of a mode relative to its eigenvalue of the shifted inverse."""
MODES_MAX = 3000
"""Sought at most: that many take about ten minutes at ten thousand unknowns."""
_LARGEST_TOLERANCE = 1e-3
_NUDGES = 1.0, 1 + 1e-6, 1 - 1e-6
"""Factors on a shift; at an eigenvalue nothing can be factored."""


class TooManyModes(SolveError):
    """More modes lie below a limit than are sought."""


@dataclass(frozen=True)
class Modes:
    """Eigenvalues (rad2/s2), ascending, and mass-normalised shapes, (n, number of modes)."""

    eigenvalues: np.ndarray
    shapes: np.ndarray


def shifted(
    stiffness: sparse.csr_matrix, mass: sparse.csr_matrix, shift: float
) -> tuple[Factorisation, float]:
    """K - shift M factored, and the shift: moved by a millionth where it is an eigenvalue.

    Raises
    ------
    SolveError
        If the matrix is singular there, too.
    """
    for nudge in _NUDGES:
        try:
            return factorise(combined(1.0, stiffness, -nudge * shift, mass)), nudge * shift
        except SolveError as error:
            problem = error
    raise problem


def modes_below(
    stiffness: sparse.csr_matrix, mass: sparse.csr_matrix, limit: float, most: int = MODES_MAX
) -> Modes:
    """All modes of K x = lambda M x with lambda below a positive limit.

    Their number is known beforehand from the inertia of K - limit M, so none is missed.

    Parameters
    ----------
    stiffness, mass : csr_matrix
        Symmetric, the stiffness positive semidefinite, the mass positive definite.
    limit : float
        rad2/s2.
    most : int
        Modes that are sought at most.

    Raises
    ------
    TooManyModes
        If there are more.
    SolveError
        If a factorisation fails or the modes do not converge.
    """
    factor, limit = shifted(stiffness, mass, limit)
    count, size = factor.negative_eigenvalues, stiffness.shape[0]
    del factor
    if count > most:
        raise TooManyModes(
            f"{count} modes lie below {np.sqrt(limit) / (2 * np.pi):.4g} Hz, of which at most "
            f"{most} are sought; lower the cut-off or the highest frequency, or use "
            "rational_krylov, which needs no modes"
        )
    if count == 0:
        return Modes(np.empty(0), np.empty((size, 0)))
    if 4 * count > size:  # a Krylov space that finds them would nearly fill the whole
        values, shapes = eigh(stiffness.toarray(), mass.toarray(), subset_by_index=(0, count - 1))
        return Modes(values, shapes)
    shift = _SHIFT * limit
    capacity = _BLOCK * min(size // _BLOCK, (4 * count) // _BLOCK + 20)
    factor, shift = shifted(stiffness, mass, shift)
    basis = _LanczosBasis(factor, mass, capacity)
    found = np.zeros(0, dtype=bool)
    while basis.size < capacity:
        basis.grow()
        if basis.size < 1.5 * count:
            continue
        inverse, vectors, residual = basis.ritz_pairs()
        eigenvalues = shift + 1 / inverse
        found = (eigenvalues < limit) & (residual < _TOLERANCE * np.abs(inverse))
        if found.sum() == count:
            order = np.flatnonzero(found)[np.argsort(eigenvalues[found])]
            return Modes(eigenvalues[order], basis.combine(vectors[:, order]))
    raise SolveError(
        f"{count} modes lie below the limit, but {found.sum()} converged in a Krylov space of "
        f"{capacity} vectors"
    )


def lowest_modes(
    stiffness: sparse.csr_matrix, mass: sparse.csr_matrix, inverse: Factorisation, count: int
) -> Modes:
    """The first modes of K x = lambda M x, with K factored already.

    Parameters
    ----------
    stiffness, mass : csr_matrix
        Symmetric, positive definite.
    inverse : Factorisation
        Of the stiffness.
    count : int

    Raises
    ------
    SolveError
        If they do not converge.
    """
    for matrix, what in ((stiffness, "the stiffness"), (mass, "the mass")):
        refuse_not_finite(matrix.data, what)
    size = stiffness.shape[0]
    if 4 * count > size:
        return Modes(
            *eigh(stiffness.toarray(), mass.toarray(), subset_by_index=(0, min(count, size) - 1))
        )
    try:
        values, shapes = eigsh(
            _operator(stiffness),
            count,
            _operator(mass),
            sigma=0.0,
            OPinv=LinearOperator((size, size), matvec=inverse.solve, dtype=float),
            v0=np.cos(np.arange(size, dtype=float)),  # any start will do; a fixed one: same bits
        )
    except ArpackError as error:
        raise SolveError(f"the first {count} modes did not converge: {error}") from error
    order = np.argsort(values)
    return Modes(values[order], shapes[:, order])


def _operator(matrix: sparse.csr_matrix | Updated) -> sparse.csr_matrix | LinearOperator:
    """As ARPACK takes it."""
    if isinstance(matrix, Updated):
        return LinearOperator(matrix.shape, matvec=matrix.__matmul__, dtype=float)
    return matrix


def largest_eigenvalue(stiffness: sparse.csr_matrix, mass: sparse.csr_matrix) -> float:
    """The largest lambda of K x = lambda M x, to a thousandth.

    Parameters
    ----------
    stiffness, mass : csr_matrix
        Symmetric, the mass positive definite.

    Raises
    ------
    SolveError
        If the mass cannot be factored or the eigenvalue does not converge.
    """
    for matrix, what in ((stiffness, "the stiffness"), (mass, "the mass")):
        refuse_not_finite(matrix.data, what)
    size = stiffness.shape[0]
    try:
        values = eigsh(
            stiffness,
            1,
            mass,
            Minv=LinearOperator((size, size), matvec=factorise(mass).solve, dtype=float),
            tol=_LARGEST_TOLERANCE,  # short waves lie close together: a tighter one takes long
            v0=np.cos(np.arange(size, dtype=float)),
            return_eigenvectors=False,
        )
    except ArpackError as error:
        raise SolveError(f"the largest eigenvalue did not converge: {error}") from error
    return float(values[0])


class _LanczosBasis:
    """Mass-orthonormal block Krylov basis of (K - shift M)^-1 M, fully orthogonalised."""

    def __init__(self, inverse: Factorisation, mass: sparse.csr_matrix, capacity: int):
        self._inverse, self._mass = inverse, mass
        rows = mass.shape[0]
        self._vectors = np.empty((rows, capacity), order="F")
        self._carried = np.empty((rows, capacity), order="F")  # mass times the vectors
        self._projected = np.zeros((capacity, capacity))
        rng = np.random.default_rng(0)  # any start will do; a fixed one gives the same bits
        start = rng.standard_normal((rows, _BLOCK))
        self._next, self._next_carried, self._link = self._orthonormalise(inverse.solve(start))
        self.size = 0

    def grow(self) -> None:
        """Add one block."""
        block = slice(self.size, self.size + _BLOCK)
        self._vectors[:, block] = self._next
        self._carried[:, block] = self._next_carried
        self.size += _BLOCK
        image = self._inverse.solve(self._next_carried)
        part = self._carried[:, : self.size].T @ image
        image -= self._vectors[:, : self.size] @ part
        self._projected[: self.size, block] = part
        self._next, self._next_carried, self._link = self._orthonormalise(image)

    def _orthonormalise(self, block: np.ndarray):
        """Mass-orthonormal columns, their mass products and the triangular factor."""
        total = np.eye(block.shape[1])
        for _ in range(2):
            try:
                factor = self._triangle(block)
            except np.linalg.LinAlgError:  # columns nearly alike, more than their products can tell
                block, apart = np.linalg.qr(block)
                total = apart @ total
                try:
                    factor = self._triangle(block)
                except np.linalg.LinAlgError as error:
                    raise SolveError(
                        "the mode search broke down, as that of a foil too thin for its mesh; use "
                        "a finer mesh or a thicker foil"
                    ) from error
            block = solve_triangular(factor, block.T, trans="T").T
            total = factor @ total
        return block, self._mass @ block, total

    def _triangle(self, block: np.ndarray) -> np.ndarray:
        """Cholesky factor of the products of the columns by mass."""
        gram = block.T @ (self._mass @ block)
        refuse_not_finite(gram, "the Krylov space of the mode search")
        return cholesky(0.5 * (gram + gram.T), lower=False)

    def ritz_pairs(self):
        """Ritz values, their coordinates in the basis, and residual norms."""
        values, vectors = eigh(self._projected[: self.size, : self.size], lower=False)
        residual = np.linalg.norm(self._link @ vectors[-_BLOCK:], axis=0)
        return values, vectors, residual

    def combine(self, coordinates: np.ndarray) -> np.ndarray:
        """Vectors with the given coordinates in the basis."""
        return self._vectors[:, : self.size] @ coordinates
