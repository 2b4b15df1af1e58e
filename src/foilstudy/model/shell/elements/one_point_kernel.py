"""Energy and internal force with one strain point per element.

The strains are sampled at the element middle: membrane strain e_ab = (a_a.a_b - A_a.A_b)/2,
bending strain k_ab = B_ab - b_ab with b_ab = a_,ab . a_3. The in-plane checkerboard that one point
leaves free is held by the first-order variation of the membrane strain over the element,
(h_1^2/12)|e_,1|^2 + (h_2^2/12)|e_,2|^2, times a factor chi; the second derivatives that bending
needs anyway provide it. Up to `CHUNK` elements of a row are one vectorised loop.
"""

from __future__ import annotations

import numpy as np
from numba import njit

CHUNK = 128
"""Elements handled at once. A constant stride lets the compiler see that the work arrays do not
overlap, without which it does not vectorise."""
_WIDE = CHUNK + 4
VALUES = 18
"""Values kept per element: 12 of the reference geometry, 6 of the constitutive law."""


def pack(geometry: np.ndarray, law: np.ndarray) -> np.ndarray:
    """Element data in the order in which `internal_force` reads them: row, chunk, value, lane."""
    n_along, _, n_around = geometry.shape
    n_chunks = -(-n_around // CHUNK)
    packed = np.zeros((n_along, VALUES, n_chunks * CHUNK))
    packed[:, :12, :n_around] = geometry
    packed[:, 12:, :n_around] = law
    lanes = packed.reshape(n_along, VALUES, n_chunks, CHUNK)
    return np.ascontiguousarray(lanes.transpose(0, 2, 1, 3)).ravel()


def scales(patch, thickness: float, stabilisation: float) -> tuple[tuple, tuple]:
    """Stencil and law factors of `internal_force`: around (with the law's), along."""
    h1, h2 = patch.size_around, patch.size_along
    law = (thickness**2 / 12, stabilisation * h1**2 / 12, stabilisation * h2**2 / 12)
    return (0.5 / h1, 1 / h1**2, *law), (0.5 / h2, 1 / h2**2)


@njit(cache=True, fastmath=True, error_model="numpy", forceinline=True)
def _element_chunk(buf, row, n, scales, g):
    """Work-conjugate vectors (rows 0 to 14 of g) and energies (15 to 17) of n elements of a row."""
    d1, dd1, bend, grad1, grad2 = scales
    for i in range(n):
        # base vectors and second derivatives at the element middle
        x1 = (buf[i + 2] - buf[i]) * d1
        y1 = (buf[1 * _WIDE + i + 2] - buf[1 * _WIDE + i]) * d1
        z1 = (buf[2 * _WIDE + i + 2] - buf[2 * _WIDE + i]) * d1
        x2 = 0.125 * (buf[3 * _WIDE + i] + buf[3 * _WIDE + i + 2]) + 0.75 * buf[3 * _WIDE + i + 1]
        y2 = 0.125 * (buf[4 * _WIDE + i] + buf[4 * _WIDE + i + 2]) + 0.75 * buf[4 * _WIDE + i + 1]
        z2 = 0.125 * (buf[5 * _WIDE + i] + buf[5 * _WIDE + i + 2]) + 0.75 * buf[5 * _WIDE + i + 1]
        x11 = (buf[i] - 2.0 * buf[i + 1] + buf[i + 2]) * dd1
        y11 = (buf[1 * _WIDE + i] - 2.0 * buf[1 * _WIDE + i + 1] + buf[1 * _WIDE + i + 2]) * dd1
        z11 = (buf[2 * _WIDE + i] - 2.0 * buf[2 * _WIDE + i + 1] + buf[2 * _WIDE + i + 2]) * dd1
        x22 = 0.125 * (buf[6 * _WIDE + i] + buf[6 * _WIDE + i + 2]) + 0.75 * buf[6 * _WIDE + i + 1]
        y22 = 0.125 * (buf[7 * _WIDE + i] + buf[7 * _WIDE + i + 2]) + 0.75 * buf[7 * _WIDE + i + 1]
        z22 = 0.125 * (buf[8 * _WIDE + i] + buf[8 * _WIDE + i + 2]) + 0.75 * buf[8 * _WIDE + i + 1]
        x12 = (buf[3 * _WIDE + i + 2] - buf[3 * _WIDE + i]) * d1
        y12 = (buf[4 * _WIDE + i + 2] - buf[4 * _WIDE + i]) * d1
        z12 = (buf[5 * _WIDE + i + 2] - buf[5 * _WIDE + i]) * d1

        nx = y1 * z2 - z1 * y2
        ny = z1 * x2 - x1 * z2
        nz = x1 * y2 - y1 * x2
        m11 = x1 * x1 + y1 * y1 + z1 * z1
        m22 = x2 * x2 + y2 * y2 + z2 * z2
        m12 = x1 * x2 + y1 * y2 + z1 * z2
        det = nx * nx + ny * ny + nz * nz
        rj = 1.0 / np.sqrt(det)
        nx *= rj
        ny *= rj
        nz *= rj

        c11 = row[12 * CHUNK + i]
        c22 = row[13 * CHUNK + i]
        c12 = row[14 * CHUNK + i]
        c16 = row[15 * CHUNK + i]
        c26 = row[16 * CHUNK + i]
        c66 = row[17 * CHUNK + i]

        e1 = 0.5 * (m11 - row[0 * CHUNK + i])
        e2 = 0.5 * (m22 - row[1 * CHUNK + i])
        e6 = m12 - 0.5 * row[2 * CHUNK + i]
        n1 = c11 * e1 + c12 * e2 + c16 * e6
        n2 = c12 * e1 + c22 * e2 + c26 * e6
        n6 = c16 * e1 + c26 * e2 + c66 * e6
        g[15 * _WIDE + i] = 0.5 * (n1 * e1 + n2 * e2 + n6 * e6)

        k1 = row[3 * CHUNK + i] - (x11 * nx + y11 * ny + z11 * nz)
        k2 = row[4 * CHUNK + i] - (x22 * nx + y22 * ny + z22 * nz)
        k6 = row[5 * CHUNK + i] - 2.0 * (x12 * nx + y12 * ny + z12 * nz)
        m1 = bend * (c11 * k1 + c12 * k2 + c16 * k6)
        m2 = bend * (c12 * k1 + c22 * k2 + c26 * k6)
        m6 = 2.0 * bend * (c16 * k1 + c26 * k2 + c66 * k6)
        g[16 * _WIDE + i] = 0.5 * (m1 * k1 + m2 * k2 + 0.5 * m6 * k6)

        # first-order variation of the membrane strain, direction 1 then 2
        f1 = x11 * x1 + y11 * y1 + z11 * z1 - row[6 * CHUNK + i]
        w = x12 * x2 + y12 * y2 + z12 * z2
        f2 = w - row[7 * CHUNK + i]
        v = x12 * x1 + y12 * y1 + z12 * z1
        f6 = x11 * x2 + y11 * y2 + z11 * z2 + v - row[8 * CHUNK + i]
        h1 = v - row[9 * CHUNK + i]
        h2 = x22 * x2 + y22 * y2 + z22 * z2 - row[10 * CHUNK + i]
        h6 = w + x22 * x1 + y22 * y1 + z22 * z1 - row[11 * CHUNK + i]
        s1 = grad1 * (c11 * f1 + c12 * f2 + c16 * f6)
        s2 = grad1 * (c12 * f1 + c22 * f2 + c26 * f6)
        s6 = grad1 * (c16 * f1 + c26 * f2 + c66 * f6)
        r1 = grad2 * (c11 * h1 + c12 * h2 + c16 * h6)
        r2 = grad2 * (c12 * h1 + c22 * h2 + c26 * h6)
        r6 = grad2 * (c16 * h1 + c26 * h2 + c66 * h6)
        g[17 * _WIDE + i] = 0.5 * (s1 * f1 + s2 * f2 + s6 * f6 + r1 * h1 + r2 * h2 + r6 * h6)

        # b_ab varies with the base vectors through the normal: d(b_ab) = (N_,ab - G^c_ab N_,c).a_3,
        # G^c_ab = a_ab . a^c; q_c = sum over ab of m^ab G^c_ab
        px = m1 * x11 + m2 * x22 + m6 * x12
        py = m1 * y11 + m2 * y22 + m6 * y12
        pz = m1 * z11 + m2 * z22 + m6 * z12
        t1 = px * x1 + py * y1 + pz * z1
        t2 = px * x2 + py * y2 + pz * z2
        ri = rj * rj
        q1 = ri * (m22 * t1 - m12 * t2)
        q2 = ri * (m11 * t2 - m12 * t1)

        # work-conjugate vectors of a_1, a_2, a_11, a_22, a_12
        g[0 * _WIDE + i + 2] = (
            n1 * x1 + n6 * x2 + q1 * nx + s1 * x11 + s6 * x12 + r1 * x12 + r6 * x22
        )
        g[1 * _WIDE + i + 2] = (
            n1 * y1 + n6 * y2 + q1 * ny + s1 * y11 + s6 * y12 + r1 * y12 + r6 * y22
        )
        g[2 * _WIDE + i + 2] = (
            n1 * z1 + n6 * z2 + q1 * nz + s1 * z11 + s6 * z12 + r1 * z12 + r6 * z22
        )
        g[3 * _WIDE + i + 2] = (
            n2 * x2 + n6 * x1 + q2 * nx + s2 * x12 + s6 * x11 + r2 * x22 + r6 * x12
        )
        g[4 * _WIDE + i + 2] = (
            n2 * y2 + n6 * y1 + q2 * ny + s2 * y12 + s6 * y11 + r2 * y22 + r6 * y12
        )
        g[5 * _WIDE + i + 2] = (
            n2 * z2 + n6 * z1 + q2 * nz + s2 * z12 + s6 * z11 + r2 * z22 + r6 * z12
        )
        g[6 * _WIDE + i + 2] = s1 * x1 + s6 * x2 - m1 * nx
        g[7 * _WIDE + i + 2] = s1 * y1 + s6 * y2 - m1 * ny
        g[8 * _WIDE + i + 2] = s1 * z1 + s6 * z2 - m1 * nz
        g[9 * _WIDE + i + 2] = r2 * x2 + r6 * x1 - m2 * nx
        g[10 * _WIDE + i + 2] = r2 * y2 + r6 * y1 - m2 * ny
        g[11 * _WIDE + i + 2] = r2 * z2 + r6 * z1 - m2 * nz
        g[12 * _WIDE + i + 2] = (s2 + r6) * x2 + (s6 + r1) * x1 - m6 * nx
        g[13 * _WIDE + i + 2] = (s2 + r6) * y2 + (s6 + r1) * y1 - m6 * ny
        g[14 * _WIDE + i + 2] = (s2 + r6) * z2 + (s6 + r1) * z1 - m6 * nz


@njit(cache=True, fastmath=True, forceinline=True)
def _add_energies(g, count, energy):
    """Sum apart from the element loop, in which its order depended on where the arrays lay."""
    membrane, bending, stabilisation = 0.0, 0.0, 0.0
    for i in range(count):
        membrane += g[15 * _WIDE + i]
        bending += g[16 * _WIDE + i]
        stabilisation += g[17 * _WIDE + i]
    energy[0] += membrane
    energy[1] += bending
    energy[2] += stabilisation


@njit(cache=True, fastmath=True, error_model="numpy")
def internal_force(x, n_around, elements, scales_around, scales_along, force):
    """Internal force, the derivative of the strain energy with respect to the control points.

    f_I = sum over elements w [n^ab N_I,a a_b - m^ab (N_I,ab - G^c_ab N_I,c) a_3] and the same for
    the membrane-strain gradients.

    Parameters
    ----------
    x : ndarray, shape (3, rows, columns)
        Control points, m; C order.
    n_around : int
        Elements around: as many as columns on a periodic patch, two less on an open one.
    elements : ndarray
        From `pack`.
    scales_around, scales_along : tuple of float
        From `scales`.
    force : ndarray, shape (3, rows, columns)
        Receives the force, N.

    Returns
    -------
    ndarray, shape (3,)
        Membrane, bending and stabilisation energy, J.
    """
    n_along, columns = x.shape[1] - 2, x.shape[2]
    d1, dd1, bend, grad1, grad2 = scales_around
    d2, dd2 = scales_along
    buf = np.zeros(9 * _WIDE)
    g = np.zeros(18 * _WIDE)
    energy = np.zeros(3)
    force[:] = 0.0
    n_chunks = (n_around + CHUNK - 1) // CHUNK
    for j in range(n_along):
        for chunk in range(n_chunks):
            start = chunk * CHUNK
            n = min(CHUNK, n_around - start)
            inside = min(n + 2, columns - start)
            for c in range(3):
                p = x[c, j]
                q = x[c, j + 1]
                r = x[c, j + 2]
                b0 = c * _WIDE
                b1 = b0 + 3 * _WIDE
                b2 = b0 + 6 * _WIDE
                for i in range(inside):
                    buf[b0 + i] = 0.125 * (p[start + i] + r[start + i]) + 0.75 * q[start + i]
                    buf[b1 + i] = (r[start + i] - p[start + i]) * d2
                    buf[b2 + i] = (p[start + i] - 2.0 * q[start + i] + r[start + i]) * dd2
                for i in range(inside, n + 2):
                    k = start + i - columns
                    buf[b0 + i] = 0.125 * (p[k] + r[k]) + 0.75 * q[k]
                    buf[b1 + i] = (r[k] - p[k]) * d2
                    buf[b2 + i] = (p[k] - 2.0 * q[k] + r[k]) * dd2
            for k in range(15):
                g[k * _WIDE + n + 2] = 0.0
                g[k * _WIDE + n + 3] = 0.0
            # a slice, not an offset, or else the overlap checks of the compiler reach too far and
            # the order of sums depends on where the work arrays happen to lie
            at = (j * n_chunks + chunk) * VALUES * CHUNK
            _element_chunk(buf, elements[at : at + VALUES * CHUNK], n, scales_around, g)
            _add_energies(g, n, energy)
            for c in range(3):
                g1 = c * _WIDE
                g2 = g1 + 3 * _WIDE
                g11 = g1 + 6 * _WIDE
                g22 = g1 + 9 * _WIDE
                g12 = g1 + 12 * _WIDE
                r0 = c * _WIDE
                r1 = r0 + 3 * _WIDE
                r2 = r0 + 6 * _WIDE
                # transposed stencils around: column k collects elements k, k - 1, k - 2
                for k in range(n + 2):
                    buf[r0 + k] = d1 * (g[g1 + k] - g[g1 + k + 2]) + dd1 * (
                        g[g11 + k] - 2.0 * g[g11 + k + 1] + g[g11 + k + 2]
                    )
                    buf[r1 + k] = d2 * (
                        0.125 * (g[g2 + k] + g[g2 + k + 2])
                        + 0.75 * g[g2 + k + 1]
                        + d1 * (g[g12 + k] - g[g12 + k + 2])
                    )
                    buf[r2 + k] = dd2 * (
                        0.125 * (g[g22 + k] + g[g22 + k + 2]) + 0.75 * g[g22 + k + 1]
                    )
                fp = force[c, j]
                fq = force[c, j + 1]
                fr = force[c, j + 2]
                for i in range(inside):
                    fp[start + i] += 0.125 * buf[r0 + i] - buf[r1 + i] + buf[r2 + i]
                    fq[start + i] += 0.75 * buf[r0 + i] - 2.0 * buf[r2 + i]
                    fr[start + i] += 0.125 * buf[r0 + i] + buf[r1 + i] + buf[r2 + i]
                for i in range(inside, n + 2):
                    k = start + i - columns
                    fp[k] += 0.125 * buf[r0 + i] - buf[r1 + i] + buf[r2 + i]
                    fq[k] += 0.75 * buf[r0 + i] - 2.0 * buf[r2 + i]
                    fr[k] += 0.125 * buf[r0 + i] + buf[r1 + i] + buf[r2 + i]
    return energy
