"""Pairs of a point and a triangle, and of two edges, that are near each other; by a grid of cells.

The order of the pairs follows from the shape alone.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from foilstudy.model.contact.distance import closest
from foilstudy.model.contact.surface import Triangulation

_CELLS_MOST = 4_000_000


def candidates(
    surface: Triangulation, knots: np.ndarray, distance: float
) -> tuple[np.ndarray, int]:
    """All pairs nearer than a distance that do not share a knot.

    Parameters
    ----------
    surface : Triangulation
    knots : ndarray, shape (count, 3)
        m.
    distance : float
        m.

    Returns
    -------
    pairs : ndarray of int, shape (pairs, 4)
        Point and triangle first, then edges.
    int
        How many of the first kind there are.
    """
    touching = _near(knots, surface.triangles, np.arange(len(knots))[:, None], distance)
    crossing = _near(knots, surface.edges, surface.edges, distance)
    return np.concatenate([touching, crossing]), len(touching)


def _near(knots, holders, others, distance):
    """Pairs of one of `others` and one of `holders`; of edges among each other each once."""
    low, high = _boxes(knots, others)
    margin = np.array([-distance, distance])[:, None, None]
    wide_low, wide_high = np.stack(_boxes(knots, holders)) + margin
    origin = low.min(axis=0)
    extent = high.max(axis=0) - origin
    side = max(float(np.median((high - low).max(axis=1))), distance)
    side = max(side, float(np.cbrt(np.prod(np.maximum(extent, side)) / _CELLS_MOST)))
    counts = (extent / side).astype(np.int64) + 1
    starts, members = _grid(low, high, origin, side, counts)
    found = np.empty((max(4096, 4 * len(holders)), 4), dtype=np.int64)
    while True:
        number = _search(
            knots, holders, others, low, high, wide_low, wide_high,
            origin, side, counts, starts, members, distance, found,
        )  # fmt: skip
        if number <= len(found):
            return found[:number]
        found = np.empty((number, 4), dtype=np.int64)


def _boxes(knots, members):
    corners = knots[members]
    return corners.min(axis=1), corners.max(axis=1)


@njit(cache=True)
def _cell(value, origin, side, count):
    return min(max(int((value - origin) / side), 0), count - 1)


@njit(cache=True)
def _grid(low, high, origin, side, counts):
    """Which boxes overlap each cell: starts and members, in the order of the boxes."""
    nx, ny, nz = counts
    starts = np.zeros(nx * ny * nz + 1, dtype=np.int64)
    members = np.empty(0, dtype=np.int64)
    for filling in range(2):
        for b in range(len(low)):
            for i in range(
                _cell(low[b, 0], origin[0], side, nx), _cell(high[b, 0], origin[0], side, nx) + 1
            ):
                for j in range(
                    _cell(low[b, 1], origin[1], side, ny),
                    _cell(high[b, 1], origin[1], side, ny) + 1,
                ):
                    for k in range(
                        _cell(low[b, 2], origin[2], side, nz),
                        _cell(high[b, 2], origin[2], side, nz) + 1,
                    ):
                        cell = (i * ny + j) * nz + k
                        if filling:
                            members[starts[cell]] = b
                            starts[cell] += 1
                        else:
                            starts[cell + 1] += 1
        if filling:  # the starts have moved on to the next cell's
            for cell in range(len(starts) - 1, 0, -1):
                starts[cell] = starts[cell - 1]
            starts[0] = 0
        else:
            for cell in range(len(starts) - 1):
                starts[cell + 1] += starts[cell]
            members = np.empty(starts[-1], dtype=np.int64)
    return starts, members


@njit(cache=True, error_model="numpy")
def _search(
    knots, holders, others, low, high, wide_low, wide_high,
    origin, side, counts, starts, members, distance, found,
):  # fmt: skip
    """Write the pairs that are near, as many as there is room for; return their number."""
    nx, ny, nz = counts
    edges = others.shape[1] == 2
    x, a = np.empty((4, 3)), np.empty(4)
    change, w = np.empty((2, 4)), np.empty(3)
    seen = np.full(len(others), -1)
    ids = np.empty(4, dtype=np.int64)
    number = 0
    for h in range(len(holders)):
        for i in range(
            _cell(wide_low[h, 0], origin[0], side, nx),
            _cell(wide_high[h, 0], origin[0], side, nx) + 1,
        ):
            for j in range(
                _cell(wide_low[h, 1], origin[1], side, ny),
                _cell(wide_high[h, 1], origin[1], side, ny) + 1,
            ):
                for k in range(
                    _cell(wide_low[h, 2], origin[2], side, nz),
                    _cell(wide_high[h, 2], origin[2], side, nz) + 1,
                ):
                    cell = (i * ny + j) * nz + k
                    for place in range(starts[cell], starts[cell + 1]):
                        b = members[place]
                        if seen[b] == h or (edges and b <= h):
                            continue
                        seen[b] = h
                        apart = False
                        for c in range(3):
                            if low[b, c] > wide_high[h, c] or high[b, c] < wide_low[h, c]:
                                apart = True
                        if apart:
                            continue
                        if edges:
                            ids[0], ids[1] = holders[h, 0], holders[h, 1]
                            ids[2], ids[3] = others[b, 0], others[b, 1]
                            if (
                                ids[0] == ids[2]
                                or ids[0] == ids[3]
                                or ids[1] == ids[2]
                                or ids[1] == ids[3]
                            ):
                                continue
                        else:
                            ids[0], ids[1] = others[b, 0], holders[h, 0]
                            ids[2], ids[3] = holders[h, 1], holders[h, 2]
                            if ids[0] == ids[1] or ids[0] == ids[2] or ids[0] == ids[3]:
                                continue
                        for m in range(4):
                            for c in range(3):
                                x[m, c] = knots[ids[m], c]
                        square, _ = closest(x, edges, a, change, w)
                        if square < distance * distance:
                            if number < len(found):
                                found[number] = ids
                            number += 1
    return number
