"""How far what shares no knot is from each other within two by two elements, at least.

Let X map the two coordinates of such a window, in elements, onto its triangles. Of two points a
and b of it that lie on nothing that shares a knot, d = b - a has max(|d1|, |d2|, |d1 - d2|) >= 1:
the sum of the hat functions of the knots that carry a is 1 at a and 0 at b, and no hat function
changes faster along d than that maximum. So d is s times a mean of two neighbours among the ways
(1, 0), (1, 1), (0, 1), (-1, 0), or of their opposites, with s >= 1. The window is convex, so that
X(b) - X(a) is s times a mean of edges of these two kinds. If all of them advance by g at least
along one direction, a and b are at least g apart. The directions are taken at right angles to the
mean edge of the third kind: what is flat is measured exactly. No turning of the whole changes
anything.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from foilstudy.model.contact.surface import Triangulation


class Windows:
    """Windows at every knot but those of the last two rows.

    Parameters
    ----------
    surface : Triangulation

    Attributes
    ----------
    count : int
        Of windows; the first ones of all knots.

    Raises
    ------
    ValueError
        If the surface has less than two rows, or three columns, of elements.
    """

    def __init__(self, surface: Triangulation):
        self._columns = surface.patch.columns
        rows = surface.count // self._columns
        if rows < 3 or self._columns < 3:
            raise ValueError("contact needs two rows and three columns of elements at least")
        self.count = (rows - 2) * self._columns
        self._grid = np.empty((3, rows, self._columns + 2))
        self._apart = np.empty((rows - 2, self._columns))

    def near(self, knots: np.ndarray, enough: float | np.ndarray) -> tuple[np.ndarray, float]:
        """Windows where the distance is not known to be enough, and the least of the others, m.

        Parameters
        ----------
        knots : ndarray, shape (count, 3)
            m.
        enough : float or ndarray, shape (count,)
            m.
        """
        _on_grid(knots, self._grid)
        _distances(self._grid, self._apart)
        apart = self._apart.ravel()
        near = ~(apart >= enough)
        return near, float(np.where(near, np.inf, apart).min())

    def apart(self, window: int) -> float:
        """What was known of one when they were looked at last, m; NaN where nothing was."""
        return float(self._apart.flat[window])

    def motions(self, motion: np.ndarray, windows: np.ndarray) -> np.ndarray:
        """Bounds of how much nearer anything comes in some windows by a motion, m."""
        out = np.empty(len(windows))
        _motions(motion, self._columns, windows, out)
        return out

    def element_pairs(self, windows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Elements that share a knot: two each, and the place of their window in `windows`.

        Of all windows every such pair belongs to one.
        """
        found = np.empty((13 * len(windows), 3), dtype=np.int64)
        number = _element_pairs(windows, *self._apart.shape, found)
        return found[:number, :2], found[:number, 2]


@njit(cache=True, error_model="numpy")
def _on_grid(knots, grid):
    """Knots by component, row and column; the first two columns come again at the end."""
    _, rows, wide = grid.shape
    columns = wide - 2
    for j in range(rows):
        for i in range(columns):
            for c in range(3):
                grid[c, j, i] = knots[j * columns + i, c]
        for c in range(3):
            grid[c, j, columns], grid[c, j, columns + 1] = grid[c, j, 0], grid[c, j, 1]


@njit(cache=True, error_model="numpy")
def _less(a, b):
    return a if a < b else b  # in a loop that is vectorised, as `min` is not


@njit(cache=True, error_model="numpy")
def _seen(x, y, z, i, u, v, w):
    """Three knots of a row along a direction."""
    return (
        u * x[i] + v * y[i] + w * z[i],
        u * x[i + 1] + v * y[i + 1] + w * z[i + 1],
        u * x[i + 2] + v * y[i + 2] + w * z[i + 2],
    )


@njit(cache=True, error_model="numpy")
def _around(a):
    """Least advance of edges around."""
    return _less(a[1] - a[0], a[2] - a[1])


@njit(cache=True, error_model="numpy")
def _along(a, b):
    """The same of edges along, from row to row."""
    return _less(_less(b[0] - a[0], b[1] - a[1]), b[2] - a[2])


@njit(cache=True, error_model="numpy")
def _across(a, b):
    """The same of diagonals."""
    return _less(b[1] - a[0], b[2] - a[1])


