"""The job that relaxes a crumpled realisation again on refined meshes."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from foilstudy.base.costs import measured
from foilstudy.base.outcome import USABLE
from foilstudy.base.record import write_record
from foilstudy.base.spec import dumped
from foilstudy.config import RefineTask
from foilstudy.config.foils import foil_of
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.study.sweep.origins import read_crumple, refined_origin
from foilstudy.study.sweep.outcome import Outcome, outcome_of
from foilstudy.study.sweep.quantities import quantities


def refine_job(task: RefineTask, crumple_path: Path, path: Path) -> None:
    """Refine the crumple in `crumple_path`, let it settle level by level and write `path`.

    Whatever happens is a record: its ``status`` and ``message`` are those of this relaxation, and
    say nothing against the crumple it began with.

    Raises
    ------
    Refusal
        If the record of the crumple is unreadable or another's: no outcome of this realisation.
    """
    recorded, attributes = read_crumple(crumple_path, task)
    origin = refined_origin(task, attributes)  # before the work: the code may be edited meanwhile
    outcome = Outcome(attributes["status"], attributes["message"])
    with measured() as cost:
        if outcome.status in USABLE:
            outcome = outcome_of(
                lambda: _relaxed(Crumpled.of_record(recorded, attributes), task.refinements)
            )
    values = outcome.values | ({"seconds_refined": cost.seconds} if outcome.values else {})
    described = {
        "status": outcome.status,
        "message": outcome.message,
        "foil": dumped(foil_of(task)),
    }
    write_record(path, quantities(values), described, origin)
    print(f"{outcome.status}: {outcome.message}")


def _relaxed(crumpled: Crumpled, refinements: int) -> Outcome:
    """On the finest mesh, without values where a level did not settle."""
    coarser = crumpled.prestressed_stiffness()
    for level in range(refinements):
        crumpled = crumpled.refined().settled()
        if crumpled.status != "converged":
            return Outcome(crumpled.status, f"refinement {level + 1}: {crumpled.message}")
        prestressed = crumpled.prestressed_stiffness()
        step, coarser = np.abs(prestressed - coarser), prestressed
    arrival = crumpled.arrival
    values = {
        "prestressed_stiffness_converged": prestressed,
        "prestressed_stiffness_mesh_error": step,
        "refined_static_stiffness": crumpled.stiffness(),
        "refined_strain_energy": crumpled.problem().value(crumpled.points),
        "refined_element_size": max(crumpled.patch.size_around, crumpled.patch.size_along),
        "refined_residual": arrival.residual,
        "refined_negative_eigenvalues": float(arrival.negative_eigenvalues),
        "refined_steps": float(arrival.steps),
    }
    return Outcome(crumpled.status, crumpled.message, values)
