"""What a study will cost, before anything of it starts.

Time is a sum of power laws, each with its reason:

- a crumple takes *steps* evaluations of force and mass solve, a little more than proportional to
  the elements as they leave the caches, and one factorisation when it settles;
- contact costs the more, the more there is that touches, which grows with the overlength;
- foil that may yield has its layers brought up to date in every step;
- foil that is more than elastic is reduced twice, stress-free and as it stands, and once more for
  each thing that its closed contacts may do;
- the relaxation takes the more steps, the thinner the foil is against its radius; the ramp takes
  the steps it is told to take;
- a static stiffness costs a factorisation, on every mesh of the ladder: twice on the mesh of the
  crumple (stress-free and pre-stressed) and on the first refinement (corner and staggered element);
- the amplitude at which the stiffness has changed takes so many of these a motion of the ring, and
  the secants one way and the other a few;
- where an error of it is demanded, the ladder ends on the first mesh that meets it, of which the
  element size over sqrt(R t) says most (`foilstudy.model.mesh_size`);
- a reduction costs a factorisation and the projection on its coordinates, elements times their
  square. They grow with the modes in the band, in number proportional to its end, and with R/t.

Memory is proportional to the elements of the finest mesh that is factorised, or to elements times
coordinates of the reduction, if that is more. A shape may need more refinements than expected: the
most that a job may take is told beside it.

`benchmarks/expected.py` fits the coefficients of `CostModel` to finished studies. They are those of
the default element and the default reduction: of thin foil the one-point element takes fewer steps.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from foilstudy.base.numerals import number
from foilstudy.config import Cell, ResponseTask, StudyConfig
from foilstudy.config.foils import foil_of, patch_of
from foilstudy.model.mesh_size import stiffness_error_at

__all__ = [
    "MEASURED",
    "MEMORY_SPREAD",
    "SPREAD",
    "CostModel",
    "Expected",
    "ExpectedConfiguration",
    "costly",
    "expected",
]

RING_MOTIONS = 12
"""Coordinates that every reduced model has."""
_SWEPT = {"axial": 1, "radial": 2}
"""Motions that make up a direction; said here, as whoever expects costs loads no solver."""


@dataclass(frozen=True)
class CostModel:
    """Coefficients of the laws; elements and R/t are counted in thousands.

    Those of a realisation's time are fitted to the published study (Intel Xeon, two processors, one
    of them busy with other things), of which the sum is 1.01 of the expected one; of the resolved
    study, which was not fitted, it is 1.13. Those of memory are chosen so that no realisation of
    either is beyond `MEMORY_SPREAD`.
    """

    step: float = 7.59e-5  # seconds of one step
    step_exponent: float = 1.14
    settling: float = 0.114  # seconds
    condensation: float = 0.0397  # seconds of one static stiffness
    solve_exponent: float = 1.18  # of settling and static stiffness
    projection: float = 0.0331  # seconds of a reduction to a hundred coordinates, growing squared
    relaxation_steps: float = 6670  # after the ramp
    slenderness_exponent: float = 0.719  # of these steps with R/t
    coordinates: float = 682  # for each kHz of the band, beyond the motions of the rings
    coordinates_exponent: float = 0.36  # with R/t
    memory_base_mb: float = 188  # of the libraries
    memory_mb: float = 22  # for a thousand elements of the finest mesh
    projection_memory_mb: float = 235  # for a thousand elements times a thousand coordinates
    job: float = 0.122  # seconds of a job beyond its physics
    gathering: float = 30.2  # seconds of cylinder and all jobs that wait for the realisations
    contact: float = (
        2.2  # of the time of a step, for each unit of overlength, where parts may touch
    )
    sweep: float = 25  # static stiffnesses until a motion of the ring has changed it by 1 %
    push: float = 8.5  # static stiffnesses for the secants of a motion of the ring, both ways
    flow: float = 0.00034  # seconds of a step more for a thousand elements that may yield
    start: float = 3.47  # seconds until the first job starts, and of Snakemake in all

    def steps_after_ramp(self, slenderness: float) -> float:
        """Steps that a foil of R/t relaxes."""
        return self.relaxation_steps * (slenderness / 1000) ** self.slenderness_exponent

    def crumple_seconds(self, elements: float, steps: float, yields: bool = False) -> float:
        """Time of `steps` steps, ramp included, and of settling."""
        step = self.step + self.flow if yields else self.step
        relaxing = steps * step * (elements / 1000) ** self.step_exponent
        return relaxing + self.settling * (elements / 1000) ** self.solve_exponent

    def solve_seconds(self, elements: float) -> float:
        """Time of one static stiffness."""
        return self.condensation * (elements / 1000) ** self.solve_exponent

    def static_seconds(self, meshes: Sequence[int]) -> float:
        """Time of the static stiffness on a ladder of meshes, elements each, coarsest first."""
        return sum(map(self.solve_seconds, (*meshes, *meshes[:2])))  # the first ones twice

    def sweep_seconds(self, elements: float, directions: Sequence[str]) -> float:
        """Time of the sweeps along directions; the radial one has two axes."""
        motions = sum(_SWEPT[direction] for direction in directions)
        return motions * self.sweep * self.solve_seconds(elements)

    def secant_seconds(self, elements: float, directions: Sequence[str]) -> float:
        """Time of the secants along directions, one way and the other."""
        motions = sum(_SWEPT[direction] for direction in directions)
        return motions * self.push * self.solve_seconds(elements)

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


MEASURED = CostModel()

SPREAD = 1.8
"""Factor within which nine of ten realisations of a study are: 1.47 of the published study, 1.42 of
the resolved one, which was not fitted, and more on other processors."""

MEMORY_SPREAD = 1.4
"""The same of the memory of a job: 0.73 to 1.35 of what is expected."""

PROCESSOR_SECONDS_MAX = 14 * 86_400
"""Beyond it a study is most likely larger than meant: a week on two cores."""
MEMORY_MAX_MB = 32_000


@dataclass(frozen=True)
class ExpectedConfiguration:
    """One thickness and one height of a study, and the cost of each of its realisations.

    Attributes
    ----------
    thickness_um, reference_height_mm : float
        As configured.
    elements : tuple of int
        Of the mesh that is crumpled, and of each expected refinement of its shape.
    steps : int
        Ramp and relaxation.
    seconds_of : mapping of str to float
        Processor time of the physics of its jobs, by their kind.
    peak_memory_mb, most_memory_mb : float
        Of the largest of its jobs, and of that if a shape needs all refinements that it may have.
    """

    thickness_um: float
    reference_height_mm: float
    elements: tuple[int, ...]
    steps: int
    seconds_of: Mapping[str, float]
    peak_memory_mb: float
    most_memory_mb: float

    @property
    def seconds(self) -> float:
        """Processor time of the physics of one realisation."""
        return sum(self.seconds_of.values())


@dataclass(frozen=True)
class Expected:
    """The cost of a study.

    Attributes
    ----------
    configurations : tuple of ExpectedConfiguration
        Every thickness with every height.
    realisations, jobs : int
        In all.
    realisation_seconds, processor_seconds : float
        Of the jobs of all realisations, what is beyond their physics included, and of the study.
    start_seconds : float
        In which no job runs.
    """

    configurations: tuple[ExpectedConfiguration, ...]
    realisations: int
    jobs: int
    realisation_seconds: float
    processor_seconds: float
    start_seconds: float

    @property
    def peak_memory_mb(self) -> float:
        """Memory of the largest job."""
        return max(each.peak_memory_mb for each in self.configurations)

    @property
    def most_memory_mb(self) -> float:
        """The same if its shape needs all refinements that it may have."""
        return max(each.most_memory_mb for each in self.configurations)

    def wall_seconds(self, cores: int) -> float:
        """Time until the report is there, on so many free cores."""
        return self.start_seconds + self.processor_seconds / min(cores, self.realisations)

    def total_memory_mb(self, cores: int) -> float:
        """Memory of the largest jobs at once."""
        return min(cores, self.realisations) * self.peak_memory_mb


def costly(cost: Expected) -> list[str]:
    """Sentences about a cost that is almost surely not meant; rarely any."""
    sentences = []
    if cost.processor_seconds > PROCESSOR_SECONDS_MAX:
        days = cost.processor_seconds / 86_400
        sentences.append(
            f"The study takes about {number(days, 2)} days of processor time; check "
            "mesh.element_size_mm and the length of the sweep."
        )
    if cost.peak_memory_mb > MEMORY_MAX_MB:
        sentences.append(
            f"A job takes about {number(cost.peak_memory_mb / 1000, 2)} GB; check "
            "mesh.element_size_mm and the refinements."
        )
    return sentences


def expected(study: StudyConfig, model: CostModel = MEASURED) -> Expected:
    """Expected cost of every realisation of a study."""
    cells, seeds = study.cells(), len(study.seeds)
    configurations = tuple(_configuration(study, cell, model) for cell in cells[::seeds])
    realisations = len(cells)
    jobs = len(configurations[0].seconds_of) * realisations
    physics = seeds * sum(each.seconds for each in configurations)
    seconds = physics + jobs * model.job
    total = seconds + model.gathering
    return Expected(configurations, realisations, jobs, seconds, total, model.start)


def _configuration(study: StudyConfig, cell: Cell, model: CostModel) -> ExpectedConfiguration:
    task = study.crumple_task(cell)
    patch, foil = patch_of(task), foil_of(task)
    elements = patch.elements_around * patch.elements_along
    slenderness = foil.diameter / 2 / foil.thickness
    width = max(patch.size_around, patch.size_along) / math.sqrt(foil.diameter / 2 * foil.thickness)
    response = study.response_task(cell)
    most, refinements = response.refinements, _refinements(response, width)
    meshes = tuple(4**level * elements for level in range(refinements + 1))
    relaxed = [4**level * elements for level in range(1, study.stiffness.relaxed_refinements + 1)]
    relaxing = min(model.steps_after_ramp(slenderness), task.relaxation.relaxation_steps_max)
    ramp, halvings = task.relaxation.ramp_steps, task.mesh.ramp_coarsenings
    steps = ramp + round(relaxing)
    # relaxed on every mesh from that of the ramp on
    crumpling = model.crumple_seconds(elements, steps if not halvings else relaxing, study.yields)
    for level in range(1, halvings + 1):
        steps_there = relaxing + (ramp if level == halvings else 0)
        crumpling += model.crumple_seconds(elements / 4**level, steps_there, study.yields)
    if task.contact.kind != "none":
        if study.installation.waiting_hours:  # then contacts settle
            crumpling += model.crumple_seconds(elements, relaxing, study.yields)
        crumpling *= 1 + model.contact * cell.overlength_percent / 100
    coordinates = model.reduced_coordinates(slenderness, study.dynamics.shown_max_hz)
    dynamic = model.dynamic_seconds(elements, coordinates)
    seconds = {
        "crumple": crumpling,
        "response": model.static_seconds(meshes)
        + model.sweep_seconds(elements, study.amplitude.directions)
        + model.secant_seconds(elements, study.stiffness.one_sided)
        + dynamic * (1 + study.beyond_elastic + len(study.dynamics.contacts)),
    }
    if relaxed:
        seconds["refine"] = sum(
            model.crumple_seconds(mesh, relaxing, study.yields) for mesh in relaxed
        )
    if study.export.formats:
        seconds["export"] = model.solve_seconds(elements) + dynamic
    memory = [
        float(model.peak_memory_mb(max([finest, *relaxed]), elements, coordinates))
        for finest in (meshes[-1], 4**most * elements)
    ]
    return ExpectedConfiguration(
        cell.thickness_um, cell.reference_height_mm, meshes, steps, seconds, *memory
    )


def _refinements(task: ResponseTask, width: float) -> int:
    """Refinements of a shape crumpled on elements `width` times sqrt(R t) wide.

    A shape whose steps do not shrink takes more.
    """
    if task.error_percent is None:
        return task.refinements
    enough = (
        halvings
        for halvings in range(task.refinements)
        if stiffness_error_at(width, halvings) <= task.error_percent / 100
    )
    return next(enough, task.refinements)
