"""Crumple one case of the convergence study and measure it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from foilstudy.base.costs import Cost
from foilstudy.base.costs import measured as measured_cost
from foilstudy.base.outcome import USABLE
from foilstudy.linalg import SolveError
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.equilibrium.settle import SettleOptions
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.study.published import CrumpleCase, foil

RAMP_STEPS = 2000
STEPS_MAX = 100_000
METHOD = Method(RelaxationPath(RAMP_STEPS, settling=SettleOptions(relaxation_steps_max=STEPS_MAX)))
_AMPLITUDE, _CORRELATION = 10e-6, 10e-3
"""Of the imperfection, m: smooth enough for the coarsest mesh, so that all meshes have the same."""
_REFINED_SIZE_MIN = 1.2e-3
_REFINEMENTS_MAX = 2
"""How far a crumpled shape is refined for the mesh limit of its stiffness; size in m."""


def recipe(case: CrumpleCase) -> tuple[Foil, Mesh, Imperfection, Method]:
    """What `crumple` needs for a case: the published foil, the same imperfection on every mesh."""
    imperfection = Imperfection("smoothed", _AMPLITUDE, _CORRELATION, case.seed)
    mesh = Mesh(case.size_mm * 1e-3, case.element)
    return foil(case.thickness_um, case.height_mm), mesh, imperfection, METHOD


def imperfect(case: CrumpleCase) -> Crumpled:
    """The uncrumpled foil of a case."""
    return uncrumpled(*recipe(case))


def settled(case: CrumpleCase) -> tuple[Crumpled, dict]:
    """Crumple a case to a stable equilibrium; the shape and how it was reached."""
    crumpled = crumple(*recipe(case))
    return crumpled, _reached(crumpled, RAMP_STEPS)


def settled_on(crumpled: Crumpled) -> tuple[Crumpled, dict]:
    """Let a refined crumple settle on its mesh."""
    crumpled = crumpled.settled()
    return crumpled, _reached(crumpled, 0)


def _reached(crumpled: Crumpled, ramp_steps: int) -> dict:
    arrival = crumpled.arrival
    costs = {f"seconds_{stage}": cost.seconds for stage, cost in arrival.costs.items()}
    costs |= {f"cpu_seconds_{stage}": cost.cpu_seconds for stage, cost in arrival.costs.items()}
    return costs | {
        "ramp_steps": ramp_steps,
        "status": arrival.status,
        "message": arrival.message,
        "residual": arrival.residual,
        "steps": arrival.steps - ramp_steps,
        "negative_eigenvalues": arrival.negative_eigenvalues,
        "hessians": arrival.hessians,
    }


def measured(crumpled: Crumpled) -> dict:
    """Energies (J) and stiffness (N/m; axial, radial) of a crumple."""
    energies, patch = crumpled.energies(), crumpled.patch
    numbers = {
        "size_mm": 1e3 * float(np.sqrt(patch.size_around * patch.size_along)),
        "elements": patch.elements_around * patch.elements_along,
        "membrane_energy": energies.membrane,
        "bending_energy": energies.bending,
        "stabilisation_energy": energies.stabilisation,
        "strain_energy": energies.total,
    }
    with _timed(numbers, "static") as cost:
        plain = crumpled.stiffness()
    numbers |= {"static_stiffness": plain.tolist(), "peak_memory_mb": cost.peak_memory_mb}
    with _timed(numbers, "refined"):
        limit = crumpled.mesh_limit(_refinements(crumpled), plain)
    numbers |= {
        "static_limit": limit.stiffness.tolist(),
        "static_limit_error": limit.error.tolist(),
    }
    return numbers | {"prestressed_stiffness": prestressed(crumpled).tolist()}


def prestressed(crumpled: Crumpled) -> np.ndarray:
    """Axial and radial stiffness with the stress left in, N/m; NaN where it is singular."""
    try:
        return crumpled.prestressed_stiffness()
    except SolveError as error:
        print(f"no pre-stressed stiffness: {error}")
        return np.full(2, np.nan)


def _refinements(crumpled: Crumpled) -> int:
    """How often a shape is refined for its mesh limit.

    Not at all on the finest mesh, nor for other elements than the default one: they stand here for
    published results, which have no limit.
    """
    if crumpled.element != Corner():
        return 0
    halvings = int(np.log2(crumpled.patch.size_along / _REFINED_SIZE_MIN))
    return max(0, min(halvings, _REFINEMENTS_MAX))


def run(case: CrumpleCase) -> dict:
    """Crumple and measure a case; every number of it."""
    return _with_measures(*settled(case))


def _with_measures(crumpled: Crumpled, numbers: dict) -> dict:
    """How a crumple was reached, and what is measured of it if it has a shape."""
    return numbers | (measured(crumpled) if numbers["status"] in USABLE else {})


def run_levels(case: CrumpleCase) -> list[dict]:
    """Crumple a case, then refine and relax it again to the finest size."""
    crumpled, numbers = settled(case)
    levels = [_with_measures(crumpled, numbers)]
    while numbers["status"] == "converged" and crumpled.patch.size_along / 2 >= _REFINED_SIZE_MIN:
        crumpled, numbers = settled_on(crumpled.refined())
        levels.append(_with_measures(crumpled, numbers))
    return [{"level": k} | level for k, level in enumerate(levels)]


@contextmanager
def _timed(numbers: dict, what: str) -> Iterator[Cost]:
    """Record the seconds on the clock and those of the processor, which a full machine spares."""
    with measured_cost() as cost:
        yield cost
    numbers[f"seconds_{what}"], numbers[f"cpu_seconds_{what}"] = cost.seconds, cost.cpu_seconds
