"""How far a motion may go until a pair has closed by a given share of its gap.

Conservative advancement (Li et al., Codimensional incremental potential contact, ACM Transactions
on Graphics 40 (4), 2021, section 4): a distance falls no faster than the points of either side
move against each other, and is taken again as often as that leaves room.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from foilstudy.model.contact.distance import closest

_ADVANCES = 50


@njit(cache=True, error_model="numpy")
def passable_share(knots, motion, pairs, edges, thickness, share):
    """Largest part of a straight motion, at most 1, in which no gap closes by more than a share.

    Parameters
    ----------
    knots, motion : ndarray, shape (count, 3)
        m.
    pairs : ndarray of int, shape (pairs, 4)
    edges : ndarray of bool, shape (pairs,)
        Two edges, rather than a point and a triangle.
    thickness, share : float

    Returns
    -------
    float
    """
    x, v = np.empty((4, 3)), np.empty((4, 3))
    a, change, w = np.empty(4), np.empty((2, 4)), np.empty(3)
    least = 1.0
    for p in range(len(pairs)):
        of_edges = edges[p]
        for i in range(4):
            for c in range(3):
                x[i, c] = knots[pairs[p, i], c]
                v[i, c] = motion[pairs[p, i], c]
        closing = _closing(v, 2 if of_edges else 1)
        square, _ = closest(x, of_edges, a, change, w)
        gap = np.sqrt(square) - thickness
        if least * closing <= share * gap:
            continue
        least = _advanced(x, v, of_edges, closing, gap, thickness, share, least, a, change, w)
    return least


@njit(cache=True, error_model="numpy")
def _closing(v, first):
    """Bound of how far the distance falls; the common motion is taken off `v`."""
    for c in range(3):
        mean = 0.25 * (v[0, c] + v[1, c] + v[2, c] + v[3, c])
        for i in range(4):
            v[i, c] -= mean
    one = other = 0.0
    for i in range(4):
        size = np.sqrt(v[i, 0] ** 2 + v[i, 1] ** 2 + v[i, 2] ** 2)
        if i < first:
            one = max(one, size)
        else:
            other = max(other, size)
    return one + other


@njit(cache=True, error_model="numpy")
def _advanced(x, v, edges, closing, gap, thickness, share, most, a, change, w):
    """Part of the motion up to `most` that leaves the pair its rest of the gap."""
    rest, done = (1.0 - share) * gap, 0.0
    for _ in range(_ADVANCES):
        step = (gap - rest) / closing
        if step <= 1e-3 * rest / closing:
            return done
        step = min(step, most - done)
        for i in range(4):
            for c in range(3):
                x[i, c] += step * v[i, c]
        done += step
        if done >= most:
            return most
        square, _ = closest(x, edges, a, change, w)
        gap = np.sqrt(square) - thickness
    return done
