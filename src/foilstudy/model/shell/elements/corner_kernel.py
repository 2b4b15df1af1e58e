"""Vectorised energy and internal force of the corner-sampled sheet (see `sampling.corner`).

The energy is a sum over vertices (membrane strains, shared by the four elements that meet there),
over edges (the checkerboard control) and over element middles (bending). One row after another is
swept, with what two rows share carried along.

A row is cut into `LANES` equal pieces that lie side by side, so that place k of every piece makes
one vector and a neighbour around is the next vector: shifts cost no unaligned loads. At most
`STEPS` places at a time, so that the work array stays in the fast caches. Its rows have a constant
stride, by which the compiler sees that they do not overlap. What is read is named before it is
used and constants are multiplied before the loops, without which it does not vectorise them.
"""

from __future__ import annotations

import numpy as np
from numba import njit

LANES = 8
STEPS = 32
VALUES = 23
"""Values kept per place: 3 metrics and 6 law coefficients of the vertex, metric and law of the edge
around and of the edge along, 4 of the curvature and 6 law coefficients of the middle."""

_W = LANES * (STEPS + 4)
_DW = LANES * (STEPS + 1)

# Rows of the work array, a vector takes three. What columns collect from is stored one place (of
# vertices and edges along) or two (of elements) further on, with zeros around.
_P, _Q, _R = 0, 3, 6  # control rows below, at and above the element row
_E1L, _E2L, _E1U, _E2U = 9, 10, 11, 12  # strains 11 and 22 of the vertices below and above
_QL, _QV = 13, 14  # stress of the control on the edges along, of the element row below and this one
_HM = 15  # forces of the edges along
_H1, _H2 = 18, 21  # of the vertices, conjugate to a_1 and a_2
_B, _D = 24, 27  # of the edges around, and their stress
_G1, _G2, _G11, _G12, _G22 = 28, 31, 34, 37, 40  # of the elements, conjugate to a_1 to a_22
_FP, _FQ, _OUT = 43, 46, 49  # force so far on rows P and Q; force on row P once it is complete
_ENERGY = 52  # membrane, bending, stabilisation
_ROWS = 55
LACKED = 6
"""Values kept per place of stresses that elements lack: 11, 22, 12 of membrane and of bending."""
_DL = LANES * (STEPS + 2)  # their places, those of elements one further on, with zeros around
_LACKS = LACKED * _DL
_NO_AREA = 1e-200


@njit(cache=True, fastmath=True, error_model="numpy")
def _fold(w, to, x, row, m, m0, steps):
    """Load a row of control points, with the two columns beyond the last elements."""
    columns = x.shape[2]
    for c in range(3):
        source = x[c, row]
        base = (to + c) * _W
        for lane in range(LANES):
            i = (lane * m + m0) % columns
            inside = min(steps + 2, columns - i)
            for k in range(inside):
                w[base + LANES * k + lane] = source[i + k]
            for k in range(inside, steps + 2):
                w[base + LANES * k + lane] = source[i + k - columns]


@njit(cache=True, fastmath=True, error_model="numpy")
def _unfold(w, at, force, row, m, m0, steps):
    """Add a row of forces."""
    columns = force.shape[2]
    for c in range(3):
        target = force[c, row]
        base = (at + c) * _W
        for lane in range(LANES):
            i = (lane * m + m0) % columns
            inside = min(steps + 2, columns - i)
            for k in range(inside):
                target[i + k] += w[base + LANES * k + lane]
            for k in range(inside, steps + 2):
                target[i + k - columns] += w[base + LANES * k + lane]


