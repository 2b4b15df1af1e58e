"""Energy of one pair, its gradient and its Hessian.

E = E0 m b(y) with b = -(y - 1)^2 ln y, y = (d^2 - t^2)/s and s = (t + reach)^2 - t^2: twice
continuously differentiable where it begins, at y = 1, and without bound towards d = t. The factor
m = (2 - c/e) c/e, c the squared cross product of two edges, e = 1e-3 of their squared lengths, is 1
from c = e on and takes the energy of edges away that become parallel, where their closest points
jump; others act there. Li et al., Incremental potential contact, ACM Transactions on Graphics 39
(4), 2020.

The derivative of d^2/2 is a_i w whatever the closest points, since free coordinates are stationary
and others stand still; its second one a_i a_j I - C T^-1 C^T over the free coordinates.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from foilstudy.model.contact.distance import closest

PARALLEL = 1e-3
"""Squared sine of the angle from which edges count in full."""


@njit(cache=True, error_model="numpy")
def barrier(y):
    """b and its first and second derivative at 0 < y < 1."""
    below, log = y - 1.0, np.log(y)
    ratio = below / y
    return (
        -below * below * log,
        -2.0 * below * log - below * ratio,
        -2.0 * log - 4.0 * ratio + ratio * ratio,
    )


@njit(cache=True, error_model="numpy")
def _factor(x, full):
    """The factor m of two edges, its first and second derivative by c, and c's parts."""
    uu = uv = vv = 0.0
    for k in range(3):
        u, v = x[1, k] - x[0, k], x[3, k] - x[2, k]
        uu += u * u
        uv += u * v
        vv += v * v
    share = (uu * vv - uv * uv) / full
    if share >= 1.0:
        return 1.0, 0.0, 0.0, uu, uv, vv
    return (2.0 - share) * share, (2.0 - 2.0 * share) / full, -2.0 / (full * full), uu, uv, vv


@njit(cache=True, error_model="numpy")
def pair_energy(x, is_edges, full, thickness, span, a, change, w, gradient):
    """m b and its derivative by the four points.

    Parameters
    ----------
    x : ndarray, shape (4, 3)
        m.
    is_edges : bool
    full : float
        c from which edges count in full, m4.
    thickness, span : float
        t, m, and s, m2.
    a, change, w : ndarray, shapes (4,), (2, 4), (3,)
        Receive what `distance.closest` says.
    gradient : ndarray, shape (4, 3)
        Receives the derivative, 1/m.

    Returns
    -------
    float
        Zero beyond the reach, infinite within the thickness.
    """
    gradient[:] = 0.0
    square, _ = closest(x, is_edges, a, change, w)
    y = (square - thickness * thickness) / span
    if y >= 1.0:
        return 0.0
    if not y > 0.0:
        return np.inf
    value, slope, _ = barrier(y)
    if not is_edges:
        for i in range(4):
            for k in range(3):
                gradient[i, k] = slope * 2.0 / span * a[i] * w[k]
        return value
    factor, first, _, uu, uv, vv = _factor(x, full)
    for k in range(3):
        u, v = x[1, k] - x[0, k], x[3, k] - x[2, k]
        by_u = first * value * 2.0 * (vv * u - uv * v)
        by_v = first * value * 2.0 * (uu * v - uv * u)
        pull = factor * slope * 2.0 / span * w[k]
        gradient[0, k] = pull * a[0] - by_u
        gradient[1, k] = pull * a[1] + by_u
        gradient[2, k] = pull * a[2] - by_v
        gradient[3, k] = pull * a[3] + by_v
    return factor * value


