"""Order of elimination on a grid: nested dissection, known without looking at a matrix."""

from __future__ import annotations

import numpy as np

_LEAF = 30
"""Points of a part that is not cut further."""


def dissection(rows: int, columns: int, reach: int, closed: bool) -> np.ndarray:
    """Points of a grid in the order in which they are best eliminated.

    The grid is cut in two along its shorter side by a separator as wide as the stencil reaches, and
    each part again; separators come after what they separate.

    Parameters
    ----------
    rows, columns : int
    reach : int
        To how many rows and columns on either side a point is coupled.
    closed : bool
        Whether the last column is next to the first.

    Returns
    -------
    ndarray of int, shape (rows * columns,)
        Numbers of the points, counted along the rows.
    """
    grid = np.arange(rows * columns).reshape(rows, columns)
    parts: list[np.ndarray] = []
    if closed and columns > 2 * reach:
        half = columns // 2
        opposite = half - reach, columns - reach
        _cut(grid[:, : opposite[0]], reach, parts)
        _cut(grid[:, half : opposite[1]], reach, parts)
        parts += [grid[:, first : first + reach].T.ravel() for first in opposite]
    else:
        _cut(grid, reach, parts)
    return np.concatenate(parts)


def _cut(grid: np.ndarray, reach: int, parts: list[np.ndarray]) -> None:
    """Append the points of a part in their order."""
    grid = grid if len(grid) >= grid.shape[1] else grid.T  # the longer side first
    if grid.size <= _LEAF or len(grid) <= 2 * reach:
        parts.append(grid.ravel())
        return
    first = (len(grid) - reach) // 2
    _cut(grid[:first], reach, parts)
    _cut(grid[first + reach :], reach, parts)
    parts.append(grid[first : first + reach].ravel())
