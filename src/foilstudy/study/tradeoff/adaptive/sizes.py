"""Elements of several sizes that have the same error as a uniform mesh, and how many there are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from foilstudy.study.tradeoff.adaptive.sensor import (
    cell_errors,
    cell_sums,
    element_errors,
    over_elements,
)

COARSEST, FINEST = 3, -2
"""Levels of a tree: an element is 2^level times as large as those of the uniform mesh."""
_ROUNDING = 1e-9
_HALVINGS = 60
"""Of the interval in which the price of an element is sought."""


@dataclass(frozen=True)
class Tree:
    """Squares of a quad-tree.

    Attributes
    ----------
    levels : ndarray of int, shape (elements along, elements around)
        By element of the uniform mesh, that of the square which covers it.
    elements : int
    error : float
        Of the strain energy, J.
    """

    levels: np.ndarray
    elements: int
    error: float

    def share(self, level: int) -> float:
        """Of the area, that of elements of a level."""
        return float(np.mean(self.levels == level))


def best_tree(fields: np.ndarray, periodic: bool = True, balanced: bool = True) -> Tree:
    """The tree of fewest elements with no larger an error than the uniform mesh.

    Every element has a price, and a square is split where that takes more off the error than its
    parts cost; the price is the highest that leaves the error of the uniform mesh. Errors below the
    size of the uniform mesh are continued at second order.

    Parameters
    ----------
    fields : ndarray
        From `sensor.strain_fields`.
    periodic : bool
        Whether the sheet closes on itself around.
    balanced : bool
        Whether neighbours may differ by one level only, as splines of good condition need it.
    """
    errors = {0: element_errors(fields)}
    errors |= {level: cell_errors(fields, 2**level) for level in range(1, COARSEST + 1)}
    allowed = errors[0].sum() * (1 + _ROUNDING)
    low, high = np.log(allowed * 1e-12), np.log(allowed)
    best = _tree(errors, np.exp(low), periodic, balanced)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        tree = _tree(errors, np.exp(middle), periodic, balanced)
        if tree.error <= allowed:
            low, best = middle, min(best, tree, key=lambda each: each.elements)
        else:
            high = middle
    return best


def _tree(errors: Mapping[int, np.ndarray], price: float, periodic: bool, balanced_: bool) -> Tree:
    levels = _chosen(errors, price)
    if balanced_:
        levels = balanced(levels, periodic)
    elements, error = 0, 0.0
    for level in range(FINEST, COARSEST + 1):
        here = levels[:: 2**level, :: 2**level] == level if level > 0 else levels == level
        finer = 4 ** max(-level, 0)
        elements += finer * int(here.sum())
        error += errors[max(level, 0)][here].sum() / finer
    return Tree(levels, elements, float(error))


def _chosen(errors: Mapping[int, np.ndarray], price: float) -> np.ndarray:
    """Levels that make error and price together least, from the finest squares up."""
    parts = np.array([4**k for k in range(-FINEST + 1)])[:, None, None]
    ways = errors[0] / parts + price * parts
    levels, least = -ways.argmin(axis=0), ways.min(axis=0)
    for level in range(1, COARSEST + 1):
        split, whole = cell_sums(least, 2, 2), errors[level] + price
        covered = over_elements(whole <= split, 2**level, levels.shape)
        levels = np.where(covered, level, levels)
        least = np.minimum(split, whole)
    return levels


def balanced(levels: np.ndarray, periodic: bool) -> np.ndarray:
    """Squares split until neighbours differ by one level at most."""
    levels = levels.copy()
    while True:
        around = np.pad(levels, ((0, 0), (1, 1)), mode="wrap" if periodic else "edge")
        along = np.pad(levels, ((1, 1), (0, 0)), mode="edge")
        neighbours = (around[:, :-2], around[:, 2:], along[:-2], along[2:])
        excess = levels > np.min(neighbours, axis=0) + 1
        if not excess.any():
            return levels
        for level in range(FINEST + 1, COARSEST + 1):
            side = 2 ** max(level, 0)
            wrong = cell_sums((excess & (levels == level)).astype(int), side, side) > 0
            wrong = over_elements(wrong, side, levels.shape)
            levels[wrong] = level - 1


def ideal_gain(errors: np.ndarray) -> float:
    """Elements of the uniform mesh over those of any sizes anywhere, at the same error.

    The errors of all elements are then the same, which makes their size the fourth root of the
    inverse error; no mesh of squares has fewer elements.

    Parameters
    ----------
    errors : ndarray
        By element of a uniform mesh.
    """
    return float(errors.size * errors.sum() / np.sqrt(errors).sum() ** 2)


def graded_gain(around: np.ndarray, along: np.ndarray) -> float:
    """The same of whole rows and columns of any sizes, and any ratio of their numbers.

    Parameters
    ----------
    around, along : ndarray
        From `sensor.directional_errors`.
    """
    columns, rows = around.sum(axis=0), along.sum(axis=1)
    ratio = (columns.sum() + rows.sum()) / (2 * np.sqrt(columns.sum() * rows.sum()))
    return float(ratio * _line_gain(columns) * _line_gain(rows))


def _line_gain(errors: np.ndarray) -> float:
    """Intervals of one size over those of any sizes, at the same error."""
    return np.sqrt(errors.mean()) / np.cbrt(errors).mean() ** 1.5
