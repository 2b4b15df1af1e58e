"""The reduced model for CalculiX, of elements that every version has.

CalculiX 2.20 reads no matrices. In the free modes of the reduced model its mass is one and its
stiffness and damping are diagonal: modal coordinates are translations of nodes with a mass of 1 kg,
a spring and a dashpot each, and equations join them to the motions of the rings. Keywords after G.
Dhondt, CalculiX CrunchiX User's Manual, version 2.20.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.export.contents import Contents
from foilstudy.export.decks import comment
from foilstudy.export.superelement import (
    BOTTOM,
    INNER,
    TOP,
    Place,
    expected,
    inner_places,
    number,
)
from foilstudy.measure.dynamics.damping_matrix import viscous_coefficients
from foilstudy.measure.dynamics.structure import INTERFACE

ROTATIONS = {BOTTOM: BOTTOM + 2, TOP: TOP + 2}
"""Nodes of which the translations 1 to 3 are the rotations of a ring."""
GROUND = 9005
"""First of three nodes at rest, 1 m along x, y and z from the coordinates' nodes."""
_FIRST_ELEMENT = 900001
_TERMS_PER_LINE = 4


@dataclass(frozen=True, eq=False)
class _Modes:
    """Modal coordinates, and how they hang on the rings.

    Attributes
    ----------
    stiffness, damping : ndarray, shape (n,)
        Of unit masses, 1/s2 and 1/s.
    led : ndarray of int, shape (12,)
        Coordinates that follow from the rings and the others.
    by_rings, by_others : ndarray, shapes (12, 12) and (12, n - 12)
        What they follow.
    """

    stiffness: np.ndarray
    damping: np.ndarray
    led: np.ndarray
    by_rings: np.ndarray
    by_others: np.ndarray

    @classmethod
    def of(cls, contents: Contents) -> Self:
        from scipy.linalg import qr

        values, vectors = contents.model.free_modes()
        rings = vectors[:INTERFACE]
        sizes = np.linalg.norm(rings, axis=1, keepdims=True)
        order = qr(rings / sizes, mode="r", pivoting=True)[1]
        led = np.sort(order[:INTERFACE])
        by_rings = np.linalg.inv(rings[:, led])
        others = np.delete(rings, led, axis=1)
        return cls(
            values, viscous_coefficients(values, contents.damping), led, by_rings,
            -by_rings @ others,
        )  # fmt: skip

    @property
    def places(self) -> list[Place]:
        return inner_places(self.stiffness.size)


def write(contents: Contents, path: Path) -> None:
    """Write what is to be included in a deck.

    Raises
    ------
    Refusal
        If the damping is not viscous, or the foil is pre-stressed so that a free mode has no
        oscillation.
    """
    modes = _Modes.of(contents)
    if (modes.stiffness < 0).any():
        raise Refusal(
            "a free mode of the reduced model is unstable; CalculiX has no spring for it."
        )
    lines = [*_heading(contents), *_nodes(contents, modes), *_elements(modes), *_equations(modes)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _heading(contents: Contents) -> Iterator[str]:
    yield from comment(
        f"""
        Crumpled foil between two rigid rings as a superelement. Units: m, N, kg, s, rad.
        In the deck, before its steps: *INCLUDE, INPUT=superelement.inp
        Ring centres: translations 1 to 3 of node {BOTTOM} (bottom) and {TOP} (top), rotations as
        degrees of freedom 1 to 3 of nodes {ROTATIONS[BOTTOM]} and {ROTATIONS[TOP]}. Tie them to
        the structure, for example *RIGID BODY, NSET=..., REF NODE={BOTTOM}, ROT
        NODE={ROTATIONS[BOTTOM]}. The rings themselves weigh nothing.
        Nodes from {INNER} on carry modal coordinates, the other nodes are at rest; leave them
        alone. *STATIC and *FREQUENCY; dashpots act in *STEADY STATE DYNAMICS. Linear: without
        NLGEOM. Forces on the rings are no reactions of their nodes; read them in the structure.
        {expected(contents)}
        """,
        contents.provenance,
    )


def _nodes(contents: Contents, modes: _Modes) -> Iterator[str]:
    yield "*NODE, NSET=FOIL_ALL"
    for ring, height in zip((BOTTOM, TOP), contents.ring_heights):
        for node in (ring, ROTATIONS[ring]):
            yield f"{node}, 0., 0., {height:.12e}"
    for axis in range(3):
        yield f"{GROUND + axis}, " + ", ".join("1." if k == axis else "0." for k in range(3))
    for node in sorted({place.node for place in modes.places}):
        yield f"{node}, 0., 0., 0."
    yield from ("*BOUNDARY", f"{GROUND}, 1, 3", f"{GROUND + 1}, 1, 3", f"{GROUND + 2}, 1, 3")
    last = modes.places[-1]
    if last.freedom < 3:
        yield f"{last.node}, {last.freedom + 1}, 3"


def _elements(modes: _Modes) -> Iterator[str]:
    numbers = iter(range(_FIRST_ELEMENT, _FIRST_ELEMENT + 3 * modes.stiffness.size))
    yield "*ELEMENT, TYPE=MASS, ELSET=FOIL_MASS"
    for node in sorted({place.node for place in modes.places}):
        yield f"{next(numbers)}, {node}"
    yield from ("*MASS, ELSET=FOIL_MASS", "1.")
    for k, place in enumerate(modes.places):
        if modes.stiffness[k]:
            yield f"*ELEMENT, TYPE=SPRING1, ELSET=FOIL_K{k}"
            yield f"{next(numbers)}, {place.node}"
            yield from (f"*SPRING, ELSET=FOIL_K{k}", f"{place.freedom}", number(modes.stiffness[k]))
        if modes.damping[k]:
            yield f"*ELEMENT, TYPE=DASHPOTA, ELSET=FOIL_C{k}"
            yield f"{next(numbers)}, {place.node}, {GROUND + place.freedom - 1}"
            yield from (f"*DASHPOT, ELSET=FOIL_C{k}", "", number(modes.damping[k]))


def _equations(modes: _Modes) -> Iterator[str]:
    """A coordinate that is led, less what leads it, is nought."""
    places = modes.places
    rings = [
        Place(node, 1 + axis)
        for ring in (BOTTOM, TOP)
        for node in (ring, ROTATIONS[ring])
        for axis in range(3)
    ]
    others = [place for k, place in enumerate(places) if k not in modes.led]
    factors = np.hstack([modes.by_rings, modes.by_others])
    for k, row in zip(modes.led, factors):
        terms = [(places[k], 1.0)]
        terms += [(place, -value) for place, value in zip([*rings, *others], row) if value]
        yield from ("*EQUATION", f"{len(terms)}")
        for start in range(0, len(terms), _TERMS_PER_LINE):
            part = terms[start : start + _TERMS_PER_LINE]
            yield ", ".join(f"{p.node}, {p.freedom}, {number(value)}" for p, value in part)