@njit(cache=True, fastmath=True, error_model="numpy")
def _first_strains(w, data, steps, i1, i2):
    """Strains of the lowest vertices."""
    h1 = 0.5 * i1
    h2 = 0.5 * i2
    for k in range(LANES * (steps + 1)):
        e1 = 0.0
        e2 = 0.0
        for c in range(3):
            q0 = w[(_P + c) * _W + k]
            q1 = w[(_P + c) * _W + k + LANES]
            r0 = w[(_Q + c) * _W + k]
            r1 = w[(_Q + c) * _W + k + LANES]
            a1 = h1 * ((q1 - q0) + (r1 - r0))
            a2 = h2 * ((r0 - q0) + (r1 - q1))
            e1 += a1 * a1
            e2 += a2 * a2
        w[_E1L * _W + k] = 0.5 * e1 - data[k]
        w[_E2L * _W + k] = 0.5 * e2 - data[_DW + k]
        w[_QL * _W + k] = 0.0


@njit(cache=True, fastmath=True, error_model="numpy")
def _edges_along(w, data, above, steps, i1, i2):
    """Strains of the vertices above; deviation of strain 11 in the middle of the edges along."""
    h1 = 0.5 * i1
    h2 = 0.5 * i2
    end1 = 0.125 * i1
    mid1 = 0.75 * i1
    for k in range(LANES * (steps + 1)):
        p0 = w[_P * _W + k]
        p1 = w[_P * _W + k + LANES]
        q0 = w[_Q * _W + k]
        q1 = w[_Q * _W + k + LANES]
        r0 = w[_R * _W + k]
        r1 = w[_R * _W + k + LANES]
        x1 = h1 * ((q1 - q0) + (r1 - r0))
        x2 = h2 * ((r0 - q0) + (r1 - q1))
        xm = end1 * ((p1 - p0) + (r1 - r0)) + mid1 * (q1 - q0)
        p0 = w[(_P + 1) * _W + k]
        p1 = w[(_P + 1) * _W + k + LANES]
        q0 = w[(_Q + 1) * _W + k]
        q1 = w[(_Q + 1) * _W + k + LANES]
        r0 = w[(_R + 1) * _W + k]
        r1 = w[(_R + 1) * _W + k + LANES]
        y1 = h1 * ((q1 - q0) + (r1 - r0))
        y2 = h2 * ((r0 - q0) + (r1 - q1))
        ym = end1 * ((p1 - p0) + (r1 - r0)) + mid1 * (q1 - q0)
        p0 = w[(_P + 2) * _W + k]
        p1 = w[(_P + 2) * _W + k + LANES]
        q0 = w[(_Q + 2) * _W + k]
        q1 = w[(_Q + 2) * _W + k + LANES]
        r0 = w[(_R + 2) * _W + k]
        r1 = w[(_R + 2) * _W + k + LANES]
        z1 = h1 * ((q1 - q0) + (r1 - r0))
        z2 = h2 * ((r0 - q0) + (r1 - q1))
        zm = end1 * ((p1 - p0) + (r1 - r0)) + mid1 * (q1 - q0)
        g1 = above[k]
        g2 = above[_DW + k]
        gm = data[11 * _DW + k]
        law = data[12 * _DW + k]
        below = w[_E1L * _W + k]
        e1 = 0.5 * (x1 * x1 + y1 * y1 + z1 * z1) - g1
        dev = 0.5 * (xm * xm + ym * ym + zm * zm) - gm - 0.5 * (below + e1)
        q = law * dev
        w[_E1U * _W + k] = e1
        w[_E2U * _W + k] = 0.5 * (x2 * x2 + y2 * y2 + z2 * z2) - g2
        w[_QV * _W + k] = q
        w[(_ENERGY + 2) * _W + k] += 0.5 * q * dev
        q *= i1
        w[_HM * _W + k + LANES] = q * xm
        w[(_HM + 1) * _W + k + LANES] = q * ym
        w[(_HM + 2) * _W + k + LANES] = q * zm


