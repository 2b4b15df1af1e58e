"""From a task (millimetres, micrometres) to the scene (SI)."""

from __future__ import annotations

from foilstudy.config import CrumpleTask, RefineTask, ResponseTask
from foilstudy.model.foil import Foil, Imperfection, Material
from foilstudy.model.patch import Patch


def material_of(section) -> Material:
    """SI material from the `material` section of a configuration."""
    return Material(
        youngs_modulus=section.youngs_modulus_mpa * 1e6,
        poisson_ratio=section.poisson_ratio,
        density=section.density_kg_m3,
        yield_stress=section.yield_stress_mpa * 1e6,
    )


def foil_of(task: CrumpleTask | RefineTask | ResponseTask) -> Foil:
    """The foil a task is about."""
    return Foil(
        diameter=task.sheet.diameter_mm * 1e-3,
        reference_height=task.reference_height_mm * 1e-3,
        gap_height=task.sheet.gap_height_mm * 1e-3,
        thickness=task.thickness_um * 1e-6,
        material=material_of(task.material),
    )


def imperfection_of(task: CrumpleTask) -> Imperfection:
    """The imperfection of a task.

    Its random stream is a function of thickness, height and seed alone, so that a configuration
    keeps its realisations when the sweep around it changes.
    """
    section = task.imperfection
    return Imperfection(
        kind=section.kind,
        amplitude=section.amplitude_um * 1e-6,
        correlation_length=(section.correlation_length_mm or 0.0) * 1e-3,
        stream=(task.seed, round(task.thickness_um * 1e3), round(task.reference_height_mm * 1e3)),
    )


def patch_of(task: CrumpleTask) -> Patch:
    """The patch on which a task is crumpled."""
    foil = foil_of(task)
    return Patch.for_cylinder(
        foil.diameter, foil.reference_height, task.mesh.element_size_mm * 1e-3
    )
