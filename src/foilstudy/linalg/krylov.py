"""Block Krylov space of a shifted inverse, orthonormal in the mass."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg.errors import refuse_not_finite
from foilstudy.linalg.factorisation import Factorisation

_ROOM = 384
"""Vectors for which memory is taken at once."""
_DEPENDENT = 1e-14
"""Squared length, of 1 at first, below which a direction counts as known."""
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
        self._last: list[tuple[np.ndarray, np.ndarray]] = []
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
        heavy = self._mass @ block
        lengths = np.sqrt(np.einsum("ij,ij->j", block, heavy))
        if (lengths <= 0).any():
            block, heavy, lengths = (x[..., lengths > 0] for x in (block, heavy, lengths))
        block, heavy = block / lengths, heavy / lengths
        # most of it lies in the last two blocks: without that, one pass over all of them will do
        for known, known_heavy in self._last:
            part = known_heavy.T @ block
            block, heavy = block - known @ part, heavy - known_heavy @ part
        block, heavy, _ = _orthonormal(block, heavy)
        for _ in range(_PASSES_MAX):
            block = block - self.vectors @ (self.vectors.T @ heavy)
            block, heavy, smallest = _orthonormal(block, self._mass @ block)
            if smallest > _KEPT:
                break
        end = self.size + block.shape[1]
        if end > self._vectors.shape[1]:
            room = np.empty_like(self._vectors)
            self._vectors = np.asfortranarray(np.hstack([self._vectors, room]))
        self._vectors[:, self.size : end] = block
        self.size = end
        self._last = [*self._last[-1:], (block, heavy)]
        return heavy


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
        block, _, _ = _orthonormal(block, mass @ block)
    return block


def _orthonormal(block: np.ndarray, heavy: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Mass-orthonormal basis of the columns, those that are dependent left out.

    `heavy` is the mass times the block; returns both for the basis, and the smallest squared
    length of what is kept.
    """
    if not block.shape[1]:
        return block, heavy, 1.0
    gram = block.T @ heavy
    refuse_not_finite(gram, "a block of the Krylov space")
    values, vectors = np.linalg.eigh(gram)
    kept = values > _DEPENDENT
    turn = vectors[:, kept] / np.sqrt(values[kept])
    return block @ turn, heavy @ turn, float(values[kept].min(initial=1.0))
