"""How the two sides of a closed contact slide on each other, and what a spring against it exerts.

A stencil is up to eight knots: the four of a contact and, where two edges touch, the knots across
them, so that either side is a patch of the surface. Sliding is the motion r of the points that were
closest once, seen by an observer who turns with the patches as Kabsch's rotation Q of their points
says: s = P Q^T r, P across the gap. So no rigid motion slides, however large. Its derivative needs
that of the rotation, J dQ = sum p_i x dx_i with p_i = Q r_i and J = sum (p_i . x_i) I - p_i x_i^T.
A force F of the spring pushes the points by a_i F - lambda x p_i with J lambda = r x F: no net
force and no net moment, and what each side gets beside F is a couple.
"""

from __future__ import annotations

import numpy as np
from numba import njit

POINTS = 8
"""Of a stencil; what it does not need has no weight and is no part of a patch."""
_ROUNDS, _TURNED = 30, 1e-15
"""Newton steps of a rotation at most, and the turn, rad, from which it stands."""


@njit(cache=True, error_model="numpy")
def centred(x, side, out):
    """Points from the middle of their own patch; zero of those in none.

    Parameters
    ----------
    x, out : ndarray, shape (POINTS, 3)
        m.
    side : ndarray of int, shape (POINTS,)
        0 or 1; -1 for what is in no patch.
    """
    for s in range(2):
        number = 0
        for i in range(POINTS):
            number += side[i] == s
        for c in range(3):
            mean = 0.0
            for i in range(POINTS):
                if side[i] == s:
                    mean += x[i, c]
            mean /= max(number, 1)
            for i in range(POINTS):
                if side[i] == s:
                    out[i, c] = x[i, c] - mean
    for i in range(POINTS):
        if side[i] < 0:
            out[i] = 0.0


@njit(cache=True, error_model="numpy")
def all_centred(knots, stencils, sides, out):
    """The same of all stencils, `out` of shape (n, POINTS, 3)."""
    x = np.empty((POINTS, 3))
    for n in range(len(stencils)):
        for i in range(POINTS):
            x[i] = knots[stencils[n, i]]
        centred(x, sides[n], out[n])


@njit(cache=True, error_model="numpy", forceinline=True)
def _cross(u, v, out):
    out[0] = u[1] * v[2] - u[2] * v[1]
    out[1] = u[2] * v[0] - u[0] * v[2]
    out[2] = u[0] * v[1] - u[1] * v[0]


@njit(cache=True, error_model="numpy")
def _solve(m, b, out):
    """out = m^-1 b, three by three."""
    c0 = m[1, 1] * m[2, 2] - m[1, 2] * m[2, 1]
    c1 = m[1, 2] * m[2, 0] - m[1, 0] * m[2, 2]
    c2 = m[1, 0] * m[2, 1] - m[1, 1] * m[2, 0]
    det = m[0, 0] * c0 + m[0, 1] * c1 + m[0, 2] * c2
    d0, d1, d2 = b[0], b[1], b[2]
    out[0] = (
        c0 * d0
        + (m[0, 2] * m[2, 1] - m[0, 1] * m[2, 2]) * d1
        + (m[0, 1] * m[1, 2] - m[0, 2] * m[1, 1]) * d2
    ) / det
    out[1] = (
        c1 * d0
        + (m[0, 0] * m[2, 2] - m[0, 2] * m[2, 0]) * d1
        + (m[0, 2] * m[1, 0] - m[0, 0] * m[1, 2]) * d2
    ) / det
    out[2] = (
        c2 * d0
        + (m[0, 1] * m[2, 0] - m[0, 0] * m[2, 1]) * d1
        + (m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]) * d2
    ) / det


@njit(cache=True, error_model="numpy")
def _inertia(p, x, out):
    """sum (p_i . x_i) I - p_i x_i^T."""
    out[:] = 0.0
    trace = 0.0
    for i in range(POINTS):
        for c in range(3):
            trace += p[i, c] * x[i, c]
            for d in range(3):
                out[c, d] -= p[i, c] * x[i, d]
    for c in range(3):
        out[c, c] += trace