@njit(cache=True, fastmath=True, error_model="numpy")
def _edges_around(w, data, steps, i2):
    """Deviation of strain 22 in the middle of the edges around, at the vertices below."""
    end2 = 0.125 * i2
    mid2 = 0.75 * i2
    for k in range(LANES * steps):
        p0 = w[_P * _W + k]
        p1 = w[_P * _W + k + LANES]
        p2 = w[_P * _W + k + 2 * LANES]
        q0 = w[_Q * _W + k]
        q1 = w[_Q * _W + k + LANES]
        q2 = w[_Q * _W + k + 2 * LANES]
        x = end2 * ((q0 - p0) + (q2 - p2)) + mid2 * (q1 - p1)
        p0 = w[(_P + 1) * _W + k]
        p1 = w[(_P + 1) * _W + k + LANES]
        p2 = w[(_P + 1) * _W + k + 2 * LANES]
        q0 = w[(_Q + 1) * _W + k]
        q1 = w[(_Q + 1) * _W + k + LANES]
        q2 = w[(_Q + 1) * _W + k + 2 * LANES]
        y = end2 * ((q0 - p0) + (q2 - p2)) + mid2 * (q1 - p1)
        p0 = w[(_P + 2) * _W + k]
        p1 = w[(_P + 2) * _W + k + LANES]
        p2 = w[(_P + 2) * _W + k + 2 * LANES]
        q0 = w[(_Q + 2) * _W + k]
        q1 = w[(_Q + 2) * _W + k + LANES]
        q2 = w[(_Q + 2) * _W + k + 2 * LANES]
        z = end2 * ((q0 - p0) + (q2 - p2)) + mid2 * (q1 - p1)
        ref = data[9 * _DW + k]
        law = data[10 * _DW + k]
        left = w[_E2L * _W + k]
        right = w[_E2L * _W + k + LANES]
        dev = 0.5 * (x * x + y * y + z * z) - ref - 0.5 * (left + right)
        d = law * dev
        w[_D * _W + k + LANES] = d
        w[(_ENERGY + 2) * _W + k] += 0.5 * d * dev
        d *= i2
        w[_B * _W + k + 2 * LANES] = d * x
        w[(_B + 1) * _W + k + 2 * LANES] = d * y
        w[(_B + 2) * _W + k + 2 * LANES] = d * z


@njit(cache=True, fastmath=True, error_model="numpy", forceinline=True)
def _mean(lacked, k):
    """Of the two elements below a vertex and the two above."""
    low, up = lacked[k] + lacked[k + LANES], lacked[k + _LACKS] + lacked[k + _LACKS + LANES]
    return 0.25 * (low + up)


