"""Symmetric positive definite matrices of small dense blocks."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sparse


@dataclass(frozen=True, eq=False)
class BlockPattern:
    """Where the blocks on and above the diagonal stand; every diagonal block is there.

    Attributes
    ----------
    starts : ndarray of int32, shape (block rows + 1,)
        Of each row of blocks in `columns`.
    columns : ndarray of int32
        Rising within a row, so that the diagonal comes first.
    order : ndarray of int32, shape (block rows,)
        In which the rows are eliminated.
    """

    starts: np.ndarray
    columns: np.ndarray
    order: np.ndarray

    @cached_property
    def rows(self) -> np.ndarray:
        """Row of every block."""
        return np.repeat(np.arange(len(self.starts) - 1), np.diff(self.starts))


@dataclass(frozen=True, eq=False)
class DefiniteBlocks:
    """A positive definite matrix by the blocks of its upper triangle.

    Attributes
    ----------
    pattern : BlockPattern
    values : ndarray, shape (blocks, width, width)
    """

    pattern: BlockPattern
    values: np.ndarray

    def __repr__(self) -> str:
        return f"<DefiniteBlocks: {self.shape[0]} unknowns, {len(self.values)} blocks>"

    @property
    def width(self) -> int:
        """Unknowns of a block."""
        return self.values.shape[1]

    @property
    def shape(self) -> tuple[int, int]:
        """Unknowns, twice."""
        size = self.width * (len(self.pattern.starts) - 1)
        return size, size

    def diagonal(self) -> np.ndarray:
        """Diagonal of the matrix."""
        return np.einsum("kii->ki", self.values[self.pattern.starts[:-1]]).ravel()

    def __abs__(self) -> DefiniteBlocks:
        """The same with the sizes of all numbers."""
        return DefiniteBlocks(self.pattern, np.abs(self.values))

    def __matmul__(self, vector: np.ndarray) -> np.ndarray:
        """Product with one vector."""
        pattern, width = self.pattern, self.width
        below = np.einsum("kij,ki->kj", self.values, vector.reshape(-1, width)[pattern.rows])
        below[pattern.starts[:-1]] = 0.0
        rows = len(pattern.starts) - 1
        sums = [np.bincount(pattern.columns, part, minlength=rows) for part in below.T]
        return self._upper() @ vector + np.column_stack(sums).ravel()

    def full(self) -> sparse.csr_matrix:
        """Both triangles."""
        upper = self._upper().tocsr()
        return (sparse.triu(upper) + sparse.triu(upper, 1).T).tocsr()

    def _upper(self) -> sparse.bsr_matrix:
        """With the whole blocks of the diagonal."""
        pattern = self.pattern
        return sparse.bsr_matrix((self.values, pattern.columns, pattern.starts), shape=self.shape)
