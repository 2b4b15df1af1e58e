"""Pairs of a point and a triangle, and of two edges, that are near each other; by a grid of cells.

The order of the pairs follows from the shape alone.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from foilstudy.model.contact.distance import closest, edge_square
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
    middles, radii = _balls(knots, others)
    holder_middles, holder_radii = _balls(knots, holders)
    reach = holder_radii + radii.max() + distance
    origin = middles.min(axis=0)
    extent = middles.max(axis=0) - origin
    side = max(0.5 * float(reach.max()), distance)
    side = max(side, float(np.cbrt(np.prod(np.maximum(extent, side)) / _CELLS_MOST)))
    counts = (extent / side).astype(np.int64) + 1
    cells = ((middles - origin) / side).astype(np.int64)
    cell = (cells[:, 0] * counts[1] + cells[:, 1]) * counts[2] + cells[:, 2]
    members = np.argsort(cell, kind="stable")
    starts = np.concatenate([[0], np.cumsum(np.bincount(cell, minlength=np.prod(counts)))])
    middles, radii = middles[members], radii[members]
    found = np.empty((max(4096, 4 * len(holders)), 4), dtype=np.int64)
    while True:
        number = _search(
            knots, holders, others, middles, radii, holder_middles, holder_radii, reach,
            origin, side, counts, starts, members, distance, found,
        )  # fmt: skip
        if number <= len(found):
            return found[:number]
        found = np.empty((number, 4), dtype=np.int64)


def _balls(knots, members):
    """Middle and radius of a ball around each point, edge or triangle."""
    corners = knots[members]
    middles = corners.mean(axis=1)
    radii = np.sqrt(np.max(np.sum((corners - middles[:, None]) ** 2, axis=2), axis=1))
    return middles, radii


@njit(cache=True)
def _cell(value, origin, side, count):
    return min(max(int((value - origin) / side), 0), count - 1)


@njit(cache=True, error_model="numpy")
def _search(
    knots, holders, others, middles, radii, holder_middles, holder_radii, reach,
    origin, side, counts, starts, members, distance, found,
):  # fmt: skip
    """Write the pairs that are near, as many as there is room for; return their number.

    Middles and radii of the others stand in the order of their cells.
    """
    edges = others.shape[1] == 2
    x, a = np.empty((4, 3)), np.empty(4)
    change, w = np.empty((2, 4)), np.empty(3)
    ids = np.empty(4, dtype=np.int64)
    first, last = np.empty(3, dtype=np.int64), np.empty(3, dtype=np.int64)
    number = 0
    for h in range(len(holders)):
        for c in range(3):
            middle = holder_middles[h, c]
            first[c] = _cell(middle - reach[h], origin[c], side, counts[c])
            last[c] = _cell(middle + reach[h], origin[c], side, counts[c])
        for i in range(first[0], last[0] + 1):
            for j in range(first[1], last[1] + 1):
                row = (i * counts[1] + j) * counts[2]
                for place in range(starts[row + first[2]], starts[row + last[2] + 1]):
                    most = holder_radii[h] + radii[place] + distance
                    square = 0.0
                    for c in range(3):
                        way = holder_middles[h, c] - middles[place, c]
                        square += way * way
                    if square > most * most:
                        continue
                    b = members[place]
                    if edges and b <= h:
                        continue
                    if edges:
                        ids[0], ids[1] = holders[h, 0], holders[h, 1]
                        ids[2], ids[3] = others[b, 0], others[b, 1]
                        met = ids[0] == ids[3] or ids[1] == ids[2] or ids[1] == ids[3]
                    else:
                        ids[0], ids[1] = others[b, 0], holders[h, 0]
                        ids[2], ids[3] = holders[h, 1], holders[h, 2]
                        met = ids[0] == ids[1] or ids[0] == ids[3]
                    if met or ids[0] == ids[2]:
                        continue
                    if edges:
                        nearest = edge_square(knots, ids[0], ids[1], ids[2], ids[3])
                    else:
                        for m in range(4):
                            for c in range(3):
                                x[m, c] = knots[ids[m], c]
                        nearest, _ = closest(x, False, a, change, w)
                    if nearest < distance * distance:
                        if number < len(found):
                            found[number] = ids
                        number += 1
    return number