@njit(cache=True, fastmath=True, error_model="numpy")
def _vertices(w, data, steps, i1, i2, lacked):
    """Stresses of the vertices below and the vectors conjugate to a_1 and a_2."""
    h1 = 0.5 * i1
    h2 = 0.5 * i2
    for k in range(LANES * (steps + 1)):
        p0 = w[_P * _W + k]
        p1 = w[_P * _W + k + LANES]
        q0 = w[_Q * _W + k]
        q1 = w[_Q * _W + k + LANES]
        x1 = h1 * ((p1 - p0) + (q1 - q0))
        x2 = h2 * ((q0 - p0) + (q1 - p1))
        p0 = w[(_P + 1) * _W + k]
        p1 = w[(_P + 1) * _W + k + LANES]
        q0 = w[(_Q + 1) * _W + k]
        q1 = w[(_Q + 1) * _W + k + LANES]
        y1 = h1 * ((p1 - p0) + (q1 - q0))
        y2 = h2 * ((q0 - p0) + (q1 - p1))
        p0 = w[(_P + 2) * _W + k]
        p1 = w[(_P + 2) * _W + k + LANES]
        q0 = w[(_Q + 2) * _W + k]
        q1 = w[(_Q + 2) * _W + k + LANES]
        z1 = h1 * ((p1 - p0) + (q1 - q0))
        z2 = h2 * ((q0 - p0) + (q1 - p1))
        e1 = w[_E1L * _W + k]
        e2 = w[_E2L * _W + k]
        e6 = x1 * x2 + y1 * y2 + z1 * z2 - data[2 * _DW + k]
        c11 = data[3 * _DW + k]
        c22 = data[4 * _DW + k]
        c12 = data[5 * _DW + k]
        c16 = data[6 * _DW + k]
        c26 = data[7 * _DW + k]
        c66 = data[8 * _DW + k]
        n1 = c11 * e1 + c12 * e2 + c16 * e6
        n2 = c12 * e1 + c22 * e2 + c26 * e6
        n6 = c16 * e1 + c26 * e2 + c66 * e6
        w[_ENERGY * _W + k] += 0.5 * (n1 * e1 + n2 * e2 + n6 * e6)
        n1 -= 0.5 * (w[_QL * _W + k] + w[_QV * _W + k])
        n2 -= 0.5 * (w[_D * _W + k] + w[_D * _W + k + LANES])
        if lacked is not None:  # a vertex lacks the mean of four elements
            n1 -= _mean(lacked, k)
            n2 -= _mean(lacked, k + _DL)
            n6 -= _mean(lacked, k + 2 * _DL)
        w[_H1 * _W + k + LANES] = h1 * (n1 * x1 + n6 * x2)
        w[(_H1 + 1) * _W + k + LANES] = h1 * (n1 * y1 + n6 * y2)
        w[(_H1 + 2) * _W + k + LANES] = h1 * (n1 * z1 + n6 * z2)
        w[_H2 * _W + k + LANES] = h2 * (n2 * x2 + n6 * x1)
        w[(_H2 + 1) * _W + k + LANES] = h2 * (n2 * y2 + n6 * y1)
        w[(_H2 + 2) * _W + k + LANES] = h2 * (n2 * z2 + n6 * z1)


