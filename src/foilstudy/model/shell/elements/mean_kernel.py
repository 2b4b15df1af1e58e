"""Vectorised mean strains of the corner-sampled element, and where they have changed by much.

The mean of the membrane strains at the four corners of an element, and the bending strain in its
middle. A row of elements is taken in pieces of `PIECE` at most, whose control points and results
lie in work arrays: those that are read and those that are written are apart and have rows of
constant distance, without which the compiler does not vectorise the loops. Nothing here is compiled
with fast-math: a state that was made of these strains is kept.
"""

from __future__ import annotations

import numpy as np
from numba import njit

PIECE = 128
_LANES = 8
_W = PIECE + 2 * _LANES
# Rows of what is kept of the elements: metrics and curvatures that were seen last, |a_1 x a_2| at
# rest, and the square of the room that was left then.
MARK, BENT, AREA, ROOM, VALUES = 0, 3, 6, 7, 8
BLOCK = VALUES * _W
"""Values kept of a piece of a row."""
_P, _Q, _R = 0, 3, 6  # control rows below, at and above the element row
_LOWER, _UPPER = 0, 3  # metrics of the corners
_METRIC, _CURVED, _OVER, _RESULTS = 0, 3, 6, 7


def pieces(n_around: int) -> list[tuple[int, int]]:
    """First elements and numbers of elements of the pieces of a row."""
    size = _size(n_around)
    return [(start, min(size, n_around - start)) for start in range(0, n_around, size)]


@njit(cache=True, error_model="numpy", forceinline=True)
def _size(n_around):
    number = (n_around + PIECE - 1) // PIECE
    return (n_around + number - 1) // number


@njit(cache=True, error_model="numpy")
def _load(w, to, x, row, start, count):
    """A row of control points; behind the last column of a closed patch comes the first."""
    columns = x.shape[2]
    inside = min(count, columns - start)
    for c in range(3):
        base = (to + c) * _W
        w[base : base + inside] = x[c, row, start : start + inside]
        for k in range(inside, count):
            w[base + k] = x[c, row, start + k - columns]


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _metrics(w, below, above, g, to, count, i1, i2):
    """a_11 / 2, a_22 / 2 and a_12 of a row of corners."""
    h1, h2 = 0.5 * i1, 0.5 * i2
    for k in range(count):
        p0, p1 = w[below * _W + k], w[below * _W + k + 1]
        q0, q1 = w[above * _W + k], w[above * _W + k + 1]
        x1, x2 = h1 * ((p1 - p0) + (q1 - q0)), h2 * ((q0 - p0) + (q1 - p1))
        p0, p1 = w[(below + 1) * _W + k], w[(below + 1) * _W + k + 1]
        q0, q1 = w[(above + 1) * _W + k], w[(above + 1) * _W + k + 1]
        y1, y2 = h1 * ((p1 - p0) + (q1 - q0)), h2 * ((q0 - p0) + (q1 - p1))
        p0, p1 = w[(below + 2) * _W + k], w[(below + 2) * _W + k + 1]
        q0, q1 = w[(above + 2) * _W + k], w[(above + 2) * _W + k + 1]
        z1, z2 = h1 * ((p1 - p0) + (q1 - q0)), h2 * ((q0 - p0) + (q1 - p1))
        g[to * _W + k] = 0.5 * (x1 * x1 + y1 * y1 + z1 * z1)
        g[(to + 1) * _W + k] = 0.5 * (x2 * x2 + y2 * y2 + z2 * z2)
        g[(to + 2) * _W + k] = x1 * x2 + y1 * y2 + z1 * z2


