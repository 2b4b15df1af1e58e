"""Block Krylov space of a shifted inverse, orthonormal in the mass."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg.factorisation import Factorisation

_ROOM = 384
"""Vectors for which memory is taken at once."""
_DEPENDENT = 1e-20
"""Squared length, of 1 at first, below which a direction counts as known."""
_ROUNDING = 1e-14
"""The same where what is left of dependent directions is rounding."""
_KEPT, _PASSES_MAX = 0.1, 3
"""Squared length left by an orthogonalisation that need not be repeated."""


class BlockKrylov:
    """Growing mass-orthonormal basis of the spaces spanned by (K - shift M)^-1 M.

    Blocks, because a sparse triangular solve is bound by memory: twelve right-hand sides at once
    cost a quarter of twelve single ones. Full orthogonalisation; dependent directions are dropped.

    Parameters
    ----------
    mass : csr_matrix
        Symmetric, positive definite.

    Attributes
    ----------
    size : int
        Vectors so far.
    """

    def __init__(self, mass: sparse.csr_matrix):
        self._mass = mass
        self._vectors = np.empty((mass.shape[0], _ROOM), order="F")
        self.size = 0

    @property
    def vectors(self) -> np.ndarray:
        """The basis, shape (n, size)."""
        return self._vectors[:, : self.size]

    def append(self, inverse: Factorisation, load: np.ndarray) -> np.ndarray:
        """Solve for a block of loads and add what is new in the solution.

        Returns
        -------
        ndarray, shape (n, at most the columns of the load)
            The mass times the new vectors: the load of the next block. Without columns when the
            space is exhausted.
        """
        block = inverse.solve(load)
        block /= np.sqrt(np.einsum("ij,ij->j", block, self._mass @ block))
        # most of it lies in the last two blocks: without that, one pass over all of them will do
        block = self._without(block, max(0, self.size - 2 * load.shape[1]))
        block, _ = _orthonormal(block, self._mass)
        for _ in range(_PASSES_MAX):
            block, smallest = _orthonormal(self._without(block), self._mass)
            if smallest > _KEPT:
                break
        end = self.size + block.shape[1]
        if end > self._vectors.shape[1]:
            room = np.empty_like(self._vectors)
            self._vectors = np.asfortranarray(np.hstack([self._vectors, room]))
        self._vectors[:, self.size : end] = block
        self.size = end
        return self._mass @ block

    def _without(self, block: np.ndarray, first: int = 0) -> np.ndarray:
        """The block without its part in the basis from vector `first` on."""
        known = self.vectors[:, first:]
        return block - known @ (known.T @ (self._mass @ block))


def mass_orthonormal(block: np.ndarray, mass: sparse.csr_matrix, against: np.ndarray) -> np.ndarray:
    """What is new in a block of vectors: mass-orthonormal, and orthogonal to given ones.

    Parameters
    ----------
    block : ndarray, shape (n, k)
    mass : csr_matrix
    against : ndarray, shape (n, m)
        Linearly independent.

    Returns
    -------
    ndarray, shape (n, at most k)
    """
    gram = against.T @ (mass @ against)
    lengths = np.sqrt(np.einsum("ij,ij->j", block, mass @ block))
    block = block[:, lengths > 0] / lengths[lengths > 0]
    for _ in range(2):
        if against.shape[1]:
            block = block - against @ np.linalg.solve(gram, against.T @ (mass @ block))
        block, _ = _orthonormal(block, mass, _ROUNDING)
    return block


def _orthonormal(
    block: np.ndarray, mass: sparse.csr_matrix, dependent: float = _DEPENDENT
) -> tuple[np.ndarray, float]:
    """Mass-orthonormal basis of the columns, those that are dependent left out.

    Returns also the smallest squared length of what is kept.
    """
    if not block.shape[1]:
        return block, 1.0
    values, vectors = np.linalg.eigh(block.T @ (mass @ block))
    kept = values > dependent
    return block @ (vectors[:, kept] / np.sqrt(values[kept])), values[kept].min(initial=1.0)
