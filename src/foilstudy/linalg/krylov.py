"""Block Krylov space of a shifted inverse, orthonormal in the mass."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg.errors import refuse_not_finite
from foilstudy.linalg.factorisation import Factorisation
from foilstudy.linalg.updated import Updated

_ROOM = 384
"""Vectors for which memory is taken at once."""
_DEPENDENT = 1e-14
"""Squared length, of 1 at first, below which a direction counts as known."""
_KEPT, _PASSES_MAX = 0.1, 3
"""Squared length left by an orthogonalisation that need not be repeated."""
_PAIR = 2
"""Blocks that are made orthogonal to all others at once: with 24 columns that takes little longer
than with 12, as it is bound by memory."""
_NEW = 1e-3
"""Squared length left by the last blocks, below which a block does not wait for a second one: what
may be dependent must be told at once."""
_LOST = 1e-3
"""Share of all others in a pair of blocks from which on these are treated one by one: in a space
that is nearly exhausted nothing else is left of them."""


class BlockKrylov:
    """Growing mass-orthonormal basis of the spaces spanned by (K - shift M)^-1 M.

    Blocks, because a sparse triangular solve is bound by memory: twelve right-hand sides at once
    cost a quarter of twelve single ones. Full orthogonalisation; dependent directions
    are dropped. As long as there is one shift, a block is made orthogonal to the last two at once,
    which in exact arithmetic is all that a symmetric operator needs, and every pair of blocks to
    all others, of which rounding has brought in about 1e-9 meanwhile.

    Parameters
    ----------
    mass : csr_matrix
        Symmetric, positive definite.
    known : ndarray, shape (n, m), optional
        Mass-orthonormal vectors with which the basis begins.

    Attributes
    ----------
    size : int
        Vectors so far.
    """

    def __init__(self, mass: sparse.csr_matrix, known: np.ndarray | None = None):
        self._mass = mass
        self.size = 0 if known is None else known.shape[1]
        self._vectors = np.empty((mass.shape[0], self.size + _ROOM), order="F")
        if known is not None:
            self._vectors[:, : self.size] = known
        self._settled = self.size
        self._only: Factorisation | None = None
        self._last: list[tuple[np.ndarray, np.ndarray]] = []
        self._waiting: list[tuple[np.ndarray, np.ndarray]] = []

    @property
    def vectors(self) -> np.ndarray:
        """The basis, shape (n, size)."""
        self._settle()
        return self._vectors[:, : self.size]

    def append(self, inverse: Factorisation, load: np.ndarray) -> np.ndarray:
        """Solve for a block of loads and add what is new in the solution.

        Returns
        -------
        ndarray, shape (n, at most the columns of the load)
            The mass times the new vectors: the load of the next block. Without columns when the
            space is exhausted.
        """
        if not self.size:
            self._only = inverse
        alone = inverse is self._only
        block = inverse.solve(load)
        heavy = self._mass @ block
        lengths = np.sqrt(np.einsum("ij,ij->j", block, heavy))
        if (lengths <= 0).any():
            block, heavy, lengths = (x[..., lengths > 0] for x in (block, heavy, lengths))
        block, heavy = block / lengths, heavy / lengths
        for known, known_heavy in self._last:
            part = known_heavy.T @ block
            block, heavy = block - known @ part, heavy - known_heavy @ part
        block, heavy, smallest = _orthonormal(block, heavy)
        if smallest < _NEW or not (alone and self._last):
            return self._append_at_once(block, heavy)
        self._add(block)
        self._waiting.append((block, heavy))
        self._last = [*self._last[-1:], (block, heavy)]
        if len(self._waiting) == _PAIR:
            self._settle()
        return self._last[-1][1]

    def _append_at_once(self, block: np.ndarray, heavy: np.ndarray) -> np.ndarray:
        """Make a block orthogonal to all others, and see what of it is new."""
        for _ in range(_PASSES_MAX):
            block = block - self.vectors @ (self.vectors.T @ heavy)
            block, heavy, smallest = _orthonormal(block, self._mass @ block)
            if smallest > _KEPT:
                break
        self._add(block)
        self._settled = self.size
        self._last = [*self._last[-1:], (block, heavy)]
        return heavy

    def _settle(self) -> None:
        """Make the blocks that wait orthogonal to all others."""
        if not self._waiting:
            return
        waiting, self._waiting = self._waiting, []
        widths = np.cumsum([block.shape[1] for block, _ in waiting])[:-1]
        block, heavy = (np.hstack(each) for each in zip(*waiting, strict=True))
        others = self._vectors[:, : self._settled]
        part = others.T @ heavy
        if np.abs(part).max(initial=0.0) > _LOST:
            self.size, self._last = self._settled, self._last[: -len(waiting)]
            for each in waiting:
                self._append_at_once(*each)
            return
        block = block - others @ part
        block, heavy = _straightened(block, self._mass @ block)
        self._vectors[:, self._settled : self.size] = block
        parts = zip(*(np.hsplit(each, widths) for each in (block, heavy)), strict=True)
        self._last = [*self._last, *parts][-2:]
        self._settled = self.size

    def _add(self, block: np.ndarray) -> None:
        end = self.size + block.shape[1]
        if end > self._vectors.shape[1]:
            wider = np.empty((len(self._vectors), end + _ROOM), order="F")
            wider[:, : self.size] = self._vectors[:, : self.size]
            self._vectors = wider
        self._vectors[:, self.size : end] = block
        self.size = end


def projected(
    matrix: sparse.csr_matrix | Updated, vectors: np.ndarray, known: np.ndarray
) -> np.ndarray:
    """V^T A V of a symmetric matrix, of which the part of the first vectors is known.

    Parameters
    ----------
    matrix : csr_matrix or Updated
    vectors : ndarray, shape (n, m)
    known : ndarray, shape (k, k)
        Of the first k vectors.
    """
    old = len(known)
    rows = vectors.T @ (matrix @ vectors[:, old:])
    whole = np.block([[known, rows[:old]], [rows[:old].T, rows[old:]]])
    whole[old:, old:] = 0.5 * (rows[old:] + rows[old:].T)
    return whole


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


def _straightened(block: np.ndarray, heavy: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The mass-orthonormal columns next to those of a block that nearly are, and the mass times."""
    values, vectors = np.linalg.eigh(block.T @ heavy)
    turn = (vectors / np.sqrt(values)) @ vectors.T
    return block @ turn, heavy @ turn
