"""Vectorised energy and internal force of the corner-sampled sheet (see `sampling.corner`).

One element row at a time, up to `CHUNK` elements of it as one vectorised loop. Lanes are either
the knot lines across the row (with the membrane strains at their lower and upper end, and in
between for the checkerboard control) or its elements (with the bending strains at their middle).
A constant stride lets the compiler see that the work arrays do not overlap, without which it does
not vectorise.
"""

from __future__ import annotations

import numpy as np
from numba import njit

CHUNK = 64
_WIDE = CHUNK + 4
VALUES = 25
"""Values kept per lane: 7 metrics and 6 law coefficients at the knot line; 2 metrics, 4 of the
curvature and 6 law coefficients at the element."""

# rows of the work array: lanes of one quantity each, three rows for a vector
_P, _Q, _R = 0, 3, 6  # control rows below, at and above the element row
_V, _D, _S = 9, 12, 15  # their value, slope and second derivative along at the middle
_A1B, _A2B, _A1T, _A2T, _A1M = 18, 21, 24, 27, 30  # base vectors at the knot line
_N1B, _N2B, _N6B, _N1T, _N2T, _N6T, _QM = 33, 34, 35, 36, 37, 38, 39  # stresses there
_E2B, _E2T = 40, 41
_LOW, _HIGH = 42, 51  # force of the knot line on its lower and higher column, rows P, Q, R
_VALUE = 60  # element vectors spread with the value around, rows P, Q, R
_G1, _G12, _G11 = 69, 72, 75  # element vectors conjugate to a_1, a_12, a_11
_ENERGY = 78  # membrane, bending, stabilisation
_DB, _DT = 81, 82
_ROWS = 83


@njit(cache=True, fastmath=True, error_model="numpy")
def _load(w, x, j, start, n, columns, i2):
    """Control rows j, j + 1, j + 2 and their combinations at the element middle."""
    inside = min(n + 2, columns - start)
    for c in range(3):
        for row in range(3):
            source = x[c, j + row]
            to = (_P + 3 * row + c) * _WIDE
            for k in range(inside):
                w[to + k] = source[start + k]
            for k in range(inside, n + 2):
                w[to + k] = source[start + k - columns]
    h2 = 0.5 * i2
    s2 = i2 * i2
    for c in range(3):
        for k in range(n + 2):
            p = w[(_P + c) * _WIDE + k]
            q = w[(_Q + c) * _WIDE + k]
            r = w[(_R + c) * _WIDE + k]
            w[(_V + c) * _WIDE + k] = 0.125 * (p + r) + 0.75 * q
            w[(_D + c) * _WIDE + k] = (r - p) * h2
            w[(_S + c) * _WIDE + k] = (p - 2.0 * q + r) * s2


