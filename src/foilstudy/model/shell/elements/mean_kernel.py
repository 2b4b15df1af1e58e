"""Vectorised mean strains of the corner-sampled element, row by row.

The mean of the membrane strains at the four corners of an element, and the bending strain in its
middle. Up to `WIDTH` elements of a row at a time, in a work array that stays in the fast caches:
its rows have a constant stride, by which the compiler sees that they do not overlap. Nothing here
is compiled with fast-math: a state that was made of these strains is kept.
"""

from __future__ import annotations

import numpy as np
from numba import njit

WIDTH = 256
STRIDE = WIDTH + 8
"""From one row of the work array, and from one value of what is packed, to the next."""
RESTS = 7
"""Values kept of the stress-free shape: mean of a_11 / 2, a_22 / 2, a_12; b_11, b_22, 2 b_12;
|a_1 x a_2|."""

# Rows of the work array: control points below, at and above the elements; metrics of the corners
# below and above; strains; and what comes of these elsewhere.
_P, _Q, _R, _LOW, _UP = 0, 3, 6, 9, 12
STRAINS, OVER = 15, 21
ROWS = 22


def packed(rest: np.ndarray) -> np.ndarray:
    """What the kernel reads of the stress-free shape, shape (pieces, along, `RESTS`, `STRIDE`).

    Parameters
    ----------
    rest : ndarray, shape (elements_along, `RESTS`, elements_around)
    """
    along, values, around = rest.shape
    out = np.zeros((-(-around // WIDTH), along, values, STRIDE))
    for piece, first in enumerate(range(0, around, WIDTH)):
        part = rest[:, :, first : first + WIDTH]
        out[piece, :, :, : part.shape[2]] = part
    return out


@njit(cache=True, error_model="numpy", forceinline=True, fastmath={"contract"})
def _load(w, to, x, row, first, count):
    """A row of control points, with the two columns beyond the last element."""
    columns = x.shape[2]
    inside = min(count + 2, columns - first)
    for c in range(3):
        source, base = x[c, row], (to + c) * STRIDE
        for k in range(inside):
            w[base + k] = source[first + k]
        for k in range(inside, count + 2):
            w[base + k] = source[first + k - columns]


@njit(cache=True, error_model="numpy", forceinline=True, fastmath={"contract"})
def _derivatives(w, c, k, i1, i2):
    """One component of a_1, a_2, a_11, a_22, a_12 in the middle of an element."""
    p0, p1, p2 = (w[(_P + c) * STRIDE + k], w[(_P + c) * STRIDE + k + 1],
                  w[(_P + c) * STRIDE + k + 2])  # fmt: skip
    q0, q1, q2 = (w[(_Q + c) * STRIDE + k], w[(_Q + c) * STRIDE + k + 1],
                  w[(_Q + c) * STRIDE + k + 2])  # fmt: skip
    r0, r1, r2 = (w[(_R + c) * STRIDE + k], w[(_R + c) * STRIDE + k + 1],
                  w[(_R + c) * STRIDE + k + 2])  # fmt: skip
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
def _corner(w, p, q, k, i1, i2):
    """One component of a_1, a_2 at a corner."""
    p0, p1 = w[p * STRIDE + k], w[p * STRIDE + k + 1]
    q0, q1 = w[q * STRIDE + k], w[q * STRIDE + k + 1]
    return 0.5 * i1 * ((p1 - p0) + (q1 - q0)), 0.5 * i2 * ((q0 - p0) + (q1 - p1))


@njit(cache=True, error_model="numpy", forceinline=True, fastmath={"contract"})
def _metrics(w, p, q, to, count, i1, i2):
    """a_11 / 2, a_22 / 2 and a_12 of a row of corners."""
    for k in range(count + 1):
        x1, x2 = _corner(w, p, q, k, i1, i2)
        y1, y2 = _corner(w, p + 1, q + 1, k, i1, i2)
        z1, z2 = _corner(w, p + 2, q + 2, k, i1, i2)
        w[to * STRIDE + k] = 0.5 * (x1 * x1 + y1 * y1 + z1 * z1)
        w[(to + 1) * STRIDE + k] = 0.5 * (x2 * x2 + y2 * y2 + z2 * z2)
        w[(to + 2) * STRIDE + k] = x1 * x2 + y1 * y2 + z1 * z2


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def begin(w, x, first, count, spacings):
    """Load what lies below the lowest elements from `first` on."""
    _load(w, _P, x, 0, first, count)
    _load(w, _Q, x, 1, first, count)
    _metrics(w, _P, _Q, _LOW, count, 1.0 / spacings[0], 1.0 / spacings[1])


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def advance(w, x, j, first, count, spacings, rest):
    """Write the strains of the elements of row j; rows come one after another."""
    i1, i2 = 1.0 / spacings[0], 1.0 / spacings[1]
    _load(w, _R, x, j + 2, first, count)
    _metrics(w, _Q, _R, _UP, count, i1, i2)
    for part in range(3):
        low, up, to = (_LOW + part) * STRIDE, (_UP + part) * STRIDE, (STRAINS + part) * STRIDE
        for k in range(count):
            total = (w[low + k] + w[low + k + 1]) + (w[up + k] + w[up + k + 1])
            w[to + k] = 0.25 * total - rest[part * STRIDE + k]
    for k in range(count):
        x1, x2, x11, x22, x12 = _derivatives(w, 0, k, i1, i2)
        y1, y2, y11, y22, y12 = _derivatives(w, 1, k, i1, i2)
        z1, z2, z11, z22, z12 = _derivatives(w, 2, k, i1, i2)
        b1, b2 = rest[3 * STRIDE + k], rest[4 * STRIDE + k]
        b6, area = rest[5 * STRIDE + k], rest[6 * STRIDE + k]
        nx, ny, nz = y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2
        sigma = area / (nx * nx + ny * ny + nz * nz)
        w[(STRAINS + 3) * STRIDE + k] = b1 - sigma * (x11 * nx + y11 * ny + z11 * nz)
        w[(STRAINS + 4) * STRIDE + k] = b2 - sigma * (x22 * nx + y22 * ny + z22 * nz)
        w[(STRAINS + 5) * STRIDE + k] = b6 - 2.0 * sigma * (x12 * nx + y12 * ny + z12 * nz)
    for c in range(3):
        for k in range(count + 2):
            w[(_P + c) * STRIDE + k] = w[(_Q + c) * STRIDE + k]
            w[(_Q + c) * STRIDE + k] = w[(_R + c) * STRIDE + k]
        for k in range(count + 1):
            w[(_LOW + c) * STRIDE + k] = w[(_UP + c) * STRIDE + k]


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def strains(x, spacings, rest, out):
    """Mean membrane strains and bending strains of all elements.

    Parameters
    ----------
    x : ndarray, shape (3, rows, columns)
        Control points, m.
    spacings : tuple of float
        Element lengths around and along, m.
    rest : ndarray
        See `packed`.
    out : ndarray, shape (elements_along, 6, elements_around)
        Receives e_11, e_22, 2 e_12 and k_11, k_22, 2 k_12 (1/m).
    """
    w = np.empty(ROWS * STRIDE)
    for piece in range(rest.shape[0]):
        first = piece * WIDTH
        count = min(WIDTH, out.shape[2] - first)
        begin(w, x, first, count, spacings)
        for j in range(out.shape[0]):
            advance(w, x, j, first, count, spacings, rest[piece, j].ravel())
            for part in range(6):
                for k in range(count):
                    out[j, part, first + k] = w[(STRAINS + part) * STRIDE + k]
