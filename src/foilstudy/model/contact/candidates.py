"""Pairs of a point and a triangle, and of two edges, that are near each other.

What belongs to the one element is compared with what belongs to the other, of elements that are
near each other in blocks that are.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from foilstudy.model.contact.distance import closest, edge_square
from foilstudy.model.contact.surface import Triangulation


class Balls:
    """Balls around elements, triangles and edges, each as new as it was last asked for.

    Parameters
    ----------
    surface : Triangulation
    """

    def __init__(self, surface: Triangulation):
        self._surface = surface
        members = surface.corners, surface.triangles, surface.edges
        self.elements, self.triangles, self.edges = (
            (np.empty((len(each), 3)), np.empty(len(each))) for each in members
        )

    def renew(self, knots: np.ndarray, elements: np.ndarray) -> None:
        """Those of some elements and of what belongs to them; see `_touching`, `_crossing`."""
        surface, count = self._surface, self._surface.count
        whole = len(surface.triangles) // 2
        inner = elements[elements < whole]
        fill_balls(knots, surface.corners, elements, *self.elements)
        halves = np.concatenate([inner, inner + whole])
        fill_balls(knots, surface.triangles, halves, *self.triangles)
        edges = np.concatenate([elements, inner + count, inner + count + whole])
        fill_balls(knots, surface.edges, edges, *self.edges)


def candidates(
    surface: Triangulation,
    knots: np.ndarray,
    distance: float,
    balls: Balls,
    near: np.ndarray,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """All pairs nearer than a distance that do not share a knot, of some pairs of elements.

    Parameters
    ----------
    surface : Triangulation
    knots : ndarray, shape (count, 3)
        m.
    distance : float
        m.
    balls : Balls
        Renewed for these elements.
    near : ndarray of int, shape (element pairs, 2)
        Two elements each.

    Returns
    -------
    pairs : ndarray of int, shape (pairs, 4)
        Point and triangle, or two edges.
    edges : ndarray of bool, shape (pairs,)
        Which of the two.
    source : ndarray of int, shape (pairs,)
        The pair of elements that they come from.
    """
    room = 64 + len(near) // 4
    touching = whole(_touching, room, near, knots, surface.triangles, *balls.triangles, distance)
    crossing = whole(_crossing, room, near, knots, surface.edges, *balls.edges, distance)
    found = np.concatenate([touching, crossing])
    return found[:, :4], np.arange(len(found)) >= len(touching), found[:, 4]


def whole(search, room, *arguments, width=5):
    """All that a search finds, which begins anew where the room for it was too small."""
    while True:
        found = np.empty((room, width), dtype=np.int64)
        room = search(*arguments, found)
        if room <= len(found):
            return found[:room]


@njit(cache=True, error_model="numpy")
def fill_balls(knots, members, which, middles, radii):
    """Middle and radius of a ball around each of some sets of knots."""
    for b in which:
        fill_ball(knots, members, b, middles, radii)


@njit(cache=True, error_model="numpy")
def fill_ball(knots, members, b, middles, radii):
    """The same of one set."""
    width = members.shape[1]
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


@njit(cache=True, error_model="numpy")
def apart(one, radius, other, other_radius, distance):
    """Whether two balls are farther from each other than a distance."""
    square = 0.0
    for c in range(3):
        way = one[c] - other[c]
        square += way * way
    most = radius + other_radius + distance
    return square > most * most


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
                if apart(knots[p], 0.0, middles[t], radii[t], distance):
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
                        found[number, 4] = pair
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
                if apart(middles[e], radii[e], middles[f], radii[f], distance):
                    continue
                low, high = min(e, f), max(e, f)
                i, j, k, m = edges[low, 0], edges[low, 1], edges[high, 0], edges[high, 1]
                if i == k or i == m or j == k or j == m:
                    continue
                if edge_square(knots, i, j, k, m) < distance * distance:
                    if number < len(found):
                        found[number, 0], found[number, 1] = i, j
                        found[number, 2], found[number, 3] = k, m
                        found[number, 4] = pair
                    number += 1
    return number