@njit(cache=True, fastmath=True, error_model="numpy")
def _knot_strains(w, data, n, i1, i2, chi):
    """Membrane strains and stresses at both ends of the knot lines, and their deviation between."""
    for c in range(3):
        for k in range(n + 1):
            p0 = w[(_P + c) * _WIDE + k]
            p1 = w[(_P + c) * _WIDE + k + 1]
            q0 = w[(_Q + c) * _WIDE + k]
            q1 = w[(_Q + c) * _WIDE + k + 1]
            r0 = w[(_R + c) * _WIDE + k]
            r1 = w[(_R + c) * _WIDE + k + 1]
            dp = (p1 - p0) * i1
            dq = (q1 - q0) * i1
            dr = (r1 - r0) * i1
            w[(_A1B + c) * _WIDE + k] = 0.5 * (dp + dq)
            w[(_A1T + c) * _WIDE + k] = 0.5 * (dq + dr)
            w[(_A1M + c) * _WIDE + k] = 0.125 * (dp + dr) + 0.75 * dq
            w[(_A2B + c) * _WIDE + k] = 0.5 * i2 * (q0 + q1 - p0 - p1)
            w[(_A2T + c) * _WIDE + k] = 0.5 * i2 * (r0 + r1 - q0 - q1)
    for k in range(n + 1):
        x1 = w[_A1B * _WIDE + k]
        y1 = w[(_A1B + 1) * _WIDE + k]
        z1 = w[(_A1B + 2) * _WIDE + k]
        x2 = w[_A2B * _WIDE + k]
        y2 = w[(_A2B + 1) * _WIDE + k]
        z2 = w[(_A2B + 2) * _WIDE + k]
        e1 = 0.5 * (x1 * x1 + y1 * y1 + z1 * z1) - data[k]
        e2 = 0.5 * (x2 * x2 + y2 * y2 + z2 * z2) - data[_WIDE + k]
        e6 = x1 * x2 + y1 * y2 + z1 * z2 - data[2 * _WIDE + k]
        x1 = w[_A1T * _WIDE + k]
        y1 = w[(_A1T + 1) * _WIDE + k]
        z1 = w[(_A1T + 2) * _WIDE + k]
        x2 = w[_A2T * _WIDE + k]
        y2 = w[(_A2T + 1) * _WIDE + k]
        z2 = w[(_A2T + 2) * _WIDE + k]
        f1 = 0.5 * (x1 * x1 + y1 * y1 + z1 * z1) - data[3 * _WIDE + k]
        f2 = 0.5 * (x2 * x2 + y2 * y2 + z2 * z2) - data[4 * _WIDE + k]
        f6 = x1 * x2 + y1 * y2 + z1 * z2 - data[5 * _WIDE + k]
        x1 = w[_A1M * _WIDE + k]
        y1 = w[(_A1M + 1) * _WIDE + k]
        z1 = w[(_A1M + 2) * _WIDE + k]
        deviation = 0.5 * (x1 * x1 + y1 * y1 + z1 * z1) - data[6 * _WIDE + k] - 0.5 * (e1 + f1)
        c11 = data[7 * _WIDE + k]
        c22 = data[8 * _WIDE + k]
        c12 = data[9 * _WIDE + k]
        c16 = data[10 * _WIDE + k]
        c26 = data[11 * _WIDE + k]
        c66 = data[12 * _WIDE + k]
        n1 = c11 * e1 + c12 * e2 + c16 * e6
        n2 = c12 * e1 + c22 * e2 + c26 * e6
        n6 = c16 * e1 + c26 * e2 + c66 * e6
        m1 = c11 * f1 + c12 * f2 + c16 * f6
        m2 = c12 * f1 + c22 * f2 + c26 * f6
        m6 = c16 * f1 + c26 * f2 + c66 * f6
        q = 2.0 * chi * c11 * deviation
        w[_ENERGY * _WIDE + k] = 0.5 * (n1 * e1 + n2 * e2 + n6 * e6 + m1 * f1 + m2 * f2 + m6 * f6)
        w[(_ENERGY + 2) * _WIDE + k] = 0.5 * q * deviation
        w[_N1B * _WIDE + k] = n1 - 0.5 * q
        w[_N2B * _WIDE + k] = n2
        w[_N6B * _WIDE + k] = n6
        w[_N1T * _WIDE + k] = m1 - 0.5 * q
        w[_N2T * _WIDE + k] = m2
        w[_N6T * _WIDE + k] = m6
        w[_QM * _WIDE + k] = q
        w[_E2B * _WIDE + k] = e2
        w[_E2T * _WIDE + k] = f2