@njit(cache=True, fastmath=True, error_model="numpy")
def _bend(w, data, steps, i1, i2, bend, lacked):
    """Bending energy at the element middles and the vectors conjugate to their derivatives."""
    h1 = 0.5 * i1
    s1 = i1 * i1
    h2 = 0.5 * i2
    s2 = i2 * i2
    a1 = 0.125 * h1
    a2 = 0.125 * h2
    a11 = 0.125 * s1
    a22 = 0.125 * s2
    a12 = h1 * h2
    for k in range(LANES * steps):
        p0 = w[_P * _W + k]
        p1 = w[_P * _W + k + LANES]
        p2 = w[_P * _W + k + 2 * LANES]
        q0 = w[_Q * _W + k]
        q1 = w[_Q * _W + k + LANES]
        q2 = w[_Q * _W + k + 2 * LANES]
        r0 = w[_R * _W + k]
        r1 = w[_R * _W + k + LANES]
        r2 = w[_R * _W + k + 2 * LANES]
        v0 = (p0 + r0) + 6.0 * q0
        d0 = r0 - p0
        c0 = (p0 + r0) - 2.0 * q0
        v1 = (p1 + r1) + 6.0 * q1
        d1 = r1 - p1
        c1 = (p1 + r1) - 2.0 * q1
        v2 = (p2 + r2) + 6.0 * q2
        d2 = r2 - p2
        c2 = (p2 + r2) - 2.0 * q2
        x1 = a1 * (v2 - v0)
        x11 = a11 * ((v2 + v0) - 2.0 * v1)
        x2 = a2 * ((d0 + d2) + 6.0 * d1)
        x22 = a22 * ((c0 + c2) + 6.0 * c1)
        x12 = a12 * (d2 - d0)
        p0 = w[(_P + 1) * _W + k]
        p1 = w[(_P + 1) * _W + k + LANES]
        p2 = w[(_P + 1) * _W + k + 2 * LANES]
        q0 = w[(_Q + 1) * _W + k]
        q1 = w[(_Q + 1) * _W + k + LANES]
        q2 = w[(_Q + 1) * _W + k + 2 * LANES]
        r0 = w[(_R + 1) * _W + k]
        r1 = w[(_R + 1) * _W + k + LANES]
        r2 = w[(_R + 1) * _W + k + 2 * LANES]
        v0 = (p0 + r0) + 6.0 * q0
        d0 = r0 - p0
        c0 = (p0 + r0) - 2.0 * q0
        v1 = (p1 + r1) + 6.0 * q1
        d1 = r1 - p1
        c1 = (p1 + r1) - 2.0 * q1
        v2 = (p2 + r2) + 6.0 * q2
        d2 = r2 - p2
        c2 = (p2 + r2) - 2.0 * q2
        y1 = a1 * (v2 - v0)
        y11 = a11 * ((v2 + v0) - 2.0 * v1)
        y2 = a2 * ((d0 + d2) + 6.0 * d1)
        y22 = a22 * ((c0 + c2) + 6.0 * c1)
        y12 = a12 * (d2 - d0)
        p0 = w[(_P + 2) * _W + k]
        p1 = w[(_P + 2) * _W + k + LANES]
        p2 = w[(_P + 2) * _W + k + 2 * LANES]
        q0 = w[(_Q + 2) * _W + k]
        q1 = w[(_Q + 2) * _W + k + LANES]
        q2 = w[(_Q + 2) * _W + k + 2 * LANES]
        r0 = w[(_R + 2) * _W + k]
        r1 = w[(_R + 2) * _W + k + LANES]
        r2 = w[(_R + 2) * _W + k + 2 * LANES]
        v0 = (p0 + r0) + 6.0 * q0
        d0 = r0 - p0
        c0 = (p0 + r0) - 2.0 * q0
        v1 = (p1 + r1) + 6.0 * q1
        d1 = r1 - p1
        c1 = (p1 + r1) - 2.0 * q1
        v2 = (p2 + r2) + 6.0 * q2
        d2 = r2 - p2
        c2 = (p2 + r2) - 2.0 * q2
        z1 = a1 * (v2 - v0)
        z11 = a11 * ((v2 + v0) - 2.0 * v1)
        z2 = a2 * ((d0 + d2) + 6.0 * d1)
        z22 = a22 * ((c0 + c2) + 6.0 * c1)
        z12 = a12 * (d2 - d0)
        nx = y1 * z2 - z1 * y2
        ny = z1 * x2 - x1 * z2
        nz = x1 * y2 - y1 * x2
        # a place beyond an open edge has no law, but may have no area either
        ri = 1.0 / (nx * nx + ny * ny + nz * nz + _NO_AREA)
        j0 = data[16 * _DW + k]
        b1 = data[13 * _DW + k]
        b2 = data[14 * _DW + k]
        b6 = data[15 * _DW + k]
        sigma = j0 * ri
        t1 = x11 * nx + y11 * ny + z11 * nz
        t2 = x22 * nx + y22 * ny + z22 * nz
        t6 = 2.0 * (x12 * nx + y12 * ny + z12 * nz)
        k1 = b1 - sigma * t1
        k2 = b2 - sigma * t2
        k6 = b6 - sigma * t6
        c11 = bend * data[17 * _DW + k]
        c22 = bend * data[18 * _DW + k]
        c12 = bend * data[19 * _DW + k]
        c16 = bend * data[20 * _DW + k]
        c26 = bend * data[21 * _DW + k]
        c66 = bend * data[22 * _DW + k]
        m1 = c11 * k1 + c12 * k2 + c16 * k6
        m2 = c12 * k1 + c22 * k2 + c26 * k6
        m6 = c16 * k1 + c26 * k2 + c66 * k6
        w[(_ENERGY + 1) * _W + k] += 0.5 * (m1 * k1 + m2 * k2 + m6 * k6)
        if lacked is not None:
            m1 -= lacked[_LACKS + 3 * _DL + k + LANES]
            m2 -= lacked[_LACKS + 4 * _DL + k + LANES]
            m6 -= lacked[_LACKS + 5 * _DL + k + LANES]
        u1 = -sigma * m1
        u2 = -sigma * m2
        u6 = -2.0 * sigma * m6
        f = 2.0 * sigma * ri * (m1 * t1 + m2 * t2 + m6 * t6)
        qx = u1 * x11 + u2 * x22 + u6 * x12 + f * nx
        qy = u1 * y11 + u2 * y22 + u6 * y12 + f * ny
        qz = u1 * z11 + u2 * z22 + u6 * z12 + f * nz
        w[_G1 * _W + k + 2 * LANES] = h1 * (y2 * qz - z2 * qy)
        w[(_G1 + 1) * _W + k + 2 * LANES] = h1 * (z2 * qx - x2 * qz)
        w[(_G1 + 2) * _W + k + 2 * LANES] = h1 * (x2 * qy - y2 * qx)
        w[_G2 * _W + k + 2 * LANES] = h2 * (qy * z1 - qz * y1)
        w[(_G2 + 1) * _W + k + 2 * LANES] = h2 * (qz * x1 - qx * z1)
        w[(_G2 + 2) * _W + k + 2 * LANES] = h2 * (qx * y1 - qy * x1)
        u1 *= s1
        u2 *= s2
        u6 *= h1 * h2
        w[_G11 * _W + k + 2 * LANES] = u1 * nx
        w[(_G11 + 1) * _W + k + 2 * LANES] = u1 * ny
        w[(_G11 + 2) * _W + k + 2 * LANES] = u1 * nz
        w[_G12 * _W + k + 2 * LANES] = u6 * nx
        w[(_G12 + 1) * _W + k + 2 * LANES] = u6 * ny
        w[(_G12 + 2) * _W + k + 2 * LANES] = u6 * nz
        w[_G22 * _W + k + 2 * LANES] = u2 * nx
        w[(_G22 + 1) * _W + k + 2 * LANES] = u2 * ny
        w[(_G22 + 2) * _W + k + 2 * LANES] = u2 * nz


