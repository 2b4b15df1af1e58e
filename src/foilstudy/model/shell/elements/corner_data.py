"""Element data of the corner-sampled sheet in the order in which its kernel reads them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple, Self

import numpy as np

from foilstudy.model.shell.elements.corner_kernel import LACKED, LANES, STEPS, VALUES


def pack(samples: np.ndarray, law: np.ndarray, periodic: bool, share: float) -> np.ndarray:
    """Everything that `corner_kernel.internal_force` reads, as one vector.

    Chunk, row, value, place, lane. What is at hand twice, in neighbouring pieces or chunks, has a
    law in the one that owns it and none in the other.

    Parameters
    ----------
    samples : ndarray, shape (elements_along, elements_around, 20)
        Reference samples of `sampling.corner`: membrane at 4 corners and 4 edges, bending.
    law : ndarray, shape (elements_along, 6, elements_around)
    periodic : bool
    share : float
        Of the membrane stiffness in the control of the checkerboard.
    """
    n_along, n_around, _ = samples.shape
    lines, line_law = _lines(samples, law, periodic)
    vertex = np.concatenate(
        [lines[:, 0:3], lines[-1:, 3:6]]
    )  # seen from above, the last from below
    vertex_law = _on_both_sides(line_law)
    around = np.concatenate([samples[:, :, 14], samples[-1:, :, 15]])
    around_law = 0.5 * share * _on_both_sides(law[:, 1])
    bending = np.concatenate([samples[:, :, 16:20].transpose(0, 2, 1), law], axis=1)
    chunks = list(_chunks(n_around, periodic))
    packed = np.zeros((len(chunks), n_along + 1, VALUES, STEPS + 1, LANES))
    for chunk, (place, at, owned) in enumerate(chunks):
        to = packed[chunk, :, :, : len(place)]
        to[:, 0:3] = vertex[:, :, at]
        to[:, 3:9] = vertex_law[:, :, at] * owned
        to[:-1, 11] = lines[:, 6, at]
        to[:-1, 12] = 2 * share * line_law[:, 0, at] * owned
        element = np.minimum(place[:-1], n_around - 1)
        real = place[:-1] < n_around
        to[:, 9, :-1] = around[:, element]
        to[:, 10, :-1] = around_law[:, element] * real
        to[:-1, 13:, :-1] = bending[:, :, element] * real
    return packed.ravel()


class ElementPlaces(NamedTuple):
    """Where `corner_kernel.internal_force` looks for stresses that elements lack.

    Attributes
    ----------
    first : ndarray of int, shape (elements_around,)
        Where the first value of each element of the lowest row is.
    row, value : int
        From one row, and from one value, to the next.
    size : int
        Of the whole.
    """

    first: np.ndarray
    row: int
    value: int
    size: int

    @classmethod
    def of(cls, n_around: int, n_along: int, periodic: bool) -> Self:
        """Of a patch."""
        value = (STEPS + 2) * LANES
        row, rows = LACKED * value, n_along + 2  # none below and none above
        first, chunk = np.empty(n_around, dtype=np.int64), 0
        for chunk, (place, _, _) in enumerate(_chunks(n_around, periodic)):
            own = place[:-1]
            inside, real = np.arange(own.size).reshape(own.shape), own < n_around
            first[own[real]] = (chunk * rows + 1) * row + LANES + inside[real]
        return cls(first, row, value, (chunk + 1) * rows * row)


def _chunks(n_around: int, periodic: bool) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Of every chunk the places, (steps + 1, lanes), their lines and which own what is there."""
    piece = -(-n_around // LANES)
    lines = n_around if periodic else n_around + 1
    for start in range(0, piece, STEPS):
        steps = min(STEPS, piece - start)
        place = np.arange(LANES) * piece + start + np.arange(steps + 1)[:, None]
        at = place % n_around if periodic else np.minimum(place, n_around)
        owned = place < lines
        owned[-1] &= place[-1] == LANES * piece
        yield place, at, owned


def _lines(samples: np.ndarray, law: np.ndarray, periodic: bool) -> tuple[np.ndarray, np.ndarray]:
    """Samples and law of the lines along of every element row, (elements_along, values, lines).

    Metric at the lower and the upper vertex and 11 between; the law is a quarter of each neighbour.
    """
    lines = samples[:, :, [0, 1, 2, 6, 7, 8, 12]]
    if not periodic:
        lines = np.concatenate([lines, samples[:, -1:, [3, 4, 5, 9, 10, 11, 13]]], axis=1)
    return lines.transpose(0, 2, 1), _line_laws(law, periodic)


def _line_laws(law: np.ndarray, periodic: bool) -> np.ndarray:
    line_law = 0.25 * law
    if periodic:
        return line_law + 0.25 * np.roll(law, 1, axis=2)
    line_law = np.pad(line_law, ((0, 0), (0, 0), (0, 1)))
    line_law[:, :, 1:] += 0.25 * law
    return line_law


def _on_both_sides(of_rows: np.ndarray) -> np.ndarray:
    """What the element rows below and above add up to, at every row of vertices."""
    total = np.zeros((len(of_rows) + 1, *of_rows.shape[1:]))
    total[:-1] += of_rows
    total[1:] += of_rows
    return total