@njit(cache=True, fastmath=True, error_model="numpy")
def _edge_deviations(w, data, n, i2, chi):
    """Deviation of strain 22 in the middle of the lower and upper edge from its two corners."""
    for i in range(n):
        law = 0.5 * chi * data[20 * _WIDE + i]
        lower = -data[13 * _WIDE + i]
        upper = -data[14 * _WIDE + i]
        for c in range(3):
            p = 0.125 * (w[(_P + c) * _WIDE + i] + w[(_P + c) * _WIDE + i + 2]) + (
                0.75 * w[(_P + c) * _WIDE + i + 1]
            )
            q = 0.125 * (w[(_Q + c) * _WIDE + i] + w[(_Q + c) * _WIDE + i + 2]) + (
                0.75 * w[(_Q + c) * _WIDE + i + 1]
            )
            r = 0.125 * (w[(_R + c) * _WIDE + i] + w[(_R + c) * _WIDE + i + 2]) + (
                0.75 * w[(_R + c) * _WIDE + i + 1]
            )
            b = i2 * (q - p)
            t = i2 * (r - q)
            lower += 0.5 * b * b
            upper += 0.5 * t * t
            w[(_VALUE + c) * _WIDE + i + 2] = b
            w[(_VALUE + 6 + c) * _WIDE + i + 2] = t
        lower -= 0.5 * (w[_E2B * _WIDE + i] + w[_E2B * _WIDE + i + 1])
        upper -= 0.5 * (w[_E2T * _WIDE + i] + w[_E2T * _WIDE + i + 1])
        w[(_ENERGY + 2) * _WIDE + i] += 0.5 * law * (lower * lower + upper * upper)
        w[_DB * _WIDE + i + 1] = law * lower
        w[_DT * _WIDE + i + 1] = law * upper
    w[_DB * _WIDE] = 0.0
    w[_DT * _WIDE] = 0.0
    w[_DB * _WIDE + n + 1] = 0.0
    w[_DT * _WIDE + n + 1] = 0.0
    for k in range(n + 1):
        w[_N2B * _WIDE + k] -= 0.5 * (w[_DB * _WIDE + k] + w[_DB * _WIDE + k + 1])
        w[_N2T * _WIDE + k] -= 0.5 * (w[_DT * _WIDE + k] + w[_DT * _WIDE + k + 1])
    for i in range(n):
        for c in range(3):
            b = i2 * w[_DB * _WIDE + i + 1] * w[(_VALUE + c) * _WIDE + i + 2]
            t = i2 * w[_DT * _WIDE + i + 1] * w[(_VALUE + 6 + c) * _WIDE + i + 2]
            w[(_VALUE + c) * _WIDE + i + 2] = -b
            w[(_VALUE + 3 + c) * _WIDE + i + 2] = b - t
            w[(_VALUE + 6 + c) * _WIDE + i + 2] = t


@njit(cache=True, fastmath=True, error_model="numpy")
def _knot_forces(w, n, i1, i2):
    """Spread the stresses of the knot lines to their two columns."""
    for c in range(3):
        for k in range(n + 1):
            a1b = w[(_A1B + c) * _WIDE + k]
            a2b = w[(_A2B + c) * _WIDE + k]
            a1t = w[(_A1T + c) * _WIDE + k]
            a2t = w[(_A2T + c) * _WIDE + k]
            h1b = w[_N1B * _WIDE + k] * a1b + w[_N6B * _WIDE + k] * a2b
            h2b = w[_N2B * _WIDE + k] * a2b + w[_N6B * _WIDE + k] * a1b
            h1t = w[_N1T * _WIDE + k] * a1t + w[_N6T * _WIDE + k] * a2t
            h2t = w[_N2T * _WIDE + k] * a2t + w[_N6T * _WIDE + k] * a1t
            hm = w[_QM * _WIDE + k] * w[(_A1M + c) * _WIDE + k]
            up = i1 * (0.5 * h1b + 0.125 * hm)
            uq = i1 * (0.5 * (h1b + h1t) + 0.75 * hm)
            ur = i1 * (0.5 * h1t + 0.125 * hm)
            sp = -0.5 * i2 * h2b
            sq = 0.5 * i2 * (h2b - h2t)
            sr = 0.5 * i2 * h2t
            w[(_LOW + c) * _WIDE + k + 1] = sp - up
            w[(_HIGH + c) * _WIDE + k + 1] = sp + up
            w[(_LOW + 3 + c) * _WIDE + k + 1] = sq - uq
            w[(_HIGH + 3 + c) * _WIDE + k + 1] = sq + uq
            w[(_LOW + 6 + c) * _WIDE + k + 1] = sr - ur
            w[(_HIGH + 6 + c) * _WIDE + k + 1] = sr + ur


