"""Air that moves with the foil, and that it encloses."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import scipy.sparse as sparse

from foilstudy.base.ranges import require_number
from foilstudy.base.spec import choice_field
from foilstudy.measure.air.cylinder import cylinder_thickness
from foilstudy.measure.air.enclosures import Vented
from foilstudy.measure.air.protocols import Enclosure
from foilstudy.measure.air.surface import WettedSurface
from foilstudy.measure.air.waves import WAVES, AirOfWaves, Waves
from foilstudy.measure.choices import ENCLOSURES
from foilstudy.measure.dynamics.structure import Structure
from foilstudy.measure.stiffness import InterfaceSystem, Rings


@dataclass(frozen=True)
class AddedMass:
    """Potential flow about the developed foil, a cylinder, driven by the foil's normal motion.

    Attributes
    ----------
    density : float
        Of the air, kg/m3.
    enclosure : Enclosure
    waves : int
        Waves on the foil that are taken one by one, about; see `AirOfWaves`.
    """

    kind: ClassVar[str] = "added_mass"
    density: float = 1.2
    enclosure: Enclosure = choice_field(ENCLOSURES, Vented)
    waves: int = WAVES

    def __post_init__(self):
        require_number("density of the air", self.density, "kg/m3", least=0)

    @classmethod
    def of(cls, density: float, enclosure: Enclosure) -> AddedMass:
        """See `Air`."""
        return cls(density, enclosure)

    def about(self, structure: Structure, surface: WettedSurface, rings: Rings) -> Structure:
        """See `Air`.

        Raises
        ------
        SolveError
            If the stiffness with the enclosed air is singular.
        """
        if self.density > 0:
            structure = replace(structure, mass=self._heavier(structure.mass, surface, rings))
        stiffness = self.enclosure.stiffness(surface.volume)
        if stiffness > 0:
            interior, ends = surface.swept(rings)
            stiffer = structure.stiffness.updated(
                interior[:, None], ends[:, None], np.array([stiffness])
            )
            structure = Structure.assembled(stiffer, structure.mass, structure.rigid_motions)
        return structure

    def thickness(self, waves: Waves, surface: WettedSurface) -> np.ndarray:
        """Of the air that moves with waves of the foil, for means over elements, (r, r), m."""
        return cylinder_thickness(waves)

    def _heavier(
        self, mass: InterfaceSystem, surface: WettedSurface, rings: Rings
    ) -> InterfaceSystem:
        waves = Waves.on(surface.wall, self.waves)
        air = AirOfWaves.of(waves, self.thickness(waves, surface))
        flux = surface.flux
        area = surface.wall.area / flux.shape[0]
        local = (self.density * air.local / area) * (flux.T @ flux)
        swept = flux.T @ air.shapes
        return (mass + InterfaceSystem.split(sparse.csr_matrix(local), rings)).updated(
            swept[rings.interior],
            rings.motion.T @ swept[rings.boundary],
            self.density * air.weights,
        )
