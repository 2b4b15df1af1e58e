"""Vectorised mean strains of the corner-sampled element.

The mean of the membrane strains at the four corners of an element, and the bending strain in its
middle. Control points come with the columns that a closed patch sees twice repeated at the end, so
that no loop has to turn round. Nothing here is compiled with fast-math: a state that was made of
these strains is kept.
"""

from __future__ import annotations

import numpy as np
from numba import njit

PAD = 2
"""Columns that a closed patch sees twice."""


@njit(cache=True, error_model="numpy", forceinline=True, fastmath={"contract"})
def _derivatives(p0, p1, p2, q0, q1, q2, r0, r1, r2, i1, i2):
    """One component of a_1, a_2, a_11, a_22, a_12 in the middle of an element."""
    v0, d0, c0 = (p0 + r0) + 6.0 * q0, r0 - p0, (p0 + r0) - 2.0 * q0
    v1, d1, c1 = (p1 + r1) + 6.0 * q1, r1 - p1, (p1 + r1) - 2.0 * q1
    v2, d2, c2 = (p2 + r2) + 6.0 * q2, r2 - p2, (p2 + r2) - 2.0 * q2
    return (
        0.0625 * i1 * (v2 - v0),
        0.0625 * i2 * ((d0 + d2) + 6.0 * d1),
        0.125 * i1 * i1 * ((v2 + v0) - 2.0 * v1),
        0.125 * i2 * i2 * ((c0 + c2) + 6.0 * c1),
        0.25 * i1 * i2 * (d2 - d0),
    )


@njit(cache=True, error_model="numpy", forceinline=True, fastmath={"contract"})
def _corner(p0, p1, q0, q1, i1, i2):
    """One component of a_1, a_2 at a corner."""
    return 0.5 * i1 * ((p1 - p0) + (q1 - q0)), 0.5 * i2 * ((q0 - p0) + (q1 - p1))


@njit(cache=True, error_model="numpy", forceinline=True, fastmath={"contract"})
def _metrics(x, row, count, i1, i2, out):
    """a_11 / 2, a_22 / 2 and a_12 of a row of corners."""
    px, py, pz = x[0, row], x[1, row], x[2, row]
    qx, qy, qz = x[0, row + 1], x[1, row + 1], x[2, row + 1]
    m1, m2, m6 = out[0], out[1], out[2]
    for k in range(count):
        x1, x2 = _corner(px[k], px[k + 1], qx[k], qx[k + 1], i1, i2)
        y1, y2 = _corner(py[k], py[k + 1], qy[k], qy[k + 1], i1, i2)
        z1, z2 = _corner(pz[k], pz[k + 1], qz[k], qz[k + 1], i1, i2)
        m1[k] = 0.5 * (x1 * x1 + y1 * y1 + z1 * z1)
        m2[k] = 0.5 * (x2 * x2 + y2 * y2 + z2 * z2)
        m6[k] = x1 * x2 + y1 * y2 + z1 * z2


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def strains(x, n_around, spacings, reference, out):
    """Mean membrane strains and bending strains of the elements.

    Parameters
    ----------
    x : ndarray, shape (3, rows, n_around + 2)
        Control points, m.
    n_around : int
        Elements around.
    spacings : tuple of float
        Element lengths around and along, m.
    reference : ndarray, shape (elements_along, 7, elements_around)
        Of the stress-free shape: mean of a_11 / 2, a_22 / 2, a_12; b_11, b_22, 2 b_12; |a_1 x a_2|.
    out : ndarray, shape (elements_along, 6, elements_around)
        Receives e_11, e_22, 2 e_12 and k_11, k_22, 2 k_12 (1/m).
    """
    i1, i2 = 1.0 / spacings[0], 1.0 / spacings[1]
    below, above = np.empty((3, n_around + 1)), np.empty((3, n_around + 1))
    _metrics(x, 0, n_around + 1, i1, i2, below)
    for j in range(x.shape[1] - 2):
        _metrics(x, j + 1, n_around + 1, i1, i2, above)
        for part in range(3):
            lower, upper, target, rest = below[part], above[part], out[j, part], reference[j, part]
            for k in range(n_around):
                total = (lower[k] + lower[k + 1]) + (upper[k] + upper[k + 1])
                target[k] = 0.25 * total - rest[k]
        below, above = above, below
        px, py, pz = x[0, j], x[1, j], x[2, j]
        qx, qy, qz = x[0, j + 1], x[1, j + 1], x[2, j + 1]
        rx, ry, rz = x[0, j + 2], x[1, j + 2], x[2, j + 2]
        b1, b2, b6, area = reference[j, 3], reference[j, 4], reference[j, 5], reference[j, 6]
        k1, k2, k6 = out[j, 3], out[j, 4], out[j, 5]
        for k in range(n_around):
            x1, x2, x11, x22, x12 = _derivatives(
                px[k], px[k + 1], px[k + 2], qx[k], qx[k + 1], qx[k + 2],
                rx[k], rx[k + 1], rx[k + 2], i1, i2,
            )  # fmt: skip
            y1, y2, y11, y22, y12 = _derivatives(
                py[k], py[k + 1], py[k + 2], qy[k], qy[k + 1], qy[k + 2],
                ry[k], ry[k + 1], ry[k + 2], i1, i2,
            )  # fmt: skip
            z1, z2, z11, z22, z12 = _derivatives(
                pz[k], pz[k + 1], pz[k + 2], qz[k], qz[k + 1], qz[k + 2],
                rz[k], rz[k + 1], rz[k + 2], i1, i2,
            )  # fmt: skip
            nx, ny, nz = y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2
            sigma = area[k] / (nx * nx + ny * ny + nz * nz)
            k1[k] = b1[k] - sigma * (x11 * nx + y11 * ny + z11 * nz)
            k2[k] = b2[k] - sigma * (x22 * nx + y22 * ny + z22 * nz)
            k6[k] = b6[k] - 2.0 * sigma * (x12 * nx + y12 * ny + z12 * nz)
