"""Vectorised mean strains of the corner-sampled element, and the force of stresses on them.

The mean of the membrane strains at the four corners of an element, and the bending strain in its
middle. Control points come with the columns that a closed patch sees twice repeated at the end, so
that no loop has to turn round. What one column gives to its neighbours is stored first and
collected by a second loop, without which the compiler would not vectorise either. Nothing here is
compiled with fast-math: a state that was made of these strains is kept.
"""

from __future__ import annotations

import numpy as np
from numba import njit

PAD = 2
"""Empty places on either side of what columns are collected from."""


@njit(cache=True, error_model="numpy", forceinline=True)
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


@njit(cache=True, error_model="numpy", forceinline=True)
def _corner(p0, p1, q0, q1, i1, i2):
    """One component of a_1, a_2 at a corner."""
    return 0.5 * i1 * ((p1 - p0) + (q1 - q0)), 0.5 * i2 * ((q0 - p0) + (q1 - p1))


@njit(cache=True, error_model="numpy", forceinline=True)
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


@njit(cache=True, error_model="numpy")
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


@njit(cache=True, error_model="numpy", forceinline=True)
def _corner_forces(x, row, count, i1, i2, stress, g, work, out):
    """Add work and forces of a row of corners; g, shape (6, count + 2), has empty ends."""
    px, py, pz = x[0, row], x[1, row], x[2, row]
    qx, qy, qz = x[0, row + 1], x[1, row + 1], x[2, row + 1]
    s1, s2, s6 = stress[0], stress[1], stress[2]
    gx, gy, gz, fx, fy, fz = g[0], g[1], g[2], g[3], g[4], g[5]
    h1, h2 = 0.5 * i1, 0.5 * i2
    for k in range(count):
        x1, x2 = _corner(px[k], px[k + 1], qx[k], qx[k + 1], i1, i2)
        y1, y2 = _corner(py[k], py[k + 1], qy[k], qy[k + 1], i1, i2)
        z1, z2 = _corner(pz[k], pz[k + 1], qz[k], qz[k + 1], i1, i2)
        n1, n2, n6 = s1[k], s2[k], s6[k]
        gx[k + 1], fx[k + 1] = h1 * (n1 * x1 + n6 * x2), h2 * (n2 * x2 + n6 * x1)
        gy[k + 1], fy[k + 1] = h1 * (n1 * y1 + n6 * y2), h2 * (n2 * y2 + n6 * y1)
        gz[k + 1], fz[k + 1] = h1 * (n1 * z1 + n6 * z2), h2 * (n2 * z2 + n6 * z1)
        work[k] += 0.5 * n1 * (x1 * x1 + y1 * y1 + z1 * z1)
        work[k] += 0.5 * n2 * (x2 * x2 + y2 * y2 + z2 * z2) + n6 * (x1 * x2 + y1 * y2 + z1 * z2)
    for c in range(3):
        around, along, lower, upper = g[c], g[3 + c], out[c, row], out[c, row + 1]
        for k in range(count + 1):
            h, v = around[k] - around[k + 1], along[k] + along[k + 1]
            lower[k] += h - v
            upper[k] += h + v


