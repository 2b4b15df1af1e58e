"""The uncrumpled cylinder, an upper bound of every crumpled stiffness."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from foilstudy.base.record import write_record
from foilstudy.config import Cell, StudyConfig
from foilstudy.config.foils import ideal_foil_of, patch_of
from foilstudy.linalg import SolveError
from foilstudy.model.patch import cylinder_control_points
from foilstudy.model.shell.elements.one_point import OnePoint
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.static import stress_free_stiffness
from foilstudy.study.sweep.origins import cylinder_origin
from foilstudy.study.sweep.quantities import quantities


def cylinder_bounds(study: StudyConfig, path: Path) -> None:
    """Axial and radial stiffness of the perfect cylinder per thickness and reference height.

    Writes `path` with ``cylinder_stiffness`` of shape (thickness, overlength, direction), N/m.
    """
    origin = cylinder_origin(study)  # before the work, as the code may be edited meanwhile
    first = [cell for cell in study.cells() if cell.seed == study.seeds[0]]
    bounds = np.array([_bound(study, cell) for cell in first])
    shape = len(study.thicknesses_um), len(study.reference_heights_mm), 2
    write_record(
        path,
        quantities({"cylinder_stiffness": bounds.reshape(shape)}),
        {},
        origin,
    )


def _bound(study: StudyConfig, cell: Cell) -> np.ndarray:
    task = study.crumple_task(cell)
    foil, patch = ideal_foil_of(task), patch_of(task)
    points = cylinder_control_points(patch, foil.diameter)
    # the element that is most accurate where nothing folds
    cylinder = Shape(foil, patch, points, points, OnePoint())
    try:
        return stress_free_stiffness(cylinder)
    except SolveError as error:  # a missing bound is no reason to lose a study
        print(f"no bound for {foil}: {error}")
        return np.full(2, np.nan)
