"""From a configuration to mesh, imperfection, method and dynamics (SI)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from foilstudy.config.air import Air as AirSection
from foilstudy.config.contact import Contact as ContactSection
from foilstudy.config.installation import moves_of
from foilstudy.config.mesh import Mesh as MeshSection
from foilstudy.config.sections import Dynamics
from foilstudy.config.tasks import CrumpleTask
from foilstudy.measure.air.protocols import Air
from foilstudy.measure.choices import AIRS, ENCLOSURES, STRESS_REMOVALS, STRUCTURAL_DAMPINGS
from foilstudy.measure.dynamics import DynamicsOptions
from foilstudy.model.contact import CONTACTS, Contact
from foilstudy.model.foil import Imperfection
from foilstudy.pipeline.crumpled import Recipe
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.choices import PATHS
from foilstudy.solve.equilibrium.settle import SettleOptions
from foilstudy.solve.relaxation.scheme import Scheme


def recipe_of(task: CrumpleTask) -> Recipe:
    """Mesh, imperfection and method of a task."""
    section = task.imperfection
    imperfection = Imperfection(
        kind=section.kind,
        amplitude=section.amplitude_um * 1e-6,
        correlation_length=(section.correlation_length_mm or 0.0) * 1e-3,
        seed=task.seed,
        removed=section.removal == "after_buckling",
    )
    return Recipe(mesh_of(task.mesh), imperfection, method_of(task))


def mesh_of(section: MeshSection) -> Mesh:
    """The mesh, its element size a number already."""
    return Mesh(section.element_size_mm * 1e-3, section.element, section.ramp_coarsenings)


def method_of(task: CrumpleTask) -> Method:
    """How the foil of a task is crumpled."""
    method, relaxation = task.method, task.relaxation
    settling = SettleOptions(
        residual_tolerance=relaxation.residual_tolerance,
        switch_residual=relaxation.switch_residual,
        relaxation_steps_max=relaxation.relaxation_steps_max,
        search=method.search,
    )
    path = PATHS[method.path].for_study(
        relaxation.ramp_steps,
        Scheme.named(method.mass, method.damping),
        settling,
        relaxation.check_interval,
    )
    if task.installation.moves:
        path = replace(path, moves=moves_of(task.installation))
    return Method(
        path,
        STRESS_REMOVALS[method.stress_removal](),
        contact_of(task.contact),
        3600 * task.installation.waiting_hours,
    )


def air_of(section: AirSection) -> Air:
    """What surrounds the foil in its dynamics."""
    enclosure = ENCLOSURES[section.enclosed].under(section.pressure_kpa * 1e3)
    return AIRS[section.kind].of(section.density_kg_m3, enclosure)


def contact_of(section: ContactSection) -> Contact:
    """What parts of the foil do that come near each other."""
    if section.kind == "none":
        return CONTACTS[section.kind]()
    given: dict[str, Any] = {"ring_planes": section.ring_planes, "friction": section.friction}
    if section.reach_mm is not None:
        given["reach"] = section.reach_mm * 1e-3
    if section.stiffness is not None:
        given["stiffness"] = section.stiffness
    return CONTACTS[section.kind](**given)


def dynamics_of(section: Dynamics) -> DynamicsOptions:
    """What is asked of the dynamics."""
    damping = STRUCTURAL_DAMPINGS[section.damping]
    return DynamicsOptions(
        reduction=section.reduction,
        tolerance=section.tolerance,
        cutoff_hz=section.cutoff_hz,
        lowest_hz=section.shown_min_hz,
        highest_hz=section.shown_max_hz,
        frequencies=section.frequencies,
        damping=damping.of_share(section.damping_percent / 100, section.rayleigh_hz),
        eigenfrequencies=section.eigenfrequencies,
        mode_shapes=section.mode_shapes,
    )
