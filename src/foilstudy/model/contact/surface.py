"""The surface that touches: the knots of a closed patch, triangles and edges between them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy.sparse as sparse
from numba import njit

from foilstudy.model.patch import Patch


@dataclass(frozen=True, eq=False)
class Triangulation:
    """Two triangles for every element, and all their edges.

    Attributes
    ----------
    patch : Patch
    triangles : ndarray of int, shape (triangles, 3)
        Knots, by row and column.
        The first ones of all elements, then the second ones.
    edges : ndarray of int, shape (edges, 2)
        Around at every knot; then along and across every element.
    corners : ndarray of int, shape (count, 4)
        Of the element that begins at a knot; beyond the last row, of its edge around.
    """

    patch: Patch
    triangles: np.ndarray
    edges: np.ndarray
    corners: np.ndarray

    @property
    def count(self) -> int:
        """Number of knots."""
        return (self.patch.rows - 1) * self.patch.columns

    def knots(self, field: np.ndarray) -> np.ndarray:
        """Means of four control points each, of positions or motions, shape (count, 3)."""
        out = np.empty((self.count, 3))
        _means_of_four(field, out)
        return out

    def gathered(self, forces: np.ndarray, out: np.ndarray) -> None:
        """Forces on the knots as forces on the control points: the transpose of `knots`.

        Parameters
        ----------
        forces : ndarray, shape (count, 3)
        out : ndarray, shape (3, rows, columns)
        """
        out[:] = 0.0
        _spread_to_four(forces, out)

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
    last = np.stack([corner[-1], right[-1], corner[-1], right[-1]], 1)
    corners = np.concatenate([np.stack([a, b, c, d], 1), last])
    return Triangulation(patch, triangles, edges, corners)


@lru_cache(maxsize=4)
def _spread(patch: Patch) -> sparse.csr_matrix:
    rows, columns = patch.rows, patch.columns
    knot = np.arange((rows - 1) * columns)
    j, i = np.divmod(knot, columns)
    points = [(j + dj) * columns + (i + di) % columns for dj in (0, 1) for di in (0, 1)]
    entries = np.full(4 * knot.size, 0.25), (np.tile(knot, 4), np.concatenate(points))
    matrix = sparse.csr_matrix(entries, (knot.size, rows * columns))
    return sparse.kron(matrix, sparse.identity(3), format="csr")


@njit(cache=True, error_model="numpy")
def _means_of_four(field, out):
    _, rows, columns = field.shape
    for j in range(rows - 1):
        for i in range(columns):
            right = i + 1 if i + 1 < columns else 0
            for c in range(3):
                below = 0.5 * (field[c, j, i] + field[c, j + 1, i])
                beside = 0.5 * (field[c, j, right] + field[c, j + 1, right])
                out[j * columns + i, c] = 0.5 * (below + beside)


@njit(cache=True, error_model="numpy")
def _spread_to_four(forces, out):
    _, rows, columns = out.shape
    for j in range(rows - 1):
        for i in range(columns):
            right = i + 1 if i + 1 < columns else 0
            for c in range(3):
                quarter = 0.25 * forces[j * columns + i, c]
                if quarter != 0.0:
                    out[c, j, i] += quarter
                    out[c, j, right] += quarter
                    out[c, j + 1, i] += quarter
                    out[c, j + 1, right] += quarter


_STRIDE = 17


@njit(cache=True, error_model="numpy")
def largest_deviation(here, before):
    """Bound of the distance between two states of points, beside a common motion, shape (n, 3).

    Two points come nearer by twice of it at most, whatever the common motion is taken to be.
    """
    x = y = z = 0.0
    number = 0
    for p in range(0, len(here), _STRIDE):
        x += here[p, 0] - before[p, 0]
        y += here[p, 1] - before[p, 1]
        z += here[p, 2] - before[p, 2]
        number += 1
    x, y, z = x / number, y / number, z / number
    most = 0.0
    for p in range(len(here)):
        dx = here[p, 0] - before[p, 0] - x
        dy = here[p, 1] - before[p, 1] - y
        dz = here[p, 2] - before[p, 2] - z
        square = dx * dx + dy * dy + dz * dz
        if not square <= most:  # what is not a number goes through
            most = square
    return np.sqrt(most)


@njit(cache=True, error_model="numpy")
def largest_control_deviation(here, before):
    """The same of control points, shape (3, rows, columns); no knot deviates more."""
    middle = here.shape[1] // 2
    x = here[0, middle, 0] - before[0, middle, 0]
    y = here[1, middle, 0] - before[1, middle, 0]
    z = here[2, middle, 0] - before[2, middle, 0]
    most = np.zeros(here.shape[2])
    for j in range(here.shape[1]):
        px, py, pz = here[0, j], here[1, j], here[2, j]
        qx, qy, qz = before[0, j], before[1, j], before[2, j]
        for i in range(most.size):
            dx, dy, dz = px[i] - qx[i] - x, py[i] - qy[i] - y, pz[i] - qz[i] - z
            square = dx * dx + dy * dy + dz * dz
            most[i] = most[i] if square <= most[i] else square
    return np.sqrt(_largest(most))


@njit(cache=True, error_model="numpy")
def largest_motion(motion):
    """Largest motion of a control point, shape (3, rows, columns)."""
    most = np.zeros(motion.shape[2])
    for j in range(motion.shape[1]):
        dx, dy, dz = motion[0, j], motion[1, j], motion[2, j]
        for i in range(most.size):
            square = dx[i] * dx[i] + dy[i] * dy[i] + dz[i] * dz[i]
            most[i] = most[i] if square <= most[i] else square
    return np.sqrt(_largest(most))


@njit(cache=True, error_model="numpy")
def _largest(values):
    most = 0.0
    for value in values:
        most = most if value <= most else value
    return most
