"""Stiffness of a given crumpled shape, on its own mesh against exactly refined ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from foilstudy.linalg import SolveError
from foilstudy.pipeline.method import Mesh
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.static import stress_free_stiffness
from foilstudy.study.elements.crumpling import crumple
from foilstudy.study.elements.plan import COARSE_MM, DEFAULT, Frozen
from foilstudy.study.elements.variants import VARIANTS, Variant
from foilstudy.study.published import foil

_REFEREES = (DEFAULT, "staggered_0")
_REFINEMENTS = 2


def frozen_shape(case: Frozen) -> dict[str, np.ndarray]:
    """Crumple with the default element, refine the shape twice, and measure it.

    Returns
    -------
    dict
        ``points``, control points on the 5 mm mesh, shape (3, rows, columns), m; ``referees``,
        shape (2 elements, 2 directions), axial and radial stiffness on the 1.25 mm mesh by the
        default and the staggered element, which sample strains at different places, N/m.

    Raises
    ------
    SolveError
        If the crumple diverges or a refined stiffness cannot be condensed.
    """
    shape, result = crumple(VARIANTS[DEFAULT].element, COARSE_MM, case.thickness_um, seed=0)
    if result.status == "diverged":
        raise SolveError(f"the crumple whose stiffness is compared failed: {result.message}")
    fine = shape
    for _ in range(_REFINEMENTS):
        fine = fine.refined()
    referees = [
        stress_free_stiffness(replace(fine, element=VARIANTS[name].element)) for name in _REFEREES
    ]
    return {"points": result.points, "referees": np.array(referees)}


def frozen_errors(variant: Variant, case: Frozen, frozen: dict) -> tuple[float, float]:
    """Relative error of the axial and radial stiffness on 5 mm; NaN where it is singular.

    Parameters
    ----------
    frozen : dict
        What `frozen_shape` has returned; the mean of both referees counts as exact.
    """
    sheet, points = foil(case.thickness_um), frozen["points"]
    patch = Mesh(COARSE_MM * 1e-3).patch(sheet)
    try:
        ours = stress_free_stiffness(Shape(sheet, patch, points, points, variant.element))
    except SolveError:
        return np.nan, np.nan
    axial, radial = ours / np.array(frozen["referees"], float).mean(axis=0) - 1
    return float(axial), float(radial)
