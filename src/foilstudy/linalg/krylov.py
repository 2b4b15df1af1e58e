"""Block Krylov space of a shifted inverse, orthonormal in the mass."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg.factorisation import Factorisation

_ROOM = 384
"""Vectors for which memory is taken at once."""
_DEPENDENT = 1e-20
"""Squared length left over, relative to before, below which a direction counts as known."""


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
        for _ in range(2):
            block = block - self.vectors @ (self.vectors.T @ (self._mass @ block))
            block = _orthonormal(block, self._mass)
        end = self.size + block.shape[1]
        if end > self._vectors.shape[1]:
            room = np.empty_like(self._vectors)
            self._vectors = np.asfortranarray(np.hstack([self._vectors, room]))
        self._vectors[:, self.size : end] = block
        self.size = end
        return self._mass @ block


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
    block = block / np.sqrt(np.einsum("ij,ij->j", block, mass @ block))
    for _ in range(2):
        if against.shape[1]:
            block = block - against @ np.linalg.solve(gram, against.T @ (mass @ block))
        block = _orthonormal(block, mass)
    return block


def _orthonormal(block: np.ndarray, mass: sparse.csr_matrix) -> np.ndarray:
    """Mass-orthonormal basis of the columns, those that are dependent left out."""
    gram = block.T @ (mass @ block)
    values, vectors = np.linalg.eigh(gram)
    kept = values > max(_DEPENDENT, 1e-13 * values[-1])
    return block @ (vectors[:, kept] / np.sqrt(values[kept]))
