"""From a configuration (millimetres, micrometres) to foil and patch (SI); loads nothing heavy."""

from __future__ import annotations

from dataclasses import replace
from random import Random

from foilstudy.config.sections import Material as MaterialSection
from foilstudy.config.specimen import Specimen as SpecimenSection
from foilstudy.config.specimen import clamps_of
from foilstudy.config.tasks import CrumpleTask, RefineTask, ResponseTask
from foilstudy.model.foil import Foil
from foilstudy.model.materials import Material
from foilstudy.model.patch import Patch
from foilstudy.model.specimen import Seam, Specimen, Unevenness


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


def ideal_foil_of(task: CrumpleTask | RefineTask | ResponseTask) -> Foil:
    """The foil a task is about, were it ideal."""
    return Foil(
        diameter=task.sheet.diameter_mm * 1e-3,
        reference_height=task.reference_height_mm * 1e-3,
        gap_height=task.sheet.gap_height_mm * 1e-3,
        thickness=task.thickness_um * 1e-6,
        material=material_of(task.material),
    )


def foil_of(task: CrumpleTask | RefineTask | ResponseTask) -> Foil:
    """The foil a task is about, with all in which its specimen departs from an ideal one."""
    ideal = ideal_foil_of(task)
    specimen = specimen_of(task.specimen, task.seed)
    return replace(ideal, material=_drawn(ideal.material, task), specimen=specimen)


def specimen_of(section: SpecimenSection, seed: int) -> Specimen:
    """SI specimen of a realisation."""
    return Specimen(
        seam=Seam(
            section.seam_width_mm * 1e-3,
            section.seam_thickness_factor,
            section.seam_modulus_factor,
        ),
        unevenness=Unevenness(
            section.thickness_deviation_percent / 100,
            section.thickness_correlation_mm * 1e-3,
            seed,
        ),
        clamps=clamps_of(section),
        gravity=section.gravity_m_s2,
    )


def _drawn(material: Material, task: CrumpleTask | RefineTask | ResponseTask) -> Material:
    """With the constants that are drawn for the realisation, each from its own stream."""
    section = task.specimen
    ranges = {
        "youngs_modulus": section.youngs_modulus_range_mpa,
        "yield_stress": section.yield_stress_range_mpa,
    }
    values = {
        name: 1e6
        * Random(f"{name} {task.thickness_um} {task.reference_height_mm} {task.seed}").uniform(
            *between
        )
        for name, between in ranges.items()
        if between is not None
    }
    return replace(material, **values)


def patch_of(task: CrumpleTask) -> Patch:
    """The patch on which a task is crumpled."""
    foil, size = foil_of(task), task.mesh.element_size_mm * 1e-3
    return Patch.for_cylinder(
        foil.diameter, foil.reference_height, size, task.mesh.ramp_coarsenings
    )
