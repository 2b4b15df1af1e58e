"""Stiffness of a given crumpled shape, on its own mesh against exactly refined ones."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from foilstudy.linalg import SolveError
from foilstudy.pipeline.method import Mesh
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.static import stress_free_stiffness
from foilstudy.study.elements.plan import DEFAULT, Frozen
from foilstudy.study.elements.scene import COARSE, crumple, foil_of
from foilstudy.study.elements.variants import VARIANTS, Variant

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


def frozen_shape(case: Frozen) -> FrozenShape:
    """Crumple with the default element, refine the shape twice, and measure it.

    Raises
    ------
    SolveError
        If the crumple diverges or a refined stiffness cannot be condensed.
    """
    thickness = case.thickness_um * 1e-6
    shape, result = crumple(VARIANTS[DEFAULT].element, COARSE, thickness, seed=0)
    if result.status == "diverged":
        raise SolveError(f"the crumple whose stiffness is compared failed: {result.message}")
    fine = shape
    for _ in range(_REFINEMENTS):
        fine = fine.refined()
    referees = [
        stress_free_stiffness(replace(fine, element=VARIANTS[name].element)) for name in _REFEREES
    ]
    return FrozenShape(thickness, result.points, np.array(referees))


def frozen_errors(variant: Variant, shape: FrozenShape) -> tuple[float, float]:
    """Relative error of the axial and radial stiffness on 5 mm; NaN where it is singular."""
    foil = foil_of(shape.thickness)
    patch = Mesh(COARSE).patch(foil)
    try:
        ours = stress_free_stiffness(
            Shape(foil, patch, shape.points, shape.points, variant.element)
        )
    except SolveError:
        return np.nan, np.nan
    axial, radial = ours / shape.stiffness - 1
    return float(axial), float(radial)
