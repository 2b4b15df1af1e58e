"""Stiffness of a given crumpled shape, on its own mesh against exactly refined ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.linalg import SolveError
from foilstudy.measure.stiffness import InterfaceSystem, Rings, condense, fixed_stiffness
from foilstudy.model.patch import Patch, refine
from foilstudy.model.shell.shell import Shell
from foilstudy.study.elements.scene import COARSE, DIAMETER, REFERENCE_HEIGHT, crumple
from foilstudy.study.elements.variants import DEFAULT, VARIANTS, Variant
from foilstudy.study.verification.frequencies import FOIL

THICKNESSES = (50e-6, 250e-6, 500e-6, 1000e-6)
"""m; on 5 mm elements t/h = 0.01 to 0.2."""
_REFEREES = (DEFAULT, "staggered_0")
_REFINEMENTS = 2


@dataclass(frozen=True)
class FrozenShape:
    """A crumple and its stiffness on refined meshes.

    Attributes
    ----------
    thickness : float
        m.
    points : ndarray, shape (3, rows, columns)
        Control points on the 5 mm mesh, m.
    referees : ndarray, shape (2 elements, 2 directions)
        Axial and radial stiffness on the 1.25 mm mesh by the default and the staggered element,
        which sample strains at different places, N/m.
    """

    thickness: float
    points: np.ndarray
    referees: np.ndarray

    @property
    def stiffness(self) -> np.ndarray:
        """Mean of both elements on the finest mesh: axial and radial, N/m."""
        return self.referees.mean(axis=0)


def frozen_shape(thickness: float) -> FrozenShape:
    """Crumple with the default element, refine the shape twice, and measure it.

    Raises
    ------
    SolveError
        If the crumple diverges or a refined stiffness cannot be condensed.
    """
    sheet, result = crumple(VARIANTS[DEFAULT].element, COARSE, thickness, seed=0)
    if result.status == "diverged":
        raise SolveError(f"the crumple whose stiffness is compared failed: {result.message}")
    patch, points = sheet.patch, result.points
    for _ in range(_REFINEMENTS):
        patch, points = patch.refined(), refine(points)
    referees = [stiffness_of(VARIANTS[name], patch, points, thickness) for name in _REFEREES]
    return FrozenShape(thickness, result.points, np.array(referees))


def stiffness_of(
    variant: Variant, patch: Patch, points: np.ndarray, thickness: float
) -> np.ndarray:
    """Axial and radial stiffness of a shape taken as stress-free, N/m."""
    sheet = Shell.elastic(patch, points, FOIL, thickness, variant.element)
    system = InterfaceSystem.split(sheet.tangent(), Rings.of(patch, points))
    return fixed_stiffness(condense(system).stiffness)


def frozen_errors(variant: Variant, shape: FrozenShape) -> tuple[float, float]:
    """Relative error of the axial and radial stiffness on 5 mm; NaN where it is singular."""
    patch = Patch.for_cylinder(DIAMETER, REFERENCE_HEIGHT, COARSE)
    try:
        ours = stiffness_of(variant, patch, shape.points, shape.thickness)
    except SolveError:
        return np.nan, np.nan
    axial, radial = ours / shape.stiffness - 1
    return float(axial), float(radial)
