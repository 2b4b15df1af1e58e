"""Pairs of a point and a triangle, and of two edges, that are near each other.

Elements that are near are found by a grid of cells; then what belongs to the one is compared with
what belongs to the other. The order of the pairs follows from the shape alone.
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
    middles, radii = _balls(knots, surface.corners)
    near = _near(middles, radii, distance)
    triangle_balls, edge_balls = _balls(knots, surface.triangles), _balls(knots, surface.edges)
    touching = _whole(
        _touching, 2 * len(knots), near, knots, surface.triangles, *triangle_balls, distance
    )
    crossing = _whole(_crossing, 2 * len(knots), near, knots, surface.edges, *edge_balls, distance)
    return np.concatenate([touching, crossing]), len(touching)


def _whole(search, room, *arguments):
    """All that a search finds, which begins anew where the room for it was too small."""
    width = 2 if search is _near_balls else 4
    while True:
        found = np.empty((room, width), dtype=np.int64)
        room = search(*arguments, found)
        if room <= len(found):
            return found[:room]


def _balls(knots, members):
    """Middle and radius of a ball around each set of knots."""
    middles, radii = np.empty((len(members), 3)), np.empty(len(members))
    _fill_balls(knots, members, middles, radii)
    return middles, radii


@njit(cache=True, error_model="numpy")
def _fill_balls(knots, members, middles, radii):
    count, width = members.shape
    for b in range(count):
        for c in range(3):
            total = 0.0
            for m in range(width):
                total += knots[members[b, m], c]
            middles[b, c] = total / width
        most = 0.0
        for m in range(width):
            square = 0.0
            for c in range(3):
                way = knots[members[b, m], c] - middles[b, c]
                square += way * way
            most = max(most, square)
        radii[b] = np.sqrt(most)


def _near(middles, radii, distance):
    """Pairs of balls that are near, the lower number first; shape (pairs, 2)."""
    origin = middles.min(axis=0)
    extent = middles.max(axis=0) - origin
    side = float(radii.max()) + 0.5 * distance
    side = max(side, float(np.cbrt(np.prod(np.maximum(extent, side)) / _CELLS_MOST)))
    counts = (extent / side).astype(np.int64) + 1
    cells = ((middles - origin) / side).astype(np.int64)
    cell = (cells[:, 0] * counts[1] + cells[:, 1]) * counts[2] + cells[:, 2]
    members = np.argsort(cell, kind="stable")
    starts = np.concatenate([[0], np.cumsum(np.bincount(cell, minlength=np.prod(counts)))])
    return _whole(
        _near_balls, 32 * len(radii), middles, radii, radii.max() + distance,
        origin, side, counts, starts, members, distance,
    )  # fmt: skip


@njit(cache=True)
def _cell(value, origin, side, count):
    return min(max(int((value - origin) / side), 0), count - 1)


@njit(cache=True, error_model="numpy")
def _apart(one, radius, other, other_radius, distance):
    """Whether two balls are farther from each other than a distance."""
    square = 0.0
    for c in range(3):
        way = one[c] - other[c]
        square += way * way
    most = radius + other_radius + distance
    return square > most * most


@njit(cache=True, error_model="numpy")
def _near_balls(
    middles, radii, beyond, origin, side, counts, starts, members, distance, found
):  # fmt: skip
    """Write the pairs of balls that are near, as far as there is room; return their number."""
    first, last = np.empty(3, dtype=np.int64), np.empty(3, dtype=np.int64)
    number = 0
    for h in range(len(middles)):
        for c in range(3):
            reach = radii[h] + beyond
            first[c] = _cell(middles[h, c] - reach, origin[c], side, counts[c])
            last[c] = _cell(middles[h, c] + reach, origin[c], side, counts[c])
        for i in range(first[0], last[0] + 1):
            for j in range(first[1], last[1] + 1):
                row = (i * counts[1] + j) * counts[2]
                for place in range(starts[row + first[2]], starts[row + last[2] + 1]):
                    b = members[place]
                    if b <= h or _apart(middles[h], radii[h], middles[b], radii[b], distance):
                        continue
                    if number < len(found):
                        found[number, 0] = h
                        found[number, 1] = b
                    number += 1
    return number


@njit(cache=True, error_model="numpy")
def _touching(near, knots, triangles, middles, radii, distance, found):
    """Write the points near triangles, as far as there is room; return their number.

    A knot belongs to the element of its number, and so do the triangles of that number and of that
    beyond all elements.
    """
    elements = len(triangles) // 2
    x, a = np.empty((4, 3)), np.empty(4)
    change, w = np.empty((2, 4)), np.empty(3)
    number = 0
    for pair in range(len(near)):
        for turn in range(2):
            p, element = near[pair, turn], near[pair, 1 - turn]
            if element >= elements:
                continue
            for half in range(2):
                t = element + half * elements
                if _apart(knots[p], 0.0, middles[t], radii[t], distance):
                    continue
                if p == triangles[t, 0] or p == triangles[t, 1] or p == triangles[t, 2]:
                    continue
                for c in range(3):
                    x[0, c] = knots[p, c]
                    for m in range(3):
                        x[m + 1, c] = knots[triangles[t, m], c]
                square, _ = closest(x, False, a, change, w)
                if square < distance * distance:
                    if number < len(found):
                        found[number, 0] = p
                        for m in range(3):
                            found[number, m + 1] = triangles[t, m]
                    number += 1
    return number


@njit(cache=True, error_model="numpy")
def _crossing(near, knots, edges, middles, radii, distance, found):
    """Write the edges near edges, as far as there is room; return their number.

    Of every knot there is an edge around, then of every element one along and a diagonal.
    """
    count = len(knots)
    elements = (len(edges) - count) // 2
    number = 0
    for pair in range(len(near)):
        for one in range(3):
            e = near[pair, 0] + (one > 0) * count + (one > 1) * elements
            if one > 0 and near[pair, 0] >= elements:
                break
            for two in range(3):
                f = near[pair, 1] + (two > 0) * count + (two > 1) * elements
                if two > 0 and near[pair, 1] >= elements:
                    break
                if _apart(middles[e], radii[e], middles[f], radii[f], distance):
                    continue
                low, high = min(e, f), max(e, f)
                i, j, k, m = edges[low, 0], edges[low, 1], edges[high, 0], edges[high, 1]
                if i == k or i == m or j == k or j == m:
                    continue
                if edge_square(knots, i, j, k, m) < distance * distance:
                    if number < len(found):
                        found[number, 0], found[number, 1] = i, j
                        found[number, 2], found[number, 3] = k, m
                    number += 1
    return number
