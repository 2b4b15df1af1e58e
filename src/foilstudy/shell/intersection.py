"""Self-crossing of a closed structured surface, which a model without contact permits."""

from __future__ import annotations

import numpy as np
from numba import njit
from scipy.spatial import cKDTree


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
    """
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
    pairs = cKDTree(centres).query_pairs(reach, output_type="ndarray")
    crossed = np.zeros(len(triangles), dtype=np.bool_)
    _mark_crossings(vertices, quad_corners, pairs, crossed)
    quads = crossed[: len(a)] | crossed[len(a) :]
    areas = 0.5 * np.linalg.norm(
        np.cross(vertices[:, 1] - vertices[:, 0], vertices[:, 2] - vertices[:, 0]), axis=1
    )
    quad_areas = areas[: len(a)] + areas[len(a) :]
    return float(quad_areas[quads].sum() / quad_areas.sum())


@njit(cache=True)
def _mark_crossings(vertices, quad_corners, pairs, crossed):
    for k in range(pairs.shape[0]):
        p, q = pairs[k, 0], pairs[k, 1]
        if crossed[p] and crossed[q]:
            continue
        shared = False
        for i in range(4):
            for j in range(4):
                shared = shared or quad_corners[p, i] == quad_corners[q, j]
        if shared or not _boxes_overlap(vertices[p], vertices[q]):
            continue
        for i in range(3):
            j = (i + 1) % 3
            if _segment_hits(vertices[p, i], vertices[p, j], vertices[q]) or _segment_hits(
                vertices[q, i], vertices[q, j], vertices[p]
            ):
                crossed[p] = True
                crossed[q] = True
                break


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
