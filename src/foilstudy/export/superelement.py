"""The reduced model as a superelement: which coordinate stands at which node, and numbers of at
most 20 characters, as both codes read no more."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from foilstudy.export.contents import Contents
from foilstudy.measure.stiffness import fixed_stiffness

__all__ = ["BOTTOM", "INNER", "TOP", "Place", "entries", "expected", "inner_places", "number"]

BOTTOM, TOP, INNER = 9001, 9002, 9011
"""Numbers of the nodes: centres of the rings, and the first of those that carry no motion but
three generalised coordinates each as their translations."""

_PER_NODE = 3
_LEAST = 1e-99
"""Below it an exponent has three digits and the number more than 20 characters."""


@dataclass(frozen=True)
class Place:
    """Degree of freedom of a node: 1 to 3 translations, 4 to 6 rotations."""

    node: int
    freedom: int


def inner_places(count: int) -> list[Place]:
    """Of so many generalised coordinates."""
    return [Place(INNER + k // _PER_NODE, 1 + k % _PER_NODE) for k in range(count)]


def entries(matrix: np.ndarray, places: Sequence[Place]) -> Iterator[str]:
    """The lower triangle of a symmetric matrix with its diagonal, zeros left out.

    As lines ``row node, its degree of freedom, column node, its degree of freedom, entry``.
    """
    for i, row in enumerate(places):
        for j, column in enumerate(places[: i + 1]):
            value = float(matrix[i, j])
            if abs(value) > _LEAST:
                pair = f"{row.node}, {row.freedom}, {column.node}, {column.freedom}"
                yield f"{pair}, {number(value)}"


def number(value: float) -> str:
    """14 digits."""
    return f"{value:.13e}" if abs(value) > _LEAST else "0."


def expected(contents: Contents) -> str:
    """What another code should find, in words."""
    axial, radial = fixed_stiffness(contents.model.static_stiffness)
    frequencies = ", ".join(f"{f:.2f}" for f in contents.eigenfrequencies[:6])
    return f"""
        Expected: transfer stiffness axial {axial:.6g} N/m, radial {radial:.6g} N/m (mean of x and
        y): minus the force on the top ring per motion of the bottom ring, all other motions of
        both held. Eigenfrequencies with both rings held
        {frequencies} Hz.
        """
