"""What surrounds a foil, and what it encloses: what their variants have in common."""

from __future__ import annotations

from typing import Protocol, Self

from foilstudy.measure.air.surface import WettedSurface
from foilstudy.measure.dynamics.structure import Structure
from foilstudy.measure.stiffness import Rings


class Enclosure(Protocol):
    """What happens to the enclosed air."""

    @classmethod
    def under(cls, pressure: float) -> Self:
        """At a pressure inside and outside, Pa."""
        ...

    def stiffness(self, volume: float) -> float:
        """Pressure per volume that is taken from so much air, Pa/m3."""
        ...


class Air(Protocol):
    """What surrounds a foil."""

    @classmethod
    def of(cls, density: float, enclosure: Enclosure) -> Self:
        """Of a density, kg/m3."""
        ...

    def about(self, structure: Structure, surface: WettedSurface, rings: Rings) -> Structure:
        """The structure with what the air adds to its mass and stiffness."""
        ...