@njit(cache=True, error_model="numpy")
def force(x, n_around, spacings, reference, stress, out):
    """Sum of stress . strain, J, and its derivative by the control points, added to `out`.

    Parameters
    ----------
    x, n_around, spacings, reference
        As in `strains`.
    stress : ndarray, shape (elements_along, 6, elements_around)
        Conjugate to the strains, element areas included, N m and N m2.
    out : ndarray, shape of x
        N.
    """
    i1, i2 = 1.0 / spacings[0], 1.0 / spacings[1]
    n_along, corners = x.shape[1] - 2, n_around + 1
    at_corner = np.zeros((3, corners))
    g, work = np.zeros((6, corners + 2)), np.zeros(corners)
    v = np.zeros((15, n_around + 2 * PAD))  # a_1, a_2, a_11, a_22, a_12
    for j in range(n_along + 1):
        at_corner[:] = 0.0
        for row in range(max(j - 1, 0), min(j + 1, n_along)):
            for part in range(3):
                target, source = at_corner[part], stress[row, part]
                for k in range(n_around):
                    target[k] += 0.25 * source[k]
                for k in range(n_around):
                    target[k + 1] += 0.25 * source[k]
        _corner_forces(x, j, corners, i1, i2, at_corner, g, work, out)
    h1, h2, s1, s2, s6 = 0.5 * i1, 0.5 * i2, i1 * i1, i2 * i2, 0.5 * i1 * i2
    for j in range(n_along):
        px, py, pz = x[0, j], x[1, j], x[2, j]
        qx, qy, qz = x[0, j + 1], x[1, j + 1], x[2, j + 1]
        rx, ry, rz = x[0, j + 2], x[1, j + 2], x[2, j + 2]
        n1, n2, n6, m1, m2, m6 = (
            stress[j, 0], stress[j, 1], stress[j, 2], stress[j, 3], stress[j, 4], stress[j, 5]
        )  # fmt: skip
        o1, o2, o6, b1, b2, b6, area = (
            reference[j, 0], reference[j, 1], reference[j, 2],
            reference[j, 3], reference[j, 4], reference[j, 5], reference[j, 6],
        )  # fmt: skip
        ax, ay, az, bx, by, bz = v[0], v[1], v[2], v[3], v[4], v[5]
        cx, cy, cz, dx, dy, dz = v[6], v[7], v[8], v[9], v[10], v[11]
        ex, ey, ez = v[12], v[13], v[14]
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
            inverse = 1.0 / (nx * nx + ny * ny + nz * nz)
            sigma = area[k] * inverse
            u1, u2, u6 = -sigma * m1[k], -sigma * m2[k], -2.0 * sigma * m6[k]
            wx = u1 * x11 + u2 * x22 + u6 * x12
            wy = u1 * y11 + u2 * y22 + u6 * y12
            wz = u1 * z11 + u2 * z22 + u6 * z12
            moved = wx * nx + wy * ny + wz * nz
            at_rest = m1[k] * b1[k] + m2[k] * b2[k] + m6[k] * b6[k]
            at_rest -= n1[k] * o1[k] + n2[k] * o2[k] + n6[k] * o6[k]
            work[k] += at_rest + moved
            f = -2.0 * inverse * moved
            wx, wy, wz = wx + f * nx, wy + f * ny, wz + f * nz
            ax[k + PAD], bx[k + PAD] = h1 * (y2 * wz - z2 * wy), h2 * (wy * z1 - wz * y1)
            ay[k + PAD], by[k + PAD] = h1 * (z2 * wx - x2 * wz), h2 * (wz * x1 - wx * z1)
            az[k + PAD], bz[k + PAD] = h1 * (x2 * wy - y2 * wx), h2 * (wx * y1 - wy * x1)
            u1, u2, u6 = s1 * u1, s2 * u2, s6 * u6
            cx[k + PAD], dx[k + PAD], ex[k + PAD] = u1 * nx, u2 * nx, u6 * nx
            cy[k + PAD], dy[k + PAD], ey[k + PAD] = u1 * ny, u2 * ny, u6 * ny
            cz[k + PAD], dz[k + PAD], ez[k + PAD] = u1 * nz, u2 * nz, u6 * nz
        for c in range(3):
            a, b, a11, a22, a12 = v[c], v[3 + c], v[6 + c], v[9 + c], v[12 + c]
            lower, middle, upper = out[c, j], out[c, j + 1], out[c, j + 2]
            for k in range(n_around + 2):
                slope = (a[k] - a[k + 2]) + (a11[k] + a11[k + 2]) - 2.0 * a11[k + 1]
                across = 0.125 * (b[k] + b[k + 2]) + 0.75 * b[k + 1] + 0.5 * (a12[k] - a12[k + 2])
                bent = 0.125 * (a22[k] + a22[k + 2]) + 0.75 * a22[k + 1]
                end = 0.125 * slope + bent
                lower[k] += end - across
                middle[k] += 0.75 * slope - 2.0 * bent
                upper[k] += end + across
    return np.sum(work)
