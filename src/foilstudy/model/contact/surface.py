"""The surface that touches: the knots of a closed patch, triangles and edges between them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy.sparse as sparse

from foilstudy.model.patch import Patch, knot_points


@dataclass(frozen=True, eq=False)
class Triangulation:
    """Two triangles for every element, and all their edges.

    Attributes
    ----------
    patch : Patch
    triangles : ndarray of int, shape (triangles, 3)
        Knots, by row and column.
    edges : ndarray of int, shape (edges, 2)
    """

    patch: Patch
    triangles: np.ndarray
    edges: np.ndarray

    @property
    def count(self) -> int:
        """Number of knots."""
        return (self.patch.rows - 1) * self.patch.columns

    def knots(self, field: np.ndarray) -> np.ndarray:
        """Means of four control points each, of positions or motions, shape (count, 3)."""
        return np.ascontiguousarray(knot_points(field).reshape(3, -1).T)

    def gathered(self, forces: np.ndarray, out: np.ndarray) -> None:
        """Forces on the knots as forces on the control points: the transpose of `knots`.

        Parameters
        ----------
        forces : ndarray, shape (count, 3)
        out : ndarray, shape (3, rows, columns)
        """
        quarter = 0.25 * forces.T.reshape(3, self.patch.rows - 1, self.patch.columns)
        quarter = quarter + np.roll(quarter, 1, axis=2)
        out[:, 0] = 0.0
        out[:, 1:] = quarter
        out[:, :-1] += quarter

    def spread(self) -> sparse.csr_matrix:
        """The matrix of `knots`, every component by itself."""
        return _spread(self.patch)


@lru_cache(maxsize=4)
def triangulation(patch: Patch) -> Triangulation:
    """The surface of a closed patch.

    Raises
    ------
    ValueError
        If the patch is open.
    """
    if not patch.periodic:
        raise ValueError("contact knows closed patches only")
    corner = np.arange((patch.rows - 1) * patch.columns).reshape(-1, patch.columns)
    right = np.roll(corner, -1, axis=1)
    # the triangles by which `shell.intersection` judges whether a surface crosses itself
    a, b, c, d = (k.ravel() for k in (corner[:-1], right[:-1], right[1:], corner[1:]))
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    edges = np.concatenate(
        [
            np.stack([corner.ravel(), right.ravel()], 1),
            np.stack([a, d], 1),
            np.stack([a, c], 1),
        ]
    )
    return Triangulation(patch, triangles, edges)


@lru_cache(maxsize=4)
def _spread(patch: Patch) -> sparse.csr_matrix:
    rows, columns = patch.rows, patch.columns
    knot = np.arange((rows - 1) * columns)
    j, i = np.divmod(knot, columns)
    points = [(j + dj) * columns + (i + di) % columns for dj in (0, 1) for di in (0, 1)]
    entries = np.full(4 * knot.size, 0.25), (np.tile(knot, 4), np.concatenate(points))
    matrix = sparse.csr_matrix(entries, (knot.size, rows * columns))
    return sparse.kron(matrix, sparse.identity(3), format="csr")
