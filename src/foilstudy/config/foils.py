"""From a configuration (millimetres, micrometres) to foil and patch (SI); loads nothing heavy."""

from __future__ import annotations

from foilstudy.config.sections import Material as MaterialSection
from foilstudy.config.tasks import CrumpleTask, RefineTask, ResponseTask
from foilstudy.model.foil import Foil
from foilstudy.model.materials import Material
from foilstudy.model.patch import Patch


def material_of(section: MaterialSection) -> Material:
    """SI material."""
    return Material(
        youngs_modulus=section.youngs_modulus_mpa * 1e6,
        poisson_ratio=section.poisson_ratio,
        density=section.density_kg_m3,
        yield_stress=section.yield_stress_mpa * 1e6,
        name=section.name,
        law=section.law,
        hardening=None if section.hardening_mpa is None else section.hardening_mpa * 1e6,
        relaxation_per_decade=section.relaxation_per_decade,
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


def patch_of(task: CrumpleTask) -> Patch:
    """The patch on which a task is crumpled."""
    foil, size = foil_of(task), task.mesh.element_size_mm * 1e-3
    return Patch.for_cylinder(
        foil.diameter, foil.reference_height, size, task.mesh.ramp_coarsenings
    )
