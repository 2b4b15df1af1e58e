"""The numbers of a crumple on which verdicts rest."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from foilstudy.base.outcome import USABLE
from foilstudy.linalg import SolveError
from foilstudy.measure.stiffness import prestressed_stiffness
from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.measure.verdicts import Evidence
from foilstudy.measure.verdicts.evidence import Way, work_over_energy
from foilstudy.measure.verdicts.shape import (
    alternation,
    broad_wave_share,
    calmer_half,
    hidden_energy,
)
from foilstudy.model.patch import knot_points
from foilstudy.model.shell.elements import ELEMENTS
from foilstudy.model.shell.folding import fold_angle
from foilstudy.model.shell.intersection import self_crossing_share
from foilstudy.model.shell.yielding import beyond_yield_share
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.static import stress_free_stiffness
from foilstudy.solve.paths import Arrival


def sensors(shape: Shape) -> dict[str, float]:
    """What is seen in the shape itself, by the names of a study's quantities."""
    surface, patch = knot_points(shape.points), shape.patch
    size = max(patch.size_around, patch.size_along)
    return {
        "fold_angle": fold_angle(surface),
        "beyond_yield_share": beyond_yield_share(shape.stressed, shape.points),
        "self_crossing_share": self_crossing_share(surface),
        "broad_wave_share": broad_wave_share(surface),
        "calmer_half": calmer_half(surface),
        "alternation": alternation((shape.points - shape.reference) / size),
        "hidden_energy": _hidden(shape, size),
    }


def _hidden(shape: Shape, size: float) -> float:
    """NaN of a model that is no element."""
    if shape.element.name not in ELEMENTS:
        return np.nan
    whole = replace(shape, element=ELEMENTS["full"]())
    energies = (each.energies() for each in (shape, whole))
    seen, all_of_it = (each.membrane + each.bending for each in energies)
    return hidden_energy(seen, all_of_it, size, shape.foil.thickness)


def seen_in(shape: Shape, arrival: Arrival | None) -> Evidence:
    """The same without the stiffness, which takes factorisations."""
    return _evidence(shape, arrival, {})


def evidence_of(shape: Shape, arrival: Arrival | None) -> Evidence:
    """Of a shape in memory, with its stiffness on the mesh that it has."""
    if not _is_shape(shape, arrival):
        return seen_in(shape, arrival)
    stiffnesses = {
        "static_stiffness": _stiffness(lambda: stress_free_stiffness(shape)),
        "prestressed_stiffness": _stiffness(
            lambda: prestressed_stiffness(shape.problem(), shape.points)
        ),
    }
    return _evidence(shape, arrival, stiffnesses)


def _is_shape(shape: Shape, arrival: Arrival | None) -> bool:
    left = arrival is None or arrival.status in USABLE
    return left and bool(np.isfinite(shape.points).all())


def _evidence(shape: Shape, arrival: Arrival | None, stiffnesses: dict) -> Evidence:
    if not _is_shape(shape, arrival):
        failed = arrival and arrival.status not in USABLE
        return Evidence(
            arrival.status if failed else "diverged",
            budget_spent=arrival is not None and arrival.budget_spent,
        )
    energies = shape.energies()
    values = {
        **sensors(shape),
        "membrane_energy": energies.membrane,
        "bending_energy": energies.bending,
        **stiffnesses,
    }
    if arrival is None:
        return Evidence.of("converged", values)
    count = arrival.negative_eigenvalues
    values["negative_eigenvalues"] = np.nan if count is None else count
    if arrival.history is not None:
        before, history = shape.before_waiting(), arrival.history
        problem = before.problem()
        paid = problem.value(before.points) + problem.work_spent()
        way = Way(history.step, history.height, history.reaction_force, history.kinetic_energy)
        values["work_over_energy"] = work_over_energy(way, paid)
    return Evidence.of(arrival.status, values)


def _stiffness(measure: Callable[[], np.ndarray]) -> np.ndarray:
    """By direction; NaN where it is not defined."""
    try:
        return measure()
    except SolveError:
        return np.full(len(DIRECTIONS), np.nan)
