"""The job that crumples one realisation and records the shape."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from foilstudy.base.costs import measured
from foilstudy.base.outcome import USABLE
from foilstudy.base.record import write_record
from foilstudy.config import CrumpleTask
from foilstudy.config.foils import foil_of
from foilstudy.config.scene import recipe_of
from foilstudy.measure.localisation import localisation, shortening_profile
from foilstudy.model.materials import Material
from foilstudy.model.patch import RING_ROWS, knot_points
from foilstudy.pipeline.crumpled import Crumpled, described
from foilstudy.pipeline.evidence import sensors
from foilstudy.pipeline.retry import attempted
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import History
from foilstudy.study.sweep.origins import crumple_origin
from foilstudy.study.sweep.outcome import Outcome, Values, outcome_of
from foilstudy.study.sweep.quantities import quantities


def crumple_job(task: CrumpleTask, path: Path) -> None:
    """Crumple the foil of a task and write `path`, whatever happens.

    A realisation that diverges, or whose computation fails, becomes a record whose ``status``
    and ``message`` say so.
    """
    origin = crumple_origin(task)  # before the work, as the code may be edited meanwhile
    foil, recipe = foil_of(task), recipe_of(task)
    attributes = {
        "thickness_um": task.thickness_um,
        "reference_height_mm": task.reference_height_mm,
        "overlength_percent": task.overlength_percent,
        "seed": task.seed,
        "element": task.mesh.element,
    } | described(foil, recipe)

    def work() -> Outcome:
        attempts = attempted(foil, recipe, task.method.retries)
        crumpled = attempts.crumpled
        values = values_of(crumpled)
        if task.specimen.draws:
            values |= _drawn(foil.material)
        if task.method.retries:
            values["attempt"] = float(attempts.number)
        return Outcome(crumpled.status, attempts.message, values, described(foil, crumpled.recipe))

    with measured() as cost:
        outcome = outcome_of(work)
    values = outcome.values | {"seconds_crumple": cost.seconds}
    attributes |= {"status": outcome.status, "message": outcome.message} | outcome.attributes
    write_record(path, quantities(values), attributes, origin)
    print(f"{outcome.status}: {outcome.message} ({cost.seconds:.1f} s)")


def _drawn(material: Material) -> Values:
    return {"youngs_modulus": material.youngs_modulus, "yield_stress": material.yield_stress}


def values_of(crumpled: Crumpled) -> Values:
    """Everything that is recorded of a crumple, by the names of `QUANTITIES`; SI."""
    arrival = crumpled.arrival
    values: Values = {}
    if arrival.status in USABLE:
        values = _shape(crumpled) | _numbers(crumpled)
    return values | (_history(arrival.history, values) if arrival.history else {})


def _history(history: History, values: dict) -> dict[str, np.ndarray]:
    """Along the way; the equilibrium, where there is one, is the last entry."""
    tables = {
        "step": history.step,
        "height": history.height,
        "reaction_force": history.reaction_force,
        **{f"{name}_energy": column for name, column in history.energies.items()},
        "kinetic_energy": history.kinetic_energy,
        "residual": history.residual,
    }
    if values:
        end = values | {
            "step": int(values["steps"] + values["newton_steps"]),  # all kinds of step count
            "height": history.height[-1],
            "kinetic_energy": 0.0,
            "residual": values["equilibrium_residual"],
        }
        tables = {name: np.append(column, end[name]) for name, column in tables.items()}
    return {f"history_{name}": column for name, column in tables.items()}


def _shape(crumpled: Crumpled) -> dict[str, np.ndarray]:
    surface, reference = knot_points(crumpled.points), knot_points(crumpled.reference)
    return {
        "control_points": crumpled.points,
        "reference_control_points": crumpled.reference,
        "surface": surface,
        "reference_surface": reference,
        "radial_displacement": _radial_displacement(surface, reference),
        "shortening_profile": shortening_profile(crumpled.patch, crumpled.points),
        **crumpled.problem().recorded(),
        **_waiting_shape(crumpled),
    }


def _waiting_shape(crumpled: Crumpled) -> dict[str, np.ndarray]:
    """That in which it has waited, where contacts have moved it since."""
    rest = crumpled.rest
    moved = rest and not np.array_equal(rest.points, crumpled.points)
    return {"waiting_control_points": rest.points} if moved else {}


def _radial_displacement(surface: np.ndarray, reference: np.ndarray) -> np.ndarray:
    return np.hypot(surface[0], surface[1]) - np.hypot(reference[0], reference[1])


def _numbers(crumpled: Crumpled) -> dict[str, float]:
    arrival, points, patch = crumpled.arrival, crumpled.points, crumpled.patch
    problem, force = crumpled.problem(), np.empty_like(points)
    touches = crumpled.method.touches
    energies = zip(problem.energy_names, problem.force(points, force), strict=True)
    surface = knot_points(points)
    radial = _radial_displacement(surface, knot_points(crumpled.reference))
    count = arrival.negative_eigenvalues
    return {
        **{f"{name}_energy": energy for name, energy in energies},
        "reaction_force": -float(force[2, -RING_ROWS:].sum()),
        "equilibrium_residual": arrival.residual,
        "negative_eigenvalues": np.nan if count is None else float(count),
        "steps": float(arrival.steps),
        "newton_steps": float(arrival.newton_steps),
        "hessians": float(arrival.hessians),
        "element_size": max(patch.size_around, patch.size_along),
        "radial_displacement_min": radial.min(),
        "radial_displacement_max": radial.max(),
        "radial_displacement_rms": np.sqrt(np.mean(radial**2)),
        **sensors(crumpled),
        **({"free_height": arrival.free_heights[-1]} if arrival.free_heights else {}),
        **problem.numbers(),
        **_used_up(crumpled, problem),
        **({"stress_kept": crumpled.stress_kept} if crumpled.beyond_elastic else {}),
        **localisation(patch, points),
        **({"contact_shortened_steps": float(arrival.shortened_steps)} if touches else {}),
    }


def _used_up(crumpled: Crumpled, problem: Problem) -> dict[str, float]:
    """Waiting weakens what is left of a foil, but takes back nothing that was used up before."""
    if not problem.has_memory:
        return {}
    before = crumpled.before_waiting().problem() if crumpled.rest else problem
    kept = {name: value for name, value in before.numbers().items() if name == "dissipated_work"}
    return kept | {"work_spent": before.work_spent()}
