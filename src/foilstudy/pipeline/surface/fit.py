"""Control points of the quadratic B-spline patch through a grid of surface points.

Points at the knots do not determine a uniform quadratic spline: the average of two neighbouring
control points is blind to an alternating one. Points at the element middles do, (1, 6, 1)/8 being
well conditioned, and with them the two edges (M. J. Marsden, Quadratic spline interpolation, Bull.
Amer. Math. Soc. 80, 1974). Around, the elements are laid such that their middles are points of the
grid; along, the middles are taken from the cubic spline through the points, and both edges are
knots.
"""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

from foilstudy.model.patch import Patch
from foilstudy.pipeline.surface.grid import SurfaceGrid

_MIDDLE = np.array([1.0, 6.0, 1.0]) / 8
"""Weights of three control points in the middle of an element."""


def fitted_patch(grid: SurfaceGrid) -> tuple[Patch, np.ndarray]:
    """Patch and control points of a grid.

    The element lengths are the mean lengths of the surface lines through the knots, where the
    element measures its membrane strains.

    Parameters
    ----------
    grid : SurfaceGrid
        Checked.

    Returns
    -------
    patch : Patch
    points : ndarray, shape (3, rows, columns)
        Control points, m.
    """
    points, cells = np.moveaxis(grid.points, 2, 0), grid.points_per_element
    control = _columns_through(_best_rows(_along(points, cells), cells))
    around = np.roll(control, -1, axis=2) - control
    along = np.diff(control, axis=1)
    around = 0.5 * (around[:, :-1] + around[:, 1:])
    along = 0.5 * (along + np.roll(along, -1, axis=2))
    lengths = (float(np.linalg.norm(a, axis=0).mean()) for a in (around, along))
    patch = Patch(control.shape[2], control.shape[1] - 2, *lengths)
    return patch, np.ascontiguousarray(control)


def _best_rows(values: np.ndarray, cells: int) -> np.ndarray:
    """Control points around, for the first column that leaves the other points on the surface.

    With several points per element the elements may begin at any of the first ones. Through the
    wrong ones the spline waves between the points; that is seen at those left out.
    """
    tries = []
    for first in range(cells):
        turned = np.roll(values, -first, axis=2)
        control = _rows_through(turned[:, :, cells // 2 :: cells])
        tries.append((_misfit(control, turned, cells), control))
    best = min(tries, key=lambda each: each[0])
    # as given, unless another one is clearly better
    return tries[0][1] if tries[0][0] <= 2 * best[0] else best[1]


def _misfit(control: np.ndarray, values: np.ndarray, cells: int) -> float:
    """Largest distance of a point from the surface, both at the same parameter around, m."""
    following = [np.roll(control, -k, axis=2) for k in range(3)]
    largest = 0.0
    for point in range(cells):
        s = (point + 0.5 * (cells % 2)) / cells  # a single point, or the middle one, is a middle
        weights = 0.5 * (1 - s) ** 2, 0.5 + s - s**2, 0.5 * s**2
        surface = sum(w * each for w, each in zip(weights, following, strict=True))
        away = np.linalg.norm(surface - values[:, :, point::cells], axis=0)
        largest = max(largest, float(away.max()))
    return largest


def _along(points: np.ndarray, cells: int) -> np.ndarray:
    """Values at the lower edge, at the element middles along and at the upper edge."""
    last = points.shape[1] - 1
    middles = cells * (np.arange(last // cells) + 0.5)
    return CubicSpline(np.arange(last + 1), points, axis=1)(np.concatenate([[0], middles, [last]]))


def _rows_through(values: np.ndarray) -> np.ndarray:
    """Periodic control points whose element middles take the given values."""
    columns = values.shape[2]
    symbol = _MIDDLE[1] + 2 * _MIDDLE[0] * np.cos(2 * np.pi * np.arange(columns) / columns)
    control = np.fft.ifft(np.fft.fft(values, axis=2) / symbol, axis=2).real
    return np.roll(control, 1, axis=2)  # element i is carried by the columns i, i + 1, i + 2


def _columns_through(values: np.ndarray) -> np.ndarray:
    """Control points whose edges and element middles take the given values."""
    rows = values.shape[1]
    system = np.zeros((rows, rows))
    system[0, :2] = system[-1, -2:] = 0.5
    for row in range(1, rows - 1):
        system[row, row - 1 : row + 2] = _MIDDLE
    flat = np.moveaxis(values, 1, 0).reshape(rows, -1)
    control = np.linalg.solve(system, flat).reshape(rows, 3, -1)
    return np.moveaxis(control, 0, 1)
