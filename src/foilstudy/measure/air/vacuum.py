"""No air."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from foilstudy.measure.air.protocols import Enclosure
from foilstudy.measure.air.surface import WettedSurface
from foilstudy.measure.dynamics.structure import Structure
from foilstudy.measure.stiffness import Rings


@dataclass(frozen=True)
class Vacuum:
    """The foil alone."""

    kind: ClassVar[str] = "none"

    @classmethod
    def of(cls, density: float, enclosure: Enclosure) -> Vacuum:
        """Whatever the air would be."""
        return cls()

    def about(self, structure: Structure, surface: WettedSurface, rings: Rings) -> Structure:
        """The structure itself."""
        return structure