@njit(cache=True, fastmath=True, error_model="numpy")
def _collect(w, steps):
    """Force on the columns of the control rows: row P is complete with it."""
    two = 2 * LANES
    for c in range(3):
        for k in range(LANES * (steps + 2)):
            h = w[(_H1 + c) * _W + k] - w[(_H1 + c) * _W + k + LANES]
            v = w[(_H2 + c) * _W + k] + w[(_H2 + c) * _W + k + LANES]
            v -= (
                -0.125 * (w[(_B + c) * _W + k] + w[(_B + c) * _W + k + two])
                - 0.75 * w[(_B + c) * _W + k + LANES]
            )
            middle = (
                (w[(_HM + c) * _W + k] - w[(_HM + c) * _W + k + LANES])
                + (w[(_G1 + c) * _W + k] - w[(_G1 + c) * _W + k + two])
                + (w[(_G11 + c) * _W + k] + w[(_G11 + c) * _W + k + two])
                - 2.0 * w[(_G11 + c) * _W + k + LANES]
            )
            across = (
                w[(_G12 + c) * _W + k]
                - w[(_G12 + c) * _W + k + two]
                + 0.125 * (w[(_G2 + c) * _W + k] + w[(_G2 + c) * _W + k + two])
                + 0.75 * w[(_G2 + c) * _W + k + LANES]
            )
            bent = (
                0.125 * (w[(_G22 + c) * _W + k] + w[(_G22 + c) * _W + k + two])
                + 0.75 * w[(_G22 + c) * _W + k + LANES]
            )
            end = 0.125 * middle + bent
            w[(_OUT + c) * _W + k] = w[(_FP + c) * _W + k] + h - v + end - across
            w[(_FP + c) * _W + k] = w[(_FQ + c) * _W + k] + h + v + 0.75 * middle - 2.0 * bent
            w[(_FQ + c) * _W + k] = end + across


