"""Blocks of elements: which are near each other, and how they move against each other.

Pairs of blocks are in the order of their first block, which is the one with the lower number. What
belongs to elements that share a knot is left to the windows (`windows`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numba import njit

from foilstudy.model.contact.candidates import fill_ball, whole
from foilstudy.model.contact.surface import Triangulation

_SIDE = 3
"""Elements of a block in either direction."""


@dataclass(frozen=True, eq=False)
class Blocks:
    """Elements of a surface by blocks, and the knots at their corners.

    Attributes
    ----------
    surface : Triangulation
    bounds : ndarray of int, shape (blocks, 4)
        Rows from and until, then columns from and until, of each block.
    knots : ndarray of int
        Of all blocks in turn.
    starts : ndarray of int, shape (blocks + 1,)
        Where those of each block begin.
    """

    surface: Triangulation
    bounds: np.ndarray
    knots: np.ndarray
    starts: np.ndarray

    def __len__(self) -> int:
        return len(self.bounds)

    def elements_of(self, blocks: np.ndarray) -> np.ndarray:
        """Elements of some blocks, each once."""
        columns = self.surface.patch.columns
        return np.concatenate(
            [_elements(bounds, columns) for bounds in self.bounds[np.unique(blocks)]]
        )

    def near(self, knots: np.ndarray, distance: float) -> np.ndarray:
        """Pairs of blocks whose balls are near, each with itself included.

        Parameters
        ----------
        knots : ndarray, shape (count, 3)
            m.
        distance : float
            m.
        """
        middles, radii = np.empty((len(self), 3)), np.empty(len(self))
        spread(knots, self.knots, self.starts, middles, radii)
        axis = int(np.argmax(np.ptp(middles, axis=0)))
        order = np.argsort(middles[:, axis], kind="stable")
        found = whole(_near_blocks, 16 * len(self), middles, radii, order, axis, distance, width=2)
        return found[np.argsort(found[:, 0], kind="stable")]

    def closings(self, here: np.ndarray, before: np.ndarray, pairs: np.ndarray) -> np.ndarray:
        """Bounds of how much nearer the blocks of each pair came between two shapes, m."""
        bounds = np.empty(len(pairs))
        means, most = np.empty((len(self), 3)), np.empty(len(self))
        _closings(here, before, self.knots, self.starts, means, most, pairs, bounds)
        return bounds

    def near_elements(self, knots, pairs, balls, distance) -> np.ndarray:
        """Elements near each other in pairs of blocks: two each, and the pair of blocks."""
        return whole(
            _near_elements, 16 * len(pairs), knots, self.surface.corners,
            self.surface.patch.columns, pairs, self.bounds, *balls, distance, width=3,
        )  # fmt: skip


def _elements(bounds: np.ndarray, columns: int) -> np.ndarray:
    rows, around = np.arange(*bounds[:2]), np.arange(*bounds[2:])
    return (columns * rows[:, None] + around).ravel()


@lru_cache(maxsize=4)
def blocks_of(surface: Triangulation) -> Blocks:
    """The blocks of a surface."""
    columns = surface.patch.columns
    rows = surface.count // columns
    across = -(-columns // _SIDE)
    row, column = np.divmod(np.arange(-(-rows // _SIDE) * across), across)
    bounds = np.stack(
        [
            _SIDE * row,
            np.minimum(_SIDE * (row + 1), rows),
            _SIDE * column,
            np.minimum(_SIDE * (column + 1), columns),
        ],
        axis=1,
    )
    members = [np.unique(surface.corners[_elements(each, columns)]) for each in bounds]
    starts = np.concatenate([[0], np.cumsum([len(each) for each in members])])
    return Blocks(surface, bounds, np.concatenate(members), starts)


class Distances:
    """Of pairs of blocks, in the shape that is asked for.

    Parameters
    ----------
    blocks : Blocks
    most : float
        Up to where they are worth knowing, m.
    """

    def __init__(self, blocks: Blocks, most: float):
        self._blocks, self._most = blocks, most
        count, number = blocks.surface.count, len(blocks)
        self._balls = np.empty((number, 3)), np.empty(number)
        self._elements = np.empty((count, 3)), np.empty(count)

    def known(self, knots, pairs, which, enough) -> np.ndarray:
        """Least distance of elements that share no knot in some pairs of blocks, m.

        Parameters
        ----------
        knots : ndarray, shape (count, 3)
            m.
        pairs : ndarray of int, shape (pairs, 2)
        which : ndarray of int
            Of these pairs.
        enough : float
            From where on it is worth knowing, m; what is less is negative.
        """
        blocks, out = self._blocks, np.empty(len(which))
        surface = blocks.surface
        _distances(
            knots, surface.corners, surface.patch.columns, blocks.bounds, blocks.knots,
            blocks.starts, pairs, which, np.zeros(len(blocks), dtype=np.bool_), *self._balls,
            *self._elements, enough, self._most, out,
        )  # fmt: skip
        return out


@njit(cache=True, error_model="numpy")
def _distances(
    knots, corners, columns, bounds, block_knots, starts, pairs, which, filled, middles, radii,
    element_middles, element_radii, enough, most, out,
):  # fmt: skip
    for k in range(len(which)):
        b, c = pairs[which[k]]
        for block in (b, c):
            if filled[block]:
                continue
            filled[block] = True
            spread_one(knots, block_knots, starts, block, middles, radii)
            for j in range(bounds[block, 0], bounds[block, 1]):
                for i in range(bounds[block, 2], bounds[block, 3]):
                    fill_ball(knots, corners, j * columns + i, element_middles, element_radii)
        gap = _gap(middles, radii, b, c)
        if b != c and gap >= most:
            out[k] = gap
            continue
        least = _least_distance(
            knots, corners, columns, bounds[b], bounds[c], b == c, element_middles,
            element_radii, enough, most,
        )  # fmt: skip
        out[k] = max(least, gap) if gap >= enough and b != c else least


@njit(cache=True, error_model="numpy")
def _least_distance(
    knots, corners, columns, first, second, same, middles, radii, enough, most
):  # fmt: skip
    """Least distance of elements of two blocks that share no knot; negative where not enough."""
    least = most
    for j in range(first[0], first[1]):
        for i in range(first[2], first[3]):
            e = j * columns + i
            x, y, z, size = middles[e, 0], middles[e, 1], middles[e, 2], radii[e]
            for m in range(j if same else second[0], second[1]):
                for n in range(i + 1 if same and m == j else second[2], second[3]):
                    f = m * columns + n
                    u, v, w = middles[f, 0] - x, middles[f, 1] - y, middles[f, 2] - z
                    far = size + radii[f] + least
                    if u * u + v * v + w * w >= far * far or _share_a_knot(columns, j, i, m, n):
                        continue
                    gap = _distance(knots, corners, e, f, middles, radii)
                    if not gap >= enough:
                        return -1.0
                    least = min(least, gap)
    return least


@njit(cache=True, error_model="numpy")
def _share_a_knot(columns, row, column, other_row, other):
    """Whether two elements do."""
    steps = abs(other - column)
    return abs(other_row - row) < 2 and (steps < 2 or steps == columns - 1)


@njit(cache=True, error_model="numpy")
def _distance(knots, corners, e, f, middles, radii):
    """Of two elements at least, m: that of the balls around them, or along their middles."""
    x, y, z = (
        middles[f, 0] - middles[e, 0],
        middles[f, 1] - middles[e, 1],
        middles[f, 2] - middles[e, 2],
    )
    end, begin = -np.inf, np.inf
    for k in range(4):
        p, q = corners[e, k], corners[f, k]
        end = max(end, x * knots[p, 0] + y * knots[p, 1] + z * knots[p, 2])
        begin = min(begin, x * knots[q, 0] + y * knots[q, 1] + z * knots[q, 2])
    size = np.sqrt(x * x + y * y + z * z)
    return max(size - radii[e] - radii[f], (begin - end) / size)


@njit(cache=True, error_model="numpy")
def _gap(middles, radii, b, c):
    square = 0.0
    for i in range(3):
        way = middles[b, i] - middles[c, i]
        square += way * way
    return np.sqrt(square) - radii[b] - radii[c]


@njit(cache=True, error_model="numpy")
def spread(field, knots, starts, means, most):
    """Mean of a field over the knots of each block, and the largest deviation from it."""
    for b in range(len(most)):
        spread_one(field, knots, starts, b, means, most)


@njit(cache=True, error_model="numpy")
def spread_one(field, knots, starts, b, means, most):
    """The same of one block."""
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
def _closings(here, before, knots, starts, means, most, pairs, bounds):
    motion = np.empty((len(here), 3))
    for p in range(len(here)):
        for c in range(3):
            motion[p, c] = here[p, c] - before[p, c]
    spread(motion, knots, starts, means, most)
    for k in range(len(pairs)):
        b, c = pairs[k]
        bounds[k] = _gap(means, most, b, c) + 2.0 * (most[b] + most[c])


@njit(cache=True, error_model="numpy")
def _near_blocks(middles, radii, order, axis, distance, found):
    """Write the pairs of blocks whose balls are near; return their number."""
    largest = radii.max()
    number = 0
    for n in range(len(order)):
        b = order[n]
        for m in range(n, len(order)):
            c = order[m]
            if middles[c, axis] - middles[b, axis] > radii[b] + largest + distance:
                break
            if m > n and _gap(middles, radii, b, c) > distance:
                continue
            if number < len(found):
                found[number, 0], found[number, 1] = min(b, c), max(b, c)
            number += 1
    return number


@njit(cache=True, error_model="numpy")
def kept_pairs(pairs, before, starts, where):
    """Write where pairs of blocks were among those before, -1 of those that were not.

    Parameters
    ----------
    pairs, before : ndarray of int, shapes (pairs, 2), (before, 2)
    starts : ndarray of int, shape (blocks + 1,)
        Where those of each first block began.
    where : ndarray of int, shape (pairs,)
    """
    for k in range(len(pairs)):
        b, c = pairs[k]
        where[k] = -1
        for n in range(starts[b], starts[b + 1]):
            if before[n, 1] == c:
                where[k] = n


@njit(cache=True, error_model="numpy")
def _near_elements(knots, corners, columns, pairs, bounds, middles, radii, distance, found):
    number = 0
    for k in range(len(pairs)):
        first, second = bounds[pairs[k, 0]], bounds[pairs[k, 1]]
        same = pairs[k, 0] == pairs[k, 1]
        for j in range(first[0], first[1]):
            for i in range(first[2], first[3]):
                for m in range(j if same else second[0], second[1]):
                    for n in range(i + 1 if same and m == j else second[2], second[3]):
                        if _share_a_knot(columns, j, i, m, n):
                            continue
                        e, f = j * columns + i, m * columns + n
                        if _distance(knots, corners, e, f, middles, radii) >= distance:
                            continue
                        if number < len(found):
                            found[number, 0], found[number, 1] = min(e, f), max(e, f)
                            found[number, 2] = k
                        number += 1
    return number
