"""Closest points of a point and a triangle, and of two edges.

The closest vector is w = sum a_i x_i over four points, the signed weights a adding up to zero. Up
to two of the barycentric coordinates behind them are free, the others stand at a bound: a vertex,
an edge or the middle of a triangle. How the weights change with a free one is constant.
"""

from __future__ import annotations

import numpy as np
from numba import njit

_PARALLEL = 1e-12
"""Squared sine between two edges below which ends are compared only."""


@njit(cache=True, error_model="numpy")
def _dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


@njit(cache=True, error_model="numpy")
def _from(x, i, j):
    """Vector from the point i to the point j."""
    return x[j, 0] - x[i, 0], x[j, 1] - x[i, 1], x[j, 2] - x[i, 2]


@njit(cache=True, error_model="numpy")
def point_triangle(x, a, change):
    """Weights of the closest vector from a triangle, x[1:], to a point, x[0].

    The regions of Ericson, Real-Time Collision Detection, section 5.1.5.

    Parameters
    ----------
    x : ndarray, shape (4, 3)
        m.
    a : ndarray, shape (4,)
        Receives the weights.
    change : ndarray, shape (2, 4)
        Receives their derivatives by the free coordinates.

    Returns
    -------
    int
        Number of free coordinates: 0 at a vertex, 1 on an edge, 2 in the middle.
    """
    a[:] = 0.0
    change[:] = 0.0
    a[0] = 1.0
    ab, ac, ap = _from(x, 1, 2), _from(x, 1, 3), _from(x, 1, 0)
    d1, d2 = _dot(ab, ap), _dot(ac, ap)
    if d1 <= 0.0 and d2 <= 0.0:
        a[1] = -1.0
        return 0
    bp = _from(x, 2, 0)
    d3, d4 = _dot(ab, bp), _dot(ac, bp)
    if d3 >= 0.0 and d4 <= d3:
        a[2] = -1.0
        return 0
    vc = d1 * d4 - d3 * d2
    if vc <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        return _on_edge(1, 2, d1 / (d1 - d3), a, change)
    cp = _from(x, 3, 0)
    d5, d6 = _dot(ab, cp), _dot(ac, cp)
    if d6 >= 0.0 and d5 <= d6:
        a[3] = -1.0
        return 0
    vb = d5 * d2 - d1 * d6
    if vb <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        return _on_edge(1, 3, d2 / (d2 - d6), a, change)
    va = d3 * d6 - d5 * d4
    if va <= 0.0 and d4 - d3 >= 0.0 and d5 - d6 >= 0.0:
        return _on_edge(2, 3, (d4 - d3) / ((d4 - d3) + (d5 - d6)), a, change)
    whole = va + vb + vc
    a[1], a[2], a[3] = -va / whole, -vb / whole, -vc / whole
    change[0, 1], change[0, 2] = 1.0, -1.0
    change[1, 1], change[1, 3] = 1.0, -1.0
    return 2


@njit(cache=True, error_model="numpy")
def _on_edge(i, j, share, a, change):
    a[i], a[j] = share - 1.0, -share
    change[0, i], change[0, j] = 1.0, -1.0
    return 1


@njit(cache=True, error_model="numpy")
def edge_edge(x, a, change):
    """Weights of the closest vector from the edge x[2:] to the edge x[:2]; as `point_triangle`.

    Two coordinates are free inside both edges, one where an end is nearest, none between two ends.
    """
    a[:] = 0.0
    change[:] = 0.0
    u, v, r = _from(x, 0, 1), _from(x, 2, 3), _from(x, 2, 0)
    uu, uv, vv, ur, vr = _dot(u, u), _dot(u, v), _dot(v, v), _dot(u, r), _dot(v, r)
    det = uu * vv - uv * uv
    p, q = -1.0, -1.0
    if det > _PARALLEL * uu * vv:
        p = (uv * vr - vv * ur) / det
        q = (uu * vr - uv * ur) / det
    if not (0.0 < p < 1.0 and 0.0 < q < 1.0):
        least = np.inf
        for k in range(4):
            if k < 2:
                at_p = float(k)
                at_q = min(max((vr + at_p * uv) / vv, 0.0), 1.0)
            else:
                at_q = float(k - 2)
                at_p = min(max((at_q * uv - ur) / uu, 0.0), 1.0)
            square = 0.0
            for c in range(3):
                gap = r[c] + at_p * u[c] - at_q * v[c]
                square += gap * gap
            if square < least:
                least, p, q = square, at_p, at_q
    a[0], a[1], a[2], a[3] = 1.0 - p, p, q - 1.0, -q
    free = 0
    if 0.0 < p < 1.0:
        change[free, 0], change[free, 1] = -1.0, 1.0
        free += 1
    if 0.0 < q < 1.0:
        change[free, 2], change[free, 3] = 1.0, -1.0
        free += 1
    return free


@njit(cache=True, error_model="numpy")
def edge_square(knots, i, j, k, m):
    """Squared distance of two edges of a surface, i to j and k to m, without what `closest` says.

    Ericson, Real-Time Collision Detection, section 5.1.9: several times faster, and of near
    parallel edges as exact as rounding allows.
    """
    u, v, r = _from(knots, i, j), _from(knots, k, m), _from(knots, k, i)
    uu, uv, vv, ur, vr = _dot(u, u), _dot(u, v), _dot(v, v), _dot(u, r), _dot(v, r)
    det = uu * vv - uv * uv
    p = 0.0
    if det > _PARALLEL * uu * vv:
        p = min(max((uv * vr - ur * vv) / det, 0.0), 1.0)
    q = (uv * p + vr) / vv
    if q < 0.0:
        q, p = 0.0, min(max(-ur / uu, 0.0), 1.0)
    elif q > 1.0:
        q, p = 1.0, min(max((uv - ur) / uu, 0.0), 1.0)
    square = 0.0
    for c in range(3):
        gap = r[c] + p * u[c] - q * v[c]
        square += gap * gap
    return square


@njit(cache=True, error_model="numpy")
def closest(x, is_edges, a, change, w):
    """Weights as above and the closest vector; returns the squared distance and the free ones."""
    free = edge_edge(x, a, change) if is_edges else point_triangle(x, a, change)
    square = 0.0
    for c in range(3):
        w[c] = a[0] * x[0, c] + a[1] * x[1, c] + a[2] * x[2, c] + a[3] * x[3, c]
        square += w[c] * w[c]
    return square, free