@njit(cache=True, fastmath=True, error_model="numpy")
def _shift(w, steps):
    """What is above becomes what is below."""
    for c in range(3):
        for k in range(LANES * (steps + 2)):
            w[(_P + c) * _W + k] = w[(_Q + c) * _W + k]
            w[(_Q + c) * _W + k] = w[(_R + c) * _W + k]
    for k in range(LANES * (steps + 1)):
        w[_E1L * _W + k] = w[_E1U * _W + k]
        w[_E2L * _W + k] = w[_E2U * _W + k]
        w[_QL * _W + k] = w[_QV * _W + k]


@njit(cache=True, fastmath=True)
def _add_energies(w, places, energy):
    """Sum apart from the element loops, in which its order depended on where the arrays lay."""
    for part in range(3):
        total = 0.0
        for k in range(places):
            total += w[(_ENERGY + part) * _W + k]
        energy[part] += total


@njit(cache=True, fastmath=True, error_model="numpy")
def internal_force(x, n_around, data, lacking, spacings, bend, force):
    """Internal force, the derivative of the strain energy with respect to the control points.

    Parameters
    ----------
    x : ndarray, shape (3, rows, columns)
        Control points, m; C order.
    n_around : int
        Elements around: as many as columns on a periodic patch, two less on an open one.
    data : ndarray
        From `corner_data.pack`.
    lacking : ndarray or None
        Stresses that elements lack, N m and N m2 as in `mean_strains.Inelastic`, laid out like the
        data; for the energies they are there.
    spacings : tuple of float
        Element lengths around and along, m.
    bend : float
        t^2/12, m2.
    force : ndarray, shape (3, rows, columns)
        Receives the force, N.

    Returns
    -------
    ndarray, shape (3,)
        Membrane, bending and stabilisation energy, J.
    """
    n_along = x.shape[1] - 2
    i1, i2 = 1.0 / spacings[0], 1.0 / spacings[1]
    piece = (n_around + LANES - 1) // LANES
    w = np.empty(_ROWS * _W)
    energy = np.zeros(3)
    force[:] = 0.0
    block = VALUES * _DW
    at = to = 0
    lacked = None
    for start in range(0, piece, STEPS):
        steps = min(STEPS, piece - start)
        w[:] = 0.0
        _fold(w, _P, x, 0, piece, start, steps)
        _fold(w, _Q, x, 1, piece, start, steps)
        # slices, not offsets, or else the overlap checks of the compiler reach too far and the
        # order of sums depends on where the work array happens to lie
        row = data[at : at + block]
        _first_strains(w, row, steps, i1, i2)
        for j in range(n_along):
            at += block
            above = data[at : at + block]
            _fold(w, _R, x, j + 2, piece, start, steps)
            _edges_along(w, row, above, steps, i1, i2)
            _edges_around(w, row, steps, i2)
            if lacking is not None:
                lacked = lacking[to : to + 2 * _LACKS]
                to += _LACKS
            _vertices(w, row, steps, i1, i2, lacked)
            _bend(w, row, steps, i1, i2, bend, lacked)
            _collect(w, steps)
            _unfold(w, _OUT, force, j, piece, start, steps)
            _shift(w, steps)
            row = above
        # the highest vertices have no elements above
        w[_QV * _W : (_QV + 1) * _W] = 0.0
        w[_HM * _W : (_HM + 3) * _W] = 0.0
        w[_G1 * _W : (_G22 + 3) * _W] = 0.0
        _edges_around(w, row, steps, i2)
        if lacking is not None:
            lacked = lacking[to : to + 2 * _LACKS]
            to += 2 * _LACKS
        _vertices(w, row, steps, i1, i2, lacked)
        _collect(w, steps)
        _unfold(w, _OUT, force, n_along, piece, start, steps)
        _unfold(w, _FP, force, n_along + 1, piece, start, steps)
        _add_energies(w, LANES * (steps + 1), energy)
        at += block
    return energy
