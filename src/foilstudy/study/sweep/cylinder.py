"""The uncrumpled cylinder, an upper bound of every crumpled stiffness."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from foilstudy.base.record import Quantity, write_record
from foilstudy.config import StudyConfig
from foilstudy.config.foils import material_of
from foilstudy.linalg import SolveError
from foilstudy.measure.stiffness import InterfaceSystem, Rings, condense, fixed_stiffness
from foilstudy.model.patch import Patch, cylinder_control_points
from foilstudy.model.shell.elements.one_point import OnePoint
from foilstudy.model.shell.shell import Shell


def cylinder_bounds(study: StudyConfig, path: Path) -> None:
    """Axial and radial stiffness of the perfect cylinder per thickness and reference height.

    Writes `path` with ``cylinder_stiffness`` of shape (thickness, overlength, direction), N/m.
    """
    element = OnePoint()  # most accurate where nothing folds
    diameter, material = study.sheet.diameter_mm * 1e-3, material_of(study.material)
    bounds = np.empty((len(study.thicknesses_um), len(study.reference_heights_mm), 2))
    for i, thickness_um in enumerate(study.thicknesses_um):
        size = study.mesh_of(thickness_um).element_size_mm * 1e-3
        for j, height_mm in enumerate(study.reference_heights_mm):
            patch = Patch.for_cylinder(diameter, height_mm * 1e-3, size)
            points = cylinder_control_points(patch, diameter)
            sheet = Shell.elastic(patch, points, material, thickness_um * 1e-6, element)
            system = InterfaceSystem.split(sheet.tangent(), Rings.of(patch, points))
            try:
                bounds[i, j] = fixed_stiffness(condense(system).stiffness)
            except SolveError as error:  # a missing bound is no reason to lose a study
                print(f"no bound at {thickness_um:g} um, {height_mm:g} mm: {error}")
                bounds[i, j] = np.nan
    dims = ("thickness", "overlength", "direction")
    quantity = Quantity(bounds, "N/m", "static stiffness of the uncrumpled cylinder", dims)
    write_record(path, {"cylinder_stiffness": quantity}, {})
