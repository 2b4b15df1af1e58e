"""What a study will cost, before anything of it starts.

Time is a sum of power laws, each with its reason:

- a crumple takes *steps* evaluations of force and mass solve, a little more than proportional to
  the elements as they leave the caches, and one factorisation when it settles;
- the relaxation takes the more steps, the thinner the foil is against its radius; the ramp takes
  the steps it is told to take;
- a static stiffness costs a factorisation, on every mesh of the ladder: twice on the mesh of the
  crumple (stress-free and pre-stressed) and on the first refinement (corner and staggered element);
- a reduction costs a factorisation and the projection on its coordinates, elements times their
  square. They grow with the modes in the band, in number proportional to its end, and with R/t.

Memory is proportional to the elements of the finest mesh that is factorised, or to elements times
coordinates of the reduction, if that is more.

`MEASURED` holds the coefficients, which `benchmarks/expected.py` fits to finished studies. They are
those of the default element and the default reduction: of thin foil the one-point element takes
fewer steps.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from foilstudy.config import Cell, StudyConfig
from foilstudy.config.foils import foil_of, patch_of

__all__ = [
    "MEASURED",
    "MEMORY_SPREAD",
    "SPREAD",
    "CostModel",
    "Expected",
    "ExpectedConfiguration",
    "expected",
]

RING_MOTIONS = 12
"""Coordinates that every reduced model has."""


@dataclass(frozen=True)
class CostModel:
    """Coefficients of the laws; elements are counted in thousands, R/t in thousands, too.

    Attributes
    ----------
    step, step_exponent : float
        Seconds of one step, and how they grow with the elements.
    settling, condensation, solve_exponent : float
        Seconds of settling and of one static stiffness, and how both grow with the elements.
    projection : float
        Seconds of a reduction for a thousand elements times the square of a hundred coordinates.
    relaxation_steps, slenderness_exponent : float
        Steps after the ramp, and how they grow with R/t.
    coordinates, coordinates_exponent : float
        Reduced coordinates for each kHz of the band beyond the motions of the rings, and how they
        grow with R/t.
    memory_base_mb, memory_mb, projection_memory_mb : float
        Memory of the libraries, that for a thousand elements of the finest mesh, and that for a
        thousand elements times a thousand coordinates.
    job : float
        Seconds of a job beyond its physics.
    gathering : float
        Processor seconds of the jobs that wait for all realisations, and of the cylinder.
    start : float
        Seconds until the first job starts, and of Snakemake in all.
    """

    step: float
    step_exponent: float
    settling: float
    condensation: float
    solve_exponent: float
    projection: float
    relaxation_steps: float
    slenderness_exponent: float
    coordinates: float
    coordinates_exponent: float
    memory_base_mb: float
    memory_mb: float
    projection_memory_mb: float
    job: float
    gathering: float
    start: float

    def steps_after_ramp(self, slenderness: float) -> float:
        """Steps that a foil of R/t relaxes."""
        return self.relaxation_steps * (slenderness / 1000) ** self.slenderness_exponent

    def crumple_seconds(self, elements: float, steps: float) -> float:
        """Time of `steps` steps, ramp included, and of settling."""
        relaxing = steps * self.step * (elements / 1000) ** self.step_exponent
        return relaxing + self.settling * (elements / 1000) ** self.solve_exponent

    def solve_seconds(self, elements: float) -> float:
        """Time of one static stiffness."""
        return self.condensation * (elements / 1000) ** self.solve_exponent

    def static_seconds(self, meshes: Sequence[int]) -> float:
        """Time of the static stiffness on a ladder of meshes, elements each, coarsest first."""
        times = (2, 2, *(1,) * len(meshes))
        return sum(
            count * self.solve_seconds(elements)
            for count, elements in zip(times, meshes, strict=False)
        )

    def reduced_coordinates(self, slenderness: float, band_hz: float) -> float:
        """Coordinates of the reduced model of a foil of R/t, up to the end of the band."""
        growth = (slenderness / 1000) ** self.coordinates_exponent
        return RING_MOTIONS + self.coordinates * band_hz / 1000 * growth

    def dynamic_seconds(self, elements: float, coordinates: float) -> float:
        """Time of the reduction, of its verification and of the responses."""
        projected = self.projection * elements / 1000 * (coordinates / 100) ** 2
        return self.solve_seconds(elements) + projected

    def peak_memory_mb(self, finest: float, elements: float, coordinates: float) -> float:
        """Peak memory of a job: of its finest mesh, or of the reduction on the coarsest."""
        factorised = self.memory_mb * finest / 1000
        reduced = self.projection_memory_mb * elements / 1000 * coordinates / 1000
        return self.memory_base_mb + np.maximum(factorised, reduced)


MEASURED = CostModel(
    step=1.18e-4,
    step_exponent=1.04,
    settling=0.0861,
    condensation=0.0358,
    solve_exponent=1.34,
    projection=0.0313,
    relaxation_steps=7700,
    slenderness_exponent=0.63,
    coordinates=689,
    coordinates_exponent=0.399,
    memory_base_mb=245,
    memory_mb=25.3,
    projection_memory_mb=156,
    job=1.01,
    gathering=39.5,
    start=5.0,
)
"""Fitted to the default study (Intel Xeon, two processors), the published study (AMD EPYC, two busy
processors) and results/convergence: in all they took 1.05 and 1.14 times the expected time."""

SPREAD = 1.6
"""Factor within which nine of ten realisations of a study were, by a model fitted without it: 1.23
of the default study and 1.58 of the published one, on processors of different speed."""

MEMORY_SPREAD = 1.4
"""The same of the largest job: 1.36 and 0.89 of the expected memory."""


@dataclass(frozen=True)
class ExpectedConfiguration:
    """One thickness and one height of a study, and the cost of each of its realisations.

    Attributes
    ----------
    thickness_um, reference_height_mm, element_size_mm : float
        As configured; the size is a number where `auto` was given.
    slenderness : float
        Radius over thickness.
    elements : tuple of int
        Of the mesh that is crumpled, and of each refinement of its shape.
    steps : int
        Ramp and relaxation.
    crumple_seconds, response_seconds, refine_seconds, export_seconds : float
        Processor time of the physics of a job; zero where the study has no such jobs.
    peak_memory_mb : float
        Of the largest of its jobs.
    """

    thickness_um: float
    reference_height_mm: float
    element_size_mm: float
    slenderness: float
    elements: tuple[int, ...]
    steps: int
    crumple_seconds: float
    response_seconds: float
    refine_seconds: float
    export_seconds: float
    peak_memory_mb: float

    @property
    def seconds(self) -> float:
        """Processor time of the physics of one realisation."""
        measured = self.crumple_seconds + self.response_seconds
        return measured + self.refine_seconds + self.export_seconds


@dataclass(frozen=True)
class Expected:
    """The cost of a study.

    Attributes
    ----------
    configurations : tuple of ExpectedConfiguration
        Every thickness with every height.
    seeds : int
        Realisations of each.
    jobs_each : int
        Jobs of one realisation.
    model : CostModel
    """

    configurations: tuple[ExpectedConfiguration, ...]
    seeds: int
    jobs_each: int
    model: CostModel = MEASURED

    @property
    def realisations(self) -> int:
        """Number of realisations."""
        return self.seeds * len(self.configurations)

    @property
    def jobs(self) -> int:
        """Number of jobs of the realisations."""
        return self.jobs_each * self.realisations

    @property
    def realisation_seconds(self) -> float:
        """Processor time of the jobs of all realisations, what is beyond their physics included."""
        physics = self.seeds * sum(each.seconds for each in self.configurations)
        return physics + self.jobs * self.model.job

    @property
    def processor_seconds(self) -> float:
        """Processor time of the whole study."""
        return self.realisation_seconds + self.model.gathering

    @property
    def peak_memory_mb(self) -> float:
        """Memory of the largest job."""
        return max(each.peak_memory_mb for each in self.configurations)

    def wall_seconds(self, cores: int) -> float:
        """Time until the report is there, on so many free cores."""
        busy = min(cores, self.realisations)
        return self.model.start + self.processor_seconds / busy

    def total_memory_mb(self, cores: int) -> float:
        """Memory of the largest jobs at once."""
        return min(cores, self.realisations) * self.peak_memory_mb


def expected(study: StudyConfig, model: CostModel = MEASURED) -> Expected:
    """Expected cost of every realisation of a study."""
    configurations = tuple(
        _configuration(study, cell, model) for cell in study.cells() if cell.seed == study.seeds[0]
    )
    jobs = 2 + (study.stiffness.relaxed_refinements > 0) + bool(study.export.formats)
    return Expected(configurations, len(study.seeds), jobs, model)


def _configuration(study: StudyConfig, cell: Cell, model: CostModel) -> ExpectedConfiguration:
    task = study.crumple_task(cell)
    patch, foil = patch_of(task), foil_of(task)
    elements = patch.elements_around * patch.elements_along
    slenderness = foil.diameter / 2 / foil.thickness
    meshes = tuple(4**level * elements for level in range(study.stiffness.refinements + 1))
    relaxed = [4**level * elements for level in range(1, study.stiffness.relaxed_refinements + 1)]
    relaxing = min(model.steps_after_ramp(slenderness), study.relaxation.relaxation_steps_max)
    steps = study.relaxation.ramp_steps + round(relaxing)
    coordinates = model.reduced_coordinates(slenderness, study.dynamics.shown_max_hz)
    dynamic = model.dynamic_seconds(elements, coordinates)
    exported = model.solve_seconds(elements) + dynamic if study.export.formats else 0.0
    return ExpectedConfiguration(
        thickness_um=cell.thickness_um,
        reference_height_mm=cell.reference_height_mm,
        element_size_mm=task.mesh.element_size_mm,
        slenderness=slenderness,
        elements=meshes,
        steps=steps,
        crumple_seconds=model.crumple_seconds(elements, steps),
        response_seconds=model.static_seconds(meshes) + dynamic,
        refine_seconds=sum(model.crumple_seconds(mesh, relaxing) for mesh in relaxed),
        export_seconds=exported,
        peak_memory_mb=float(model.peak_memory_mb(max([*meshes, *relaxed]), elements, coordinates)),
    )