@njit(cache=True, error_model="numpy")
def pair_hessian(x, is_edges, full, thickness, span, a, change, w, out):
    """Second derivative of m b by the four points, in `out`, shape (12, 12), 1/m2."""
    out[:] = 0.0
    square, free = closest(x, is_edges, a, change, w)
    y = (square - thickness * thickness) / span
    if not 0.0 < y < 1.0:
        return
    value, slope, bend = barrier(y)
    factor = first = second = 1.0
    uu = uv = vv = 0.0
    if is_edges:
        factor, first, second, uu, uv, vv = _factor(x, full)
    add_half_square(x, free, a, change, w, factor * slope * 2.0 / span, out)
    along = factor * bend * 4.0 / (span * span)
    for i in range(12):
        for j in range(12):
            out[i, j] += along * a[i // 3] * w[i % 3] * a[j // 3] * w[j % 3]
    if is_edges and factor != 1.0:
        _add_factor(x, uu, uv, vv, first * value, second * value, out)
        turn = np.empty(12)
        for k in range(3):
            u, v = x[1, k] - x[0, k], x[3, k] - x[2, k]
            turn[3 + k] = 2.0 * (vv * u - uv * v)
            turn[9 + k] = 2.0 * (uu * v - uv * u)
            turn[k], turn[6 + k] = -turn[3 + k], -turn[9 + k]
        mixed = first * slope * 2.0 / span
        for i in range(12):
            for j in range(12):
                push_i, push_j = a[i // 3] * w[i % 3], a[j // 3] * w[j % 3]
                out[i, j] += mixed * (turn[i] * push_j + push_i * turn[j])


@njit(cache=True, error_model="numpy")
def add_half_square(x, free, a, change, w, weight, out):
    """Add the second derivative of d^2/2, times a weight."""
    for i in range(4):
        for j in range(4):
            for k in range(3):
                out[3 * i + k, 3 * j + k] += weight * a[i] * a[j]
    if free == 0:
        return
    motion = np.zeros((2, 3))  # of w with a free coordinate
    for f in range(free):
        for i in range(4):
            for k in range(3):
                motion[f, k] += change[f, i] * x[i, k]
    coupling = np.zeros((2, 12))
    for f in range(free):
        for i in range(12):
            coupling[f, i] = change[f, i // 3] * w[i % 3] + a[i // 3] * motion[f, i % 3]
    t11 = motion[0, 0] ** 2 + motion[0, 1] ** 2 + motion[0, 2] ** 2
    if free == 1:
        for i in range(12):
            for j in range(12):
                out[i, j] -= weight * coupling[0, i] * coupling[0, j] / t11
        return
    t22 = motion[1, 0] ** 2 + motion[1, 1] ** 2 + motion[1, 2] ** 2
    t12 = motion[0, 0] * motion[1, 0] + motion[0, 1] * motion[1, 1] + motion[0, 2] * motion[1, 2]
    det = t11 * t22 - t12 * t12
    for i in range(12):
        first = (t22 * coupling[0, i] - t12 * coupling[1, i]) / det
        second = (t11 * coupling[1, i] - t12 * coupling[0, i]) / det
        for j in range(12):
            out[i, j] -= weight * (first * coupling[0, j] + second * coupling[1, j])


@njit(cache=True, error_model="numpy")
def _add_factor(x, uu, uv, vv, first, second, out):
    """Add the second derivative of the factor m, times the value b; u and v are the edges."""
    by = np.empty((2, 3))
    bends = np.empty((2, 3, 2, 3))
    for k in range(3):
        u, v = x[1, k] - x[0, k], x[3, k] - x[2, k]
        by[0, k] = 2.0 * (vv * u - uv * v)
        by[1, k] = 2.0 * (uu * v - uv * u)
        for n in range(3):
            un, vn = x[1, n] - x[0, n], x[3, n] - x[2, n]
            same = 1.0 if k == n else 0.0
            bends[0, k, 0, n] = 2.0 * (vv * same - v * vn)
            bends[1, k, 1, n] = 2.0 * (uu * same - u * un)
            bends[0, k, 1, n] = 4.0 * u * vn - 2.0 * v * un - 2.0 * uv * same
            bends[1, n, 0, k] = bends[0, k, 1, n]
    for i in range(4):
        for j in range(4):
            sign = (2.0 * (i % 2) - 1.0) * (2.0 * (j % 2) - 1.0)
            for k in range(3):
                for n in range(3):
                    out[3 * i + k, 3 * j + n] += sign * (
                        first * bends[i // 2, k, j // 2, n] + second * by[i // 2, k] * by[j // 2, n]
                    )