@njit(cache=True, error_model="numpy")
def turned(arms, x, rotation, p, inertia):
    """Rotation that fits arms to points by least squares, turned arms, and J.

    Parameters
    ----------
    arms, x : ndarray, shape (POINTS, 3)
        From the middle of their patch, before and now, m.
    rotation, p, inertia : ndarray, shapes (3, 3), (POINTS, 3), (3, 3)
        Receive Q, p and J.
    """
    rotation[:] = 0.0
    for c in range(3):
        rotation[c, c] = 1.0
    pull, turn, moved, arm = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    for _ in range(_ROUNDS):
        for i in range(POINTS):
            for c in range(3):
                p[i, c] = (
                    rotation[c, 0] * arms[i, 0]
                    + rotation[c, 1] * arms[i, 1]
                    + rotation[c, 2] * arms[i, 2]
                )
        _inertia(p, x, inertia)
        pull[:] = 0.0
        for i in range(POINTS):
            _cross(p[i], x[i], arm)
            for c in range(3):
                pull[c] += arm[c]
        _solve(inertia, pull, turn)
        angle = np.sqrt(turn[0] ** 2 + turn[1] ** 2 + turn[2] ** 2)
        if not angle > _TURNED:
            return
        sine, versed = np.sin(angle) / angle, (1.0 - np.cos(angle)) / (angle * angle)
        for d in range(3):
            _cross(turn, rotation[:, d], moved)
            _cross(turn, moved, arm)
            for c in range(3):
                rotation[c, d] += sine * moved[c] + versed * arm[c]


@njit(cache=True, error_model="numpy")
def slid(a, x, rotation, normal, r, out):
    """r = sum a_i x_i and its part across the gap, as the observer sees it.

    Parameters
    ----------
    a : ndarray, shape (POINTS,)
    x : ndarray, shape (POINTS, 3)
    rotation : ndarray, shape (3, 3)
    normal : ndarray, shape (3,)
        Along the gap, before.
    r, out : ndarray, shape (3,)
        m.
    """
    r[:] = 0.0
    for i in range(POINTS):
        for c in range(3):
            r[c] += a[i] * x[i, c]
    along = 0.0
    for c in range(3):
        out[c] = rotation[0, c] * r[0] + rotation[1, c] * r[1] + rotation[2, c] * r[2]
        along += normal[c] * out[c]
    for c in range(3):
        out[c] -= along * normal[c]


@njit(cache=True, error_model="numpy")
def slides(knots, stencils, sides, weights, arms, normals):
    """How far the contacts have slid since their arms were measured, shape (n, 3), m."""
    x, local, p = np.empty((POINTS, 3)), np.empty((POINTS, 3)), np.empty((POINTS, 3))
    rotation, inertia, r = np.empty((3, 3)), np.empty((3, 3)), np.empty(3)
    out = np.empty((len(stencils), 3))
    for n in range(len(stencils)):
        for i in range(POINTS):
            x[i] = knots[stencils[n, i]]
        centred(x, sides[n], local)
        turned(arms[n], local, rotation, p, inertia)
        slid(weights[n], x, rotation, normals[n], r, out[n])
    return out


@njit(cache=True, error_model="numpy")
def carried(knots, stencils, sides, arms, vectors):
    """Vectors that turn with the patches, shape (n, 3)."""
    x, local, p = np.empty((POINTS, 3)), np.empty((POINTS, 3)), np.empty((POINTS, 3))
    rotation, inertia = np.empty((3, 3)), np.empty((3, 3))
    out = np.empty((len(stencils), 3))
    for n in range(len(stencils)):
        for i in range(POINTS):
            x[i] = knots[stencils[n, i]]
        centred(x, sides[n], local)
        turned(arms[n], local, rotation, p, inertia)
        out[n] = rotation @ vectors[n]
    return out


