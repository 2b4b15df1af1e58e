"""Surface geometry at the element middles."""

from __future__ import annotations

import numpy as np
from numba import njit


@njit(cache=True, fastmath=True, error_model="numpy")
def reference_geometry(x, n_around, h1, h2):
    """First and second fundamental forms and membrane-strain gradients at element middles.

    Parameters
    ----------
    x : ndarray, shape (3, rows, columns)
    n_around : int
        Elements around: as many as columns on a periodic patch, two less on an open one.
    h1, h2 : float
        Element lengths around and along.

    Returns
    -------
    ndarray, shape (elements_along, 12, elements_around)
        a_11, a_22, 2 a_12, b_11, b_22, 2 b_12 and the derivatives in direction 1, then 2, of
        (a_11/2, a_22/2, a_12).
    """
    n_along, columns = x.shape[1] - 2, x.shape[2]
    out = np.empty((n_along, 12, n_around))
    a = np.empty((5, 3))
    for j in range(n_along):
        for i in range(n_around):
            i1, i2 = (i + 1) % columns, (i + 2) % columns
            for c in range(3):
                p = x[c, j]
                q = x[c, j + 1]
                r = x[c, j + 2]
                n0 = (p[i] + 6.0 * q[i] + r[i]) / 8.0
                n1 = (p[i1] + 6.0 * q[i1] + r[i1]) / 8.0
                n2 = (p[i2] + 6.0 * q[i2] + r[i2]) / 8.0
                d0 = (r[i] - p[i]) / (2.0 * h2)
                d1 = (r[i1] - p[i1]) / (2.0 * h2)
                d2 = (r[i2] - p[i2]) / (2.0 * h2)
                s0 = p[i] - 2.0 * q[i] + r[i]
                s1 = p[i1] - 2.0 * q[i1] + r[i1]
                s2 = p[i2] - 2.0 * q[i2] + r[i2]
                a[0, c] = (n2 - n0) / (2.0 * h1)
                a[1, c] = (d0 + 6.0 * d1 + d2) / 8.0
                a[2, c] = (n0 - 2.0 * n1 + n2) / (h1 * h1)
                a[3, c] = (s0 + 6.0 * s1 + s2) / (8.0 * h2 * h2)
                a[4, c] = (d2 - d0) / (2.0 * h1)
            normal = np.cross(a[0], a[1])
            area = np.sqrt(np.sum(normal * normal))
            out[j, 0, i] = np.sum(a[0] * a[0])
            out[j, 1, i] = np.sum(a[1] * a[1])
            out[j, 2, i] = 2.0 * np.sum(a[0] * a[1])
            out[j, 3, i] = np.sum(a[2] * normal) / area
            out[j, 4, i] = np.sum(a[3] * normal) / area
            out[j, 5, i] = 2.0 * np.sum(a[4] * normal) / area
            out[j, 6, i] = np.sum(a[2] * a[0])
            out[j, 7, i] = np.sum(a[4] * a[1])
            out[j, 8, i] = np.sum(a[2] * a[1]) + np.sum(a[4] * a[0])
            out[j, 9, i] = np.sum(a[4] * a[0])
            out[j, 10, i] = np.sum(a[3] * a[1])
            out[j, 11, i] = np.sum(a[4] * a[1]) + np.sum(a[3] * a[0])
    return out