@njit(cache=True, error_model="numpy", forceinline=True, fastmath={"contract"})
def _derivatives(w, c, k, i1, i2):
    """One component of a_1, a_2, a_11, a_22, a_12 in the middle of an element."""
    p0, p1, p2 = w[(_P + c) * _W + k], w[(_P + c) * _W + k + 1], w[(_P + c) * _W + k + 2]
    q0, q1, q2 = w[(_Q + c) * _W + k], w[(_Q + c) * _W + k + 1], w[(_Q + c) * _W + k + 2]
    r0, r1, r2 = w[(_R + c) * _W + k], w[(_R + c) * _W + k + 1], w[(_R + c) * _W + k + 2]
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
def _mean(g, part, k):
    lower, upper = (_LOWER + part) * _W + k, (_UPPER + part) * _W + k
    return 0.25 * ((g[lower] + g[lower + 1]) + (g[upper] + g[upper + 1]))


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _elements(w, g, kept, out, count, i1, i2, norm):
    """Metrics and curvatures of the elements, and by how much more they have moved than is left.

    The square of the norm of what strains at a face have changed by, of the face where it is more,
    less the room.
    """
    n11, n12, n16, n22, n26, n66, farthest = norm
    for k in range(count):
        x1, x2, x11, x22, x12 = _derivatives(w, 0, k, i1, i2)
        y1, y2, y11, y22, y12 = _derivatives(w, 1, k, i1, i2)
        z1, z2, z11, z22, z12 = _derivatives(w, 2, k, i1, i2)
        nx, ny, nz = y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2
        sigma = kept[AREA * _W + k] / (nx * nx + ny * ny + nz * nz)
        b1 = sigma * (x11 * nx + y11 * ny + z11 * nz)
        b2 = sigma * (x22 * nx + y22 * ny + z22 * nz)
        b6 = 2.0 * sigma * (x12 * nx + y12 * ny + z12 * nz)
        a1, a2, a6 = _mean(g, 0, k), _mean(g, 1, k), _mean(g, 2, k)
        m1 = a1 - kept[MARK * _W + k]
        m2 = a2 - kept[(MARK + 1) * _W + k]
        m6 = a6 - kept[(MARK + 2) * _W + k]
        t1 = farthest * (b1 - kept[BENT * _W + k])
        t2 = farthest * (b2 - kept[(BENT + 1) * _W + k])
        t6 = farthest * (b6 - kept[(BENT + 2) * _W + k])
        mu, mv, mw = n11 * m1 + n12 * m2 + n16 * m6, n22 * m2 + n26 * m6, n66 * m6
        tu, tv, tw = n11 * t1 + n12 * t2 + n16 * t6, n22 * t2 + n26 * t6, n66 * t6
        even = (mu * mu + mv * mv + mw * mw) + (tu * tu + tv * tv + tw * tw)
        odd = mu * tu + mv * tv + mw * tw
        out[_METRIC * _W + k] = a1
        out[(_METRIC + 1) * _W + k] = a2
        out[(_METRIC + 2) * _W + k] = a6
        out[_CURVED * _W + k] = b1
        out[(_CURVED + 1) * _W + k] = b2
        out[(_CURVED + 2) * _W + k] = b6
        out[_OVER * _W + k] = even + 2.0 * abs(odd) - kept[ROOM * _W + k]


@njit(cache=True, error_model="numpy")
def beyond(x, n_around, spacings, rest, kept, norm, elements, strains):
    """Elements whose strains have changed, since they were seen last, by more than is left.

    They have been seen then, and have no room left until it is noted again.

    Parameters
    ----------
    x : ndarray, shape (3, rows, columns)
        Control points, m.
    n_around : int
        Elements around.
    spacings : tuple of float
        Element lengths around and along, m.
    rest : ndarray, shape (elements, 6)
        Of the stress-free shape: mean of a_11 / 2, a_22 / 2, a_12; b_11, b_22, 2 b_12.
    kept : ndarray
        Of the pieces of a row, one row after another; see `VALUES`.
    norm : tuple of float
        Upper triangle of a matrix whose product with a strain is as long as the strain counts, and
        the distance of the faces from the middle, m.
    elements : ndarray of int, shape (elements,)
        Receives them: row times elements around plus column.
    strains : ndarray, shape (elements, 6)
        Receives their e_11, e_22, 2 e_12 and k_11, k_22, 2 k_12 (1/m).

    Returns
    -------
    int
        How many there are.
    """
    i1, i2 = 1.0 / spacings[0], 1.0 / spacings[1]
    w, g, out = np.zeros(9 * _W), np.zeros(6 * _W), np.zeros(_RESULTS * _W)
    size, at, number = _size(n_around), 0, 0
    for j in range(x.shape[1] - 2):
        for start in range(0, n_around, size):
            count = min(size, n_around - start)
            full = _LANES * ((count + _LANES - 1) // _LANES)  # no remainder in loops
            _load(w, _P, x, j, start, count + 2)
            _load(w, _Q, x, j + 1, start, count + 2)
            _load(w, _R, x, j + 2, start, count + 2)
            _metrics(w, _P, _Q, g, _LOWER, full + _LANES, i1, i2)
            _metrics(w, _Q, _R, g, _UPPER, full + _LANES, i1, i2)
            own = kept[at : at + BLOCK]
            at += BLOCK
            _elements(w, g, own, out, full, i1, i2, norm)
            for k in range(count):
                if out[_OVER * _W + k] < 0.0:  # what is not a number is looked at
                    continue
                own[ROOM * _W + k] = 0.0
                element = j * n_around + start + k
                elements[number] = element
                for part in range(3):
                    metric, curved = out[(_METRIC + part) * _W + k], out[(_CURVED + part) * _W + k]
                    own[(MARK + part) * _W + k], own[(BENT + part) * _W + k] = metric, curved
                    strains[number, part] = metric - rest[element, part]
                    strains[number, 3 + part] = rest[element, 3 + part] - curved
                number += 1
    return number
