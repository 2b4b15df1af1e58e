"""Ring motions, their names, units and places, and the pairs of them in a frequency response."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from foilstudy.measure.dynamics import CONDITIONS
from foilstudy.measure.stiffness import DOF_NAMES

QUANTITIES = {"receptance": "", "accelerance": "/s^2"}
"""What the unit of a motion becomes in the numerator."""


@dataclass(frozen=True)
class Motion:
    """One motion of a ring.

    Attributes
    ----------
    name : str
        For example ``top_uz``.
    node : int
        1 for the centre of the bottom ring, 2 for that of the top ring.
    direction : int
        1 to 3 translations, 4 to 6 rotations along and about x, y, z.
    """

    name: str
    node: int
    direction: int

    @property
    def unit(self) -> str:
        """Of the motion."""
        return "m" if self.direction <= 3 else "rad"

    @property
    def force_unit(self) -> str:
        """Of the force or the moment on it."""
        return "N" if self.direction <= 3 else "N m"


@dataclass(frozen=True)
class Pair:
    """A motion per a force on a motion."""

    response: Motion
    reference: Motion

    @property
    def text(self) -> str:
        """In words."""
        return f"{self.response.name} per force on {self.reference.name}"

    def units(self, quantity: str) -> str:
        """For example m/s^2/N."""
        unit = self.response.unit + QUANTITIES[quantity]
        force = self.reference.force_unit
        return f"{unit}/({force})" if " " in force else f"{unit}/{force}"


def moving(condition: str) -> list[Motion]:
    """The motions that a condition of `CONDITIONS` leaves free."""
    motions = [Motion(name, 1 + k // 6, 1 + k % 6) for k, name in enumerate(DOF_NAMES)]
    return motions[CONDITIONS[condition]]


def pairs(condition: str) -> Iterator[tuple[int, int, Pair]]:
    """Row, column and pair of every entry of a frequency response under a condition."""
    motions = moving(condition)
    for i, response in enumerate(motions):
        for j, reference in enumerate(motions):
            yield i, j, Pair(response, reference)
