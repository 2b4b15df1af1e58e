"""Air that moves with the foil as it is crumpled."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.measure.air.added_mass import AddedMass
from foilstudy.measure.air.panels import panel_thickness
from foilstudy.measure.air.surface import WettedSurface
from foilstudy.measure.air.waves import Waves
from foilstudy.model.patch import knot_points

PANELS_MAX = 6_000
"""With them the dense matrix takes 0.3 GB, twice."""


@dataclass(frozen=True)
class TrueSurface(AddedMass):
    """The same about the crumpled surface between open ends; costs a dense matrix of elements."""

    kind: ClassVar[str] = "added_mass_true_surface"

    def thickness(self, waves: Waves, surface: WettedSurface) -> np.ndarray:
        """See `AddedMass`.

        Raises
        ------
        Refusal
            If there are too many elements.
        SolveError
            If the surface lies too close to itself.
        """
        elements = waves.wall.around * waves.wall.along
        if elements > PANELS_MAX:
            raise Refusal(
                f"the air about the true surface of {elements} elements would need a dense matrix "
                f"of them (at most {PANELS_MAX}); use air.kind: added_mass, or larger elements."
            )
        return panel_thickness(waves, knot_points(surface.points))