@njit(cache=True, fastmath=True, error_model="numpy")
def _bend(w, data, n, i1, i2, bend):
    """Bending energy at the element middles and the vectors conjugate to their derivatives."""
    h1 = 0.5 * i1
    s1 = i1 * i1
    h2 = 0.5 * i2
    s2 = i2 * i2
    for i in range(n):
        x1 = (w[_V * _WIDE + i + 2] - w[_V * _WIDE + i]) * h1
        y1 = (w[(_V + 1) * _WIDE + i + 2] - w[(_V + 1) * _WIDE + i]) * h1
        z1 = (w[(_V + 2) * _WIDE + i + 2] - w[(_V + 2) * _WIDE + i]) * h1
        x2 = 0.125 * (w[_D * _WIDE + i] + w[_D * _WIDE + i + 2]) + 0.75 * w[_D * _WIDE + i + 1]
        y2 = 0.125 * (w[(_D + 1) * _WIDE + i] + w[(_D + 1) * _WIDE + i + 2]) + (
            0.75 * w[(_D + 1) * _WIDE + i + 1]
        )
        z2 = 0.125 * (w[(_D + 2) * _WIDE + i] + w[(_D + 2) * _WIDE + i + 2]) + (
            0.75 * w[(_D + 2) * _WIDE + i + 1]
        )
        x11 = (w[_V * _WIDE + i] - 2.0 * w[_V * _WIDE + i + 1] + w[_V * _WIDE + i + 2]) * s1
        y11 = (
            w[(_V + 1) * _WIDE + i]
            - 2.0 * w[(_V + 1) * _WIDE + i + 1]
            + w[(_V + 1) * _WIDE + i + 2]
        ) * s1
        z11 = (
            w[(_V + 2) * _WIDE + i]
            - 2.0 * w[(_V + 2) * _WIDE + i + 1]
            + w[(_V + 2) * _WIDE + i + 2]
        ) * s1
        x22 = 0.125 * (w[_S * _WIDE + i] + w[_S * _WIDE + i + 2]) + 0.75 * w[_S * _WIDE + i + 1]
        y22 = 0.125 * (w[(_S + 1) * _WIDE + i] + w[(_S + 1) * _WIDE + i + 2]) + (
            0.75 * w[(_S + 1) * _WIDE + i + 1]
        )
        z22 = 0.125 * (w[(_S + 2) * _WIDE + i] + w[(_S + 2) * _WIDE + i + 2]) + (
            0.75 * w[(_S + 2) * _WIDE + i + 1]
        )
        x12 = (w[_D * _WIDE + i + 2] - w[_D * _WIDE + i]) * h1
        y12 = (w[(_D + 1) * _WIDE + i + 2] - w[(_D + 1) * _WIDE + i]) * h1
        z12 = (w[(_D + 2) * _WIDE + i + 2] - w[(_D + 2) * _WIDE + i]) * h1
        nx = y1 * z2 - z1 * y2
        ny = z1 * x2 - x1 * z2
        nz = x1 * y2 - y1 * x2
        ri = 1.0 / (nx * nx + ny * ny + nz * nz)
        # b_ab J_0 / J = (a_,ab . N) J_0 / J^2
        sigma = data[18 * _WIDE + i] * ri
        t1 = x11 * nx + y11 * ny + z11 * nz
        t2 = x22 * nx + y22 * ny + z22 * nz
        t6 = 2.0 * (x12 * nx + y12 * ny + z12 * nz)
        k1 = data[15 * _WIDE + i] - sigma * t1
        k2 = data[16 * _WIDE + i] - sigma * t2
        k6 = data[17 * _WIDE + i] - sigma * t6
        c11 = bend * data[19 * _WIDE + i]
        c22 = bend * data[20 * _WIDE + i]
        c12 = bend * data[21 * _WIDE + i]
        c16 = bend * data[22 * _WIDE + i]
        c26 = bend * data[23 * _WIDE + i]
        c66 = bend * data[24 * _WIDE + i]
        m1 = c11 * k1 + c12 * k2 + c16 * k6
        m2 = c12 * k1 + c22 * k2 + c26 * k6
        m6 = c16 * k1 + c26 * k2 + c66 * k6
        w[(_ENERGY + 1) * _WIDE + i] = 0.5 * (m1 * k1 + m2 * k2 + m6 * k6)
        s1_ = -sigma * m1
        s2_ = -sigma * m2
        s6_ = -2.0 * sigma * m6
        # derivative with respect to N: -sigma P + 2 sigma (P.N) N / J^2, P = m^ab a_,ab
        f = 2.0 * sigma * ri * (m1 * t1 + m2 * t2 + m6 * t6)
        qx = s1_ * x11 + s2_ * x22 + s6_ * x12 + f * nx
        qy = s1_ * y11 + s2_ * y22 + s6_ * y12 + f * ny
        qz = s1_ * z11 + s2_ * z22 + s6_ * z12 + f * nz
        w[_G1 * _WIDE + i + 2] = y2 * qz - z2 * qy
        w[(_G1 + 1) * _WIDE + i + 2] = z2 * qx - x2 * qz
        w[(_G1 + 2) * _WIDE + i + 2] = x2 * qy - y2 * qx
        gx = h2 * (qy * z1 - qz * y1)
        gy = h2 * (qz * x1 - qx * z1)
        gz = h2 * (qx * y1 - qy * x1)
        w[_G11 * _WIDE + i + 2] = s1_ * nx
        w[(_G11 + 1) * _WIDE + i + 2] = s1_ * ny
        w[(_G11 + 2) * _WIDE + i + 2] = s1_ * nz
        w[_G12 * _WIDE + i + 2] = s6_ * nx
        w[(_G12 + 1) * _WIDE + i + 2] = s6_ * ny
        w[(_G12 + 2) * _WIDE + i + 2] = s6_ * nz
        cx = s2 * s2_ * nx
        cy = s2 * s2_ * ny
        cz = s2 * s2_ * nz
        w[_VALUE * _WIDE + i + 2] += cx - gx
        w[(_VALUE + 1) * _WIDE + i + 2] += cy - gy
        w[(_VALUE + 2) * _WIDE + i + 2] += cz - gz
        w[(_VALUE + 3) * _WIDE + i + 2] -= 2.0 * cx
        w[(_VALUE + 4) * _WIDE + i + 2] -= 2.0 * cy
        w[(_VALUE + 5) * _WIDE + i + 2] -= 2.0 * cz
        w[(_VALUE + 6) * _WIDE + i + 2] += cx + gx
        w[(_VALUE + 7) * _WIDE + i + 2] += cy + gy
        w[(_VALUE + 8) * _WIDE + i + 2] += cz + gz


