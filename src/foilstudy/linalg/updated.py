"""A sparse matrix and a symmetric term of low rank, kept apart."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse


@dataclass(frozen=True, eq=False)
class Updated:
    """S + U diag(w) U^T, symmetric.

    Attributes
    ----------
    sparse : csr_matrix
        S.
    factors : ndarray, shape (n, r)
        U, of many fewer columns than rows.
    weights : ndarray, shape (r,)
        w, of any sign, none zero.
    """

    sparse: sparse.csr_matrix
    factors: np.ndarray
    weights: np.ndarray

    def __repr__(self) -> str:
        return f"<Updated: {self.shape[0]} unknowns, and a term of rank {self.weights.size}>"

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.sparse.shape

    @property
    def data(self) -> np.ndarray:
        """All numbers that it is made of."""
        return np.concatenate([self.sparse.data, self.factors.ravel(), self.weights])

    def __matmul__(self, block: np.ndarray) -> np.ndarray:
        inner = self.weights * (self.factors.T @ block).T
        return self.sparse @ block + self.factors @ inner.T

    def toarray(self) -> np.ndarray:
        """Dense."""
        return self.sparse.toarray() + (self.factors * self.weights) @ self.factors.T


def updated(
    matrix: sparse.csr_matrix | Updated, factors: np.ndarray, weights: np.ndarray
) -> Updated:
    """A matrix with a further term U diag(w) U^T."""
    plain, before, known = _parts(matrix)
    return Updated(plain, np.hstack([before, factors]), np.concatenate([known, weights]))


def combined(
    first: complex,
    one: sparse.csr_matrix | Updated,
    second: complex,
    other: sparse.csr_matrix | Updated,
) -> sparse.csr_matrix | Updated:
    """The sum a A + b B; its terms of low rank, if any, stay apart."""
    if not (isinstance(one, Updated) or isinstance(other, Updated)):
        return (first * one + second * other).tocsr()
    (s, u, w), (t, v, z) = _parts(one), _parts(other)
    plain = (first * s + second * t).tocsr()
    return Updated(plain, np.hstack([u, v]), np.concatenate([first * w, second * z]))


def _parts(matrix: sparse.csr_matrix | Updated) -> tuple:
    if isinstance(matrix, Updated):
        return matrix.sparse, matrix.factors, matrix.weights
    return matrix, np.empty((matrix.shape[0], 0)), np.empty(0)