@njit(cache=True, error_model="numpy")
def _distances(grid, out):
    """Least distance of what shares no knot in every window, or less; NaN where not known."""
    rows, columns = out.shape
    for j in range(rows):
        x0, x1, x2 = grid[0, j], grid[0, j + 1], grid[0, j + 2]
        y0, y1, y2 = grid[1, j], grid[1, j + 1], grid[1, j + 2]
        z0, z1, z2 = grid[2, j], grid[2, j + 1], grid[2, j + 2]
        row = out[j]
        for i in range(columns):
            # six times the mean edges around and along
            e = x0[i + 2] - x0[i] + x1[i + 2] - x1[i] + x2[i + 2] - x2[i]
            f = y0[i + 2] - y0[i] + y1[i + 2] - y1[i] + y2[i + 2] - y2[i]
            g = z0[i + 2] - z0[i] + z1[i + 2] - z1[i] + z2[i + 2] - z2[i]
            p = x2[i] - x0[i] + x2[i + 1] - x0[i + 1] + x2[i + 2] - x0[i + 2]
            q = y2[i] - y0[i] + y2[i + 1] - y0[i + 1] + y2[i + 2] - y0[i + 2]
            r = z2[i] - z0[i] + z2[i + 1] - z0[i + 1] + z2[i + 2] - z0[i + 2]
            ee, pp, ep = e * e + f * f + g * g, p * p + q * q + r * r, e * p + f * q + g * r
            # edges around and diagonals, along what is at right angles to edges along
            part = ep / pp
            u, v, w = e - part * p, f - part * q, g - part * r
            a, b, c = (
                _seen(x0, y0, z0, i, u, v, w),
                _seen(x1, y1, z1, i, u, v, w),
                _seen(x2, y2, z2, i, u, v, w),
            )
            least = _less(_less(_around(a), _around(b)), _around(c))
            least = _less(least, _less(_across(a, b), _across(b, c)))
            first = least / np.sqrt(u * u + v * v + w * w)
            # diagonals and edges along
            part = ep / ee
            u, v, w = p - part * e, q - part * f, r - part * g
            a, b, c = (
                _seen(x0, y0, z0, i, u, v, w),
                _seen(x1, y1, z1, i, u, v, w),
                _seen(x2, y2, z2, i, u, v, w),
            )
            least = _less(_less(_along(a, b), _along(b, c)), _less(_across(a, b), _across(b, c)))
            second = least / np.sqrt(u * u + v * v + w * w)
            # edges along, and edges around the other way
            part = (ep + pp) / (ee + 2.0 * ep + pp)
            u, v, w = p - part * (e + p), q - part * (f + q), r - part * (g + r)
            a, b, c = (
                _seen(x0, y0, z0, i, -u, -v, -w),
                _seen(x1, y1, z1, i, -u, -v, -w),
                _seen(x2, y2, z2, i, -u, -v, -w),
            )
            least = _less(_less(_around(a), _around(b)), _around(c))
            least = _less(least, _less(_along(b, a), _along(c, b)))
            third = least / np.sqrt(u * u + v * v + w * w)
            # what is not a number stays so
            row[i] = _less(_less(first, second), third) + 0.0 * (first + second + third)


@njit(cache=True, error_model="numpy")
def _motions(motion, columns, windows, out):
    for n in range(len(windows)):
        row, column = divmod(windows[n], columns)
        means = np.zeros(3)
        for turn in range(2):
            most = 0.0
            for j in range(row, row + 3):
                for k in range(column, column + 3):
                    p = j * columns + (k if k < columns else k - columns)
                    square = 0.0
                    for c in range(3):
                        if turn == 0:
                            means[c] += motion[p, c] / 9.0
                        square += (motion[p, c] - means[c]) ** 2
                    most = max(most, square)
        out[n] = 2.0 * np.sqrt(most)


@njit(cache=True, error_model="numpy")
def _element_pairs(windows, rows, columns, found):
    number = 0
    for n in range(len(windows)):
        first, column = divmod(windows[n], columns)
        right = column + 1 if column + 1 < columns else 0
        # the last window has the last row of elements, and the edges beyond it, too
        until = first + 3 if first == rows - 1 else first + 1
        for row in range(first, until):
            here, beside = row * columns + column, row * columns + right
            found[number] = min(here, beside), max(here, beside), n
            number += 1
            if row == rows + 1:
                continue
            for below in (here, beside):
                for above in (here + columns, beside + columns):
                    if below == beside and above == beside + columns:
                        continue  # of the next window
                    found[number] = below, above, n
                    number += 1
    return number