@njit(cache=True, fastmath=True, error_model="numpy")
def _collect(w, n, i1, i2):
    """Force on the columns of the three control rows, left in the rows of the control points."""
    h1 = 0.5 * i1
    s1 = i1 * i1
    h2 = 0.5 * i2
    for c in range(3):
        for k in range(n + 2):
            # transposed stencils around: column k collects elements k, k - 1, k - 2
            g1 = h1 * (w[(_G1 + c) * _WIDE + k] - w[(_G1 + c) * _WIDE + k + 2])
            g11 = s1 * (
                w[(_G11 + c) * _WIDE + k]
                - 2.0 * w[(_G11 + c) * _WIDE + k + 1]
                + w[(_G11 + c) * _WIDE + k + 2]
            )
            g12 = h2 * h1 * (w[(_G12 + c) * _WIDE + k] - w[(_G12 + c) * _WIDE + k + 2])
            middle = g1 + g11
            vp = 0.125 * (w[(_VALUE + c) * _WIDE + k] + w[(_VALUE + c) * _WIDE + k + 2]) + (
                0.75 * w[(_VALUE + c) * _WIDE + k + 1]
            )
            vq = 0.125 * (w[(_VALUE + 3 + c) * _WIDE + k] + w[(_VALUE + 3 + c) * _WIDE + k + 2]) + (
                0.75 * w[(_VALUE + 3 + c) * _WIDE + k + 1]
            )
            vr = 0.125 * (w[(_VALUE + 6 + c) * _WIDE + k] + w[(_VALUE + 6 + c) * _WIDE + k + 2]) + (
                0.75 * w[(_VALUE + 6 + c) * _WIDE + k + 1]
            )
            lp = w[(_LOW + c) * _WIDE + k + 1] + w[(_HIGH + c) * _WIDE + k]
            lq = w[(_LOW + 3 + c) * _WIDE + k + 1] + w[(_HIGH + 3 + c) * _WIDE + k]
            lr = w[(_LOW + 6 + c) * _WIDE + k + 1] + w[(_HIGH + 6 + c) * _WIDE + k]
            w[(_P + c) * _WIDE + k] = lp + vp + 0.125 * middle - g12
            w[(_Q + c) * _WIDE + k] = lq + vq + 0.75 * middle
            w[(_R + c) * _WIDE + k] = lr + vr + 0.125 * middle + g12


@njit(cache=True, fastmath=True)
def _add_energies(w, n, energy):
    """Sum apart from the element loops, in which its order depended on where the arrays lay."""
    membrane, bending, stabilisation = 0.0, 0.0, 0.0
    for k in range(n + 1):
        membrane += w[_ENERGY * _WIDE + k]
        stabilisation += w[(_ENERGY + 2) * _WIDE + k]
    for i in range(n):
        bending += w[(_ENERGY + 1) * _WIDE + i]
    energy[0] += membrane
    energy[1] += bending
    energy[2] += stabilisation


