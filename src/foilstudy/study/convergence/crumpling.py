"""Crumple one case of the convergence study and measure it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

from foilstudy.base.costs import measured as measured_cost
from foilstudy.base.costs import peak_memory_mb
from foilstudy.config.scene import material_of
from foilstudy.linalg import SolveError
from foilstudy.measure.stiffness import (
    InterfaceSystem,
    Rings,
    condense,
    fixed_stiffness,
    mesh_limit,
    prestressed_stiffness,
)
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.imperfection import imperfect_cylinder
from foilstudy.model.materials import MATERIALS
from foilstudy.model.patch import Patch, cylinder_control_points
from foilstudy.model.shell.elements import ELEMENTS
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.model.shell.elements.sampled import STAGGERED
from foilstudy.model.shell.shell import Shell
from foilstudy.pipeline.crumpled import Crumple
from foilstudy.pipeline.scheme import crumpling_scheme
from foilstudy.solve.equilibrium.settle import SettleOptions, settle
from foilstudy.solve.relaxation import Ramp, StoppingRule, relax
from foilstudy.study.convergence.plan import DIAMETER_MM, GAP_HEIGHT_MM, Case

RAMP_STEPS = 2000
STEPS_MAX = 100_000
_AMPLITUDE, _CORRELATION = 10e-6, 10e-3
"""Of the imperfection, m: smooth enough for the coarsest mesh, so that all meshes have the same."""
_REFINED_SIZE_MIN = 1.2e-3
_REFINEMENTS_MAX = 2
"""How far a crumpled shape is refined for the mesh limit of its stiffness; size in m."""


def foil_of(case: Case) -> Foil:
    """The foil of a case: the published FEP."""
    material = material_of(MATERIALS["FEP"])
    return Foil(
        DIAMETER_MM * 1e-3, case.height_mm * 1e-3, GAP_HEIGHT_MM * 1e-3, case.thickness_um * 1e-6,
        material,
    )  # fmt: skip


def imperfect(case: Case) -> Crumple:
    """The uncrumpled foil of a case, its imperfection the same field on every mesh."""
    foil = foil_of(case)
    patch = Patch.for_cylinder(foil.diameter, foil.reference_height, case.size_mm * 1e-3)
    stream = (case.seed, 1000 * case.thickness_um, 1000 * case.height_mm)
    imperfection = Imperfection("smoothed", _AMPLITUDE, _CORRELATION, stream)
    perfect = cylinder_control_points(patch, foil.diameter)
    reference = imperfect_cylinder(patch, perfect, foil, imperfection)
    return Crumple(foil, patch, reference, reference, ELEMENTS[case.element]())


def settled(case: Case) -> tuple[Crumple, dict]:
    """Crumple a case to a stable equilibrium; the shape and how it was reached."""
    crumple = imperfect(case)
    foil, sheet = crumple.foil, crumple.sheet(crumple.reference)
    scheme, options = crumpling_scheme(sheet), SettleOptions(relaxation_steps_max=STEPS_MAX)
    ramp = Ramp(foil.reference_height - foil.gap_height, RAMP_STEPS)
    numbers: dict = {"ramp_steps": RAMP_STEPS}
    with _timed(numbers, "relaxing"):
        rule = StoppingRule(options.switch_residual, np.inf, STEPS_MAX)
        relaxed = relax(sheet, scheme, ramp, rule)
    numbers |= {"status": relaxed.status, "message": relaxed.message, "residual": relaxed.residual}
    numbers |= {"steps": relaxed.steps - RAMP_STEPS, "negative_eigenvalues": None, "hessians": 0}
    points = relaxed.points
    if relaxed.status != "diverged":
        points = _settle(sheet, scheme, points, options, numbers)
    return replace(crumple, points=points), numbers


def settled_on(crumple: Crumple) -> tuple[Crumple, dict]:
    """Let a refined crumple settle on its mesh."""
    sheet = crumple.sheet(crumple.reference)
    numbers: dict = {"ramp_steps": 0, "steps": 0, "hessians": 0}
    options = SettleOptions(relaxation_steps_max=STEPS_MAX)
    points = _settle(sheet, crumpling_scheme(sheet), crumple.points, options, numbers)
    return replace(crumple, points=points), numbers


def _settle(
    sheet: Shell, scheme, points: np.ndarray, options: SettleOptions, numbers: dict
) -> np.ndarray:
    with _timed(numbers, "settling"):
        result = settle(sheet, scheme, points, options)
    numbers |= {
        "status": result.status,
        "message": result.message,
        "residual": result.residual,
        "steps": numbers["steps"] + result.relaxation_steps,
        "negative_eigenvalues": result.negative_eigenvalues,
        "hessians": result.hessians,
    }
    return result.points


def measured(crumple: Crumple) -> dict:
    """Energies (J) and stiffness (N/m; axial, radial) of a crumple."""
    sheet = crumple.sheet(crumple.reference)
    energies = sheet.energies(crumple.points)
    numbers = {
        "size_mm": 1e3 * float(np.sqrt(crumple.patch.size_around * crumple.patch.size_along)),
        "elements": crumple.patch.elements_around * crumple.patch.elements_along,
        "membrane_energy": energies.membrane,
        "bending_energy": energies.bending,
        "stabilisation_energy": energies.stabilisation,
        "strain_energy": energies.total,
    }
    with _timed(numbers, "static"):
        plain = stress_free(crumple)
    numbers["static_stiffness"] = plain.tolist()
    numbers["peak_memory_mb"] = peak_memory_mb()
    with _timed(numbers, "refined"):
        limit, error = _limit(crumple, plain)
    numbers |= {"static_limit": limit.tolist(), "static_limit_error": error.tolist()}
    return numbers | {"prestressed_stiffness": _prestressed(sheet, crumple.points).tolist()}


def stress_free(crumple: Crumple) -> np.ndarray:
    """Axial and radial stiffness with the crumpled shape free of stress, N/m."""
    rings = Rings.of(crumple.patch, crumple.points)
    system = InterfaceSystem.split(crumple.sheet(crumple.points).tangent(), rings)
    return fixed_stiffness(condense(system).stiffness)


def _prestressed(sheet: Shell, points: np.ndarray) -> np.ndarray:
    try:
        return prestressed_stiffness(sheet, points)
    except SolveError as error:
        print(f"no pre-stressed stiffness: {error}")
        return np.full(2, np.nan)


def _limit(crumple: Crumple, plain: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness of the same shape at element size zero and its error.

    NaN on the finest mesh, and for other elements than the default one: they stand here for
    published results, which have no limit.
    """
    levels, fine, staggered = [plain], crumple, np.full(2, np.nan)
    if crumple.element != Corner():
        return staggered, staggered
    size = crumple.patch.size_along
    while size / 2 >= _REFINED_SIZE_MIN and len(levels) <= _REFINEMENTS_MAX:
        fine, size = fine.refined(), size / 2
        levels.append(stress_free(fine))
        if len(levels) == 2:
            staggered = stress_free(replace(fine, element=STAGGERED))
    if len(levels) == 1:
        return staggered, staggered
    return mesh_limit(levels, staggered)


def run(case: Case) -> dict:
    """Crumple and measure a case; every number of it."""
    crumple, numbers = settled(case)
    if numbers["status"] != "diverged":
        numbers |= measured(crumple)
    return numbers


def run_levels(case: Case) -> list[dict]:
    """Crumple a case, then refine and relax it again to the finest size."""
    crumple, numbers = settled(case)
    levels = [numbers | measured(crumple)]
    while numbers["status"] == "converged" and crumple.patch.size_along / 2 >= _REFINED_SIZE_MIN:
        crumple, numbers = settled_on(crumple.refined())
        levels.append(numbers | measured(crumple))
    return [{"level": k} | level for k, level in enumerate(levels)]


@contextmanager
def _timed(numbers: dict, what: str) -> Iterator[None]:
    """Record the seconds on the clock and those of the processor, which a full machine spares."""
    with measured_cost() as cost:
        yield
    numbers[f"seconds_{what}"], numbers[f"cpu_seconds_{what}"] = cost.seconds, cost.cpu_seconds