@njit(cache=True, error_model="numpy")
def push(knots, stencils, sides, weights, arms, normals, stretched, stiffness, forces):
    """Add what springs exert to the forces on the knots, N; return their energy, J.

    Parameters
    ----------
    stretched : ndarray, shape (n, 3)
        What the springs had been stretched by beside the sliding since, m.
    stiffness : float
        N/m.
    forces : ndarray, shape (count, 3)
    """
    x, local, p = np.empty((POINTS, 3)), np.empty((POINTS, 3)), np.empty((POINTS, 3))
    rotation, inertia = np.empty((3, 3)), np.empty((3, 3))
    r, s, pull, moment, turn, arm = (
        np.empty(3), np.empty(3), np.empty(3), np.empty(3), np.empty(3), np.empty(3),
    )  # fmt: skip
    total = 0.0
    for n in range(len(stencils)):
        for i in range(POINTS):
            x[i] = knots[stencils[n, i]]
        centred(x, sides[n], local)
        turned(arms[n], local, rotation, p, inertia)
        slid(weights[n], x, rotation, normals[n], r, s)
        for c in range(3):
            s[c] += stretched[n, c]
            total += 0.5 * stiffness * s[c] * s[c]
        for c in range(3):
            pull[c] = stiffness * (
                rotation[c, 0] * s[0] + rotation[c, 1] * s[1] + rotation[c, 2] * s[2]
            )
        _cross(r, pull, moment)
        _solve(inertia, moment, turn)
        for i in range(POINTS):
            _cross(turn, p[i], arm)
            for c in range(3):
                forces[stencils[n, i], c] += weights[n, i] * pull[c] - arm[c]
    return total


@njit(cache=True, error_model="numpy")
def stiffness_blocks(
    knots, stencils, sides, weights, arms, normals, stretched, stiffness, slipping
):
    """Derivative of what springs exert, shape (n, 24, 24), N/m.

    Parameters
    ----------
    slipping : ndarray, shape (n,)
        Of a contact that slips: the length over which its spring would be stretched if it stuck,
        relative to that which it has, so that its force only turns; 1 where it sticks.
    """
    x, local, p = np.empty((POINTS, 3)), np.empty((POINTS, 3)), np.empty((POINTS, 3))
    rotation, inertia = np.empty((3, 3)), np.empty((3, 3))
    r, s, pull, moment, turn = np.empty(3), np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    dtheta, dr, seen, ds, dpull = np.empty(3), np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    dmoment, dturn, one, two = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    dp, dinertia, other = np.empty((POINTS, 3)), np.empty((3, 3)), np.empty((3, 3))
    way = np.zeros((POINTS, 3))
    out = np.empty((len(stencils), 3 * POINTS, 3 * POINTS))
    for n in range(len(stencils)):
        for i in range(POINTS):
            x[i] = knots[stencils[n, i]]
        centred(x, sides[n], local)
        turned(arms[n], local, rotation, p, inertia)
        slid(weights[n], x, rotation, normals[n], r, s)
        s += stretched[n]
        pull[:] = stiffness * (rotation @ s)
        _cross(r, pull, moment)
        _solve(inertia, moment, turn)
        length = np.sqrt(np.sum(s * s))
        for j in range(3 * POINTS):
            way[j // 3, j % 3] = 1.0
            _cross(p[j // 3], way[j // 3], one)
            _solve(inertia, one, dtheta)
            dr[:] = weights[n, j // 3] * way[j // 3]
            _cross(dtheta, r, one)
            seen[:] = dr - one
            ds[:] = rotation.T @ seen
            ds -= np.sum(ds * normals[n]) * normals[n]
            if slipping[n] > 1.0:
                ds -= np.sum(ds * s) / (length * length) * s
                ds /= slipping[n]
            _cross(dtheta, pull, one)
            dpull[:] = one + stiffness * (rotation @ ds)
            _cross(dr, pull, one)
            _cross(r, dpull, two)
            dmoment[:] = one + two
            for i in range(POINTS):
                _cross(dtheta, p[i], one)
                dp[i] = one
            _inertia(dp, local, dinertia)
            _inertia(p, way, other)
            dmoment -= (dinertia + other) @ turn
            _solve(inertia, dmoment, dturn)
            for i in range(POINTS):
                _cross(dturn, p[i], one)
                _cross(turn, dp[i], two)
                for c in range(3):
                    out[n, 3 * i + c, j] = weights[n, i] * dpull[c] - one[c] - two[c]
            way[j // 3, j % 3] = 0.0
    return out
