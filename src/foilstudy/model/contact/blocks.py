"""Blocks of elements: which are near each other, and how they move against each other."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numba import njit
from scipy.spatial import cKDTree

from foilstudy.model.contact.candidates import apart, whole
from foilstudy.model.contact.surface import Triangulation

_SIDE = 3
"""Elements of a block in either direction."""


@dataclass(frozen=True, eq=False)
class Blocks:
    """Elements of a surface by blocks, and the knots at their corners.

    Attributes
    ----------
    elements, knots : ndarray of int
        Of all blocks in turn.
    element_starts, knot_starts : ndarray of int, shape (blocks + 1,)
        Where those of each block begin.
    """

    elements: np.ndarray
    element_starts: np.ndarray
    knots: np.ndarray
    knot_starts: np.ndarray

    def balls(self, knots: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Middle and radius of a ball around the knots of each block, m."""
        count = len(self.knot_starts) - 1
        middles, radii = np.empty((count, 3)), np.empty(count)
        spread(knots, self.knots, self.knot_starts, middles, radii)
        return middles, radii

    def near(self, knots: np.ndarray, distance: float) -> tuple[np.ndarray, np.ndarray]:
        """Pairs of blocks whose balls are near, each with itself included, and their gaps, m."""
        middles, radii = self.balls(knots)
        most = 2 * float(radii.max()) + distance
        others = cKDTree(middles).query_pairs(most, output_type="ndarray")
        itself = np.repeat(np.arange(len(radii))[:, None], 2, axis=1)
        pairs = np.concatenate([itself, others.reshape(-1, 2)])
        gaps = _gaps(middles, radii, pairs)
        kept = gaps <= distance
        return np.ascontiguousarray(pairs[kept]), gaps[kept]

    def gaps(self, knots: np.ndarray, pairs: np.ndarray) -> np.ndarray:
        """Between the balls of pairs of blocks, m; -inf of one with itself."""
        return _gaps(*self.balls(knots), pairs)

    def elements_of(self, blocks: np.ndarray) -> np.ndarray:
        """Elements of some blocks, each once."""
        wanted = np.zeros(len(self.knot_starts) - 1, dtype=bool)
        wanted[blocks] = True
        return self.elements[np.repeat(wanted, np.diff(self.element_starts))]

    def near_elements(self, pairs, balls, distance):
        """Elements near each other in pairs of blocks: two each, and the pair of blocks."""
        return whole(
            _near_elements, 64 * len(pairs), pairs, self.elements, self.element_starts, *balls,
            distance, width=3,
        )  # fmt: skip


def _gaps(middles, radii, pairs):
    """Between the balls of some pairs; -inf of one with itself."""
    first, second = pairs.T
    apart = np.sqrt(np.sum((middles[first] - middles[second]) ** 2, axis=1))
    return np.where(first == second, -np.inf, apart - radii[first] - radii[second])


@lru_cache(maxsize=4)
def blocks_of(surface: Triangulation) -> Blocks:
    """The blocks of a surface."""
    columns = surface.patch.columns
    row, column = np.divmod(np.arange(surface.count), columns)
    across = -(-columns // _SIDE)
    block = (row // _SIDE) * across + column // _SIDE
    elements = np.argsort(block, kind="stable")
    element_starts = np.concatenate([[0], np.cumsum(np.bincount(block))])
    members = [
        np.unique(surface.corners[elements[a:b]])
        for a, b in zip(element_starts[:-1], element_starts[1:], strict=True)
    ]
    knot_starts = np.concatenate([[0], np.cumsum([len(each) for each in members])])
    return Blocks(elements, element_starts, np.concatenate(members), knot_starts)


@njit(cache=True, error_model="numpy")
def spread(field, knots, starts, means, most):
    """Mean of a field over the knots of each block, and the largest deviation from it."""
    for b in range(len(means)):
        number = starts[b + 1] - starts[b]
        x = y = z = 0.0
        for k in range(starts[b], starts[b + 1]):
            p = knots[k]
            x += field[p, 0]
            y += field[p, 1]
            z += field[p, 2]
        x, y, z = x / number, y / number, z / number
        largest = 0.0
        for k in range(starts[b], starts[b + 1]):
            p = knots[k]
            dx, dy, dz = field[p, 0] - x, field[p, 1] - y, field[p, 2] - z
            largest = max(largest, dx * dx + dy * dy + dz * dz)
        means[b, 0], means[b, 1], means[b, 2] = x, y, z
        most[b] = np.sqrt(largest)


@njit(cache=True, error_model="numpy")
def closing_bounds(means, most, pairs, bounds):
    """Bounds of how much nearer the blocks of each pair come by a motion, see `spread`."""
    for k in range(len(pairs)):
        b, c = pairs[k]
        square = 0.0
        for i in range(3):
            way = means[b, i] - means[c, i]
            square += way * way
        bounds[k] = np.sqrt(square) + most[b] + most[c]


@njit(cache=True, error_model="numpy")
def _near_elements(pairs, elements, starts, middles, radii, distance, found):
    number = 0
    for k in range(len(pairs)):
        b, c = pairs[k]
        for i in range(starts[b], starts[b + 1]):
            e = elements[i]
            for j in range(i + 1 if b == c else starts[c], starts[c + 1]):
                f = elements[j]
                if apart(middles[e], radii[e], middles[f], radii[f], distance):
                    continue
                if number < len(found):
                    found[number, 0], found[number, 1] = min(e, f), max(e, f)
                    found[number, 2] = k
                number += 1
    return number
