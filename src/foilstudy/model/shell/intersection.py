"""Self-crossing of a closed structured surface, which a model without contact permits."""

from __future__ import annotations

import numpy as np
from numba import njit


def self_crossing_share(surface: np.ndarray) -> float:
    """Share of the surface area in quadrilaterals that another part of the surface crosses.

    Parameters
    ----------
    surface : ndarray, shape (3, rows, columns)
        Points of a grid that is periodic in its columns, m.

    Returns
    -------
    float
        Between 0 and 1. Quadrilaterals that share a corner are not tested against each other.

    Raises
    ------
    ValueError
        If a point is not finite, or if all points coincide.
    """
    if not (np.isfinite(surface).all() and np.ptp(surface) > 0):
        raise ValueError("the surface has points that are not finite, or no extent")
    _, rows, columns = surface.shape
    points = surface.reshape(3, -1).T
    corner = np.arange(rows * columns).reshape(rows, columns)
    right = np.roll(corner, -1, axis=1)
    a, b, c, d = (k.ravel() for k in (corner[:-1], right[:-1], right[1:], corner[1:]))
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    quad_corners = np.tile(np.stack([a, b, c, d], 1), (2, 1))
    vertices = points[triangles]
    centres = vertices.mean(axis=1)
    reach = 2 * np.linalg.norm(vertices - centres[:, None], axis=2).max()
    # triangles that meet lie in the same or in neighbouring cubes of this size
    cells = ((centres - centres.min(axis=0)) / reach).astype(np.int64)
    crossed = np.zeros(len(triangles), dtype=np.bool_)
    _mark_crossings(vertices, quad_corners, cells, crossed)
    quads = crossed[: len(a)] | crossed[len(a) :]
    areas = 0.5 * np.linalg.norm(
        np.cross(vertices[:, 1] - vertices[:, 0], vertices[:, 2] - vertices[:, 0]), axis=1
    )
    quad_areas = areas[: len(a)] + areas[len(a) :]
    return float(quad_areas[quads].sum() / quad_areas.sum())


@njit(cache=True)
def _mark_crossings(vertices, quad_corners, cells, crossed):
    """Test every triangle against the later ones in its own and in the neighbouring cells."""
    nx, ny, nz = cells[:, 0].max() + 3, cells[:, 1].max() + 3, cells[:, 2].max() + 3
    first = np.full((nx, ny, nz), -1)  # a margin of one empty cell all round
    following = np.full(len(cells), -1)
    for p in range(len(cells)):
        x, y, z = cells[p, 0] + 1, cells[p, 1] + 1, cells[p, 2] + 1
        for i in range(x - 1, x + 2):
            for j in range(y - 1, y + 2):
                for k in range(z - 1, z + 2):
                    q = first[i, j, k]
                    while q >= 0:
                        if not (crossed[p] and crossed[q]) and _cross(
                            vertices[p], vertices[q], quad_corners[p], quad_corners[q]
                        ):
                            crossed[p] = True
                            crossed[q] = True
                        q = following[q]
        following[p] = first[x, y, z]
        first[x, y, z] = p


@njit(cache=True)
def _cross(first, second, first_corners, second_corners):
    for corner in first_corners:
        for other in second_corners:
            if corner == other:
                return False
    if not _boxes_overlap(first, second):
        return False
    for i in range(3):
        j = (i + 1) % 3
        if _segment_hits(first[i], first[j], second) or _segment_hits(second[i], second[j], first):
            return True
    return False


@njit(cache=True)
def _boxes_overlap(first, second):
    for c in range(3):
        if first[:, c].max() < second[:, c].min() or second[:, c].max() < first[:, c].min():
            return False
    return True


@njit(cache=True)
def _segment_hits(start, end, triangle):
    """Moller-Trumbore intersection of a segment with a triangle."""
    direction = end - start
    edge1 = triangle[1] - triangle[0]
    edge2 = triangle[2] - triangle[0]
    h = np.cross(direction, edge2)
    det = np.dot(edge1, h)
    if det == 0.0:
        return False
    offset = start - triangle[0]
    u = np.dot(offset, h) / det
    if u < 0.0 or u > 1.0:
        return False
    g = np.cross(offset, edge1)
    v = np.dot(direction, g) / det
    if v < 0.0 or u + v > 1.0:
        return False
    along = np.dot(edge2, g) / det
    return 0.0 <= along <= 1.0