@njit(cache=True, fastmath=True, error_model="numpy")
def internal_force(x, n_around, data, spacings, factors, force):
    """Internal force, the derivative of the strain energy with respect to the control points.

    Parameters
    ----------
    x : ndarray, shape (3, rows, columns)
        Control points, m; C order.
    n_around : int
        Elements around: as many as columns on a periodic patch, two less on an open one.
    data : ndarray
        From `pack`.
    spacings, factors : tuple of float
        Element lengths around and along, m; t^2/12, m2, and the stabilisation.
    force : ndarray, shape (3, rows, columns)
        Receives the force, N.

    Returns
    -------
    ndarray, shape (3,)
        Membrane, bending and stabilisation energy, J.
    """
    n_along, columns = x.shape[1] - 2, x.shape[2]
    i1, i2 = 1.0 / spacings[0], 1.0 / spacings[1]
    bend, chi = factors
    w = np.zeros(_ROWS * _WIDE)
    energy = np.zeros(3)
    force[:] = 0.0
    n_chunks = (n_around + CHUNK - 1) // CHUNK
    for j in range(n_along):
        for chunk in range(n_chunks):
            start = chunk * CHUNK
            n = min(CHUNK, n_around - start)
            at = (j * n_chunks + chunk) * VALUES * _WIDE
            # a slice, not an offset, or else the overlap checks of the compiler reach too far and
            # the order of sums depends on where the work array happens to lie
            lanes = data[at : at + VALUES * _WIDE]
            _load(w, x, j, start, n, columns, i2)
            _knot_strains(w, lanes, n, i1, i2, chi)
            for row in range(_VALUE, _ENERGY):
                w[row * _WIDE + n + 2] = 0.0
                w[row * _WIDE + n + 3] = 0.0
            for row in range(_LOW, _HIGH):
                w[row * _WIDE + n + 2] = 0.0
            _edge_deviations(w, lanes, n, i2, chi)
            _knot_forces(w, n, i1, i2)
            _bend(w, lanes, n, i1, i2, bend)
            _add_energies(w, n, energy)
            _collect(w, n, i1, i2)
            inside = min(n + 2, columns - start)
            for c in range(3):
                for row in range(3):
                    target = force[c, j + row]
                    source = (_P + 3 * row + c) * _WIDE
                    for k in range(inside):
                        target[start + k] += w[source + k]
                    for k in range(inside, n + 2):
                        target[start + k - columns] += w[source + k]
    return energy


def pack(samples: np.ndarray, law: np.ndarray, periodic: bool) -> np.ndarray:
    """Element data in the order in which `internal_force` reads them: row, chunk, value, lane.

    Parameters
    ----------
    samples : ndarray, shape (elements_along, elements_around, 20)
        Reference samples of `sampling.corner`: membrane at 4 corners and 4 edges, bending.
    law : ndarray, shape (elements_along, 6, elements_around)
    periodic : bool
    """
    n_along, n_around, _ = samples.shape
    n_chunks = -(-n_around // CHUNK)
    # knot line k is the left one of element k; the last is the right one of the last element
    left = samples[:, :, [0, 1, 2, 6, 7, 8, 12]]
    right = samples[:, -1:, [3, 4, 5, 9, 10, 11, 13]]
    knots = np.concatenate([left, right], axis=1).transpose(0, 2, 1)
    knot_law = np.zeros((n_along, 6, n_around + 1))
    knot_law[:, :, :-1] += 0.25 * law
    if periodic:
        knot_law[:, :, :-1] += 0.25 * np.roll(law, 1, axis=2)
    else:
        knot_law[:, :, 1:] += 0.25 * law
    elements = np.concatenate(
        [samples[:, :, [14, 15, 16, 17, 18, 19]].transpose(0, 2, 1), law], axis=1
    )
    packed = np.zeros((n_along, n_chunks, VALUES, _WIDE))
    for chunk in range(n_chunks):
        start = chunk * CHUNK
        n = min(CHUNK, n_around - start)
        packed[:, chunk, :7, : n + 1] = knots[:, :, start : start + n + 1]
        shared = n if start + n < n_around or periodic else n + 1
        packed[:, chunk, 7:13, :shared] = knot_law[:, :, start : start + shared]
        packed[:, chunk, 13:, :n] = elements[:, :, start : start + n]
    return packed.ravel()
