"""The whole study: sections, the checks that span them, the cells of the sweep."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

from pydantic import Field, model_validator

from foilstudy.base.errors import ConfigError
from foilstudy.model.supports.moves import poses

from .accuracy import ACCURACIES, STANDARD, Accuracy, completed
from .air import Air
from .contact import Contact, ContactUse, contact_problems
from .export import Export
from .installation import moves_of
from .isolation import Isolation
from .mesh import Mesh, MeshUse, mesh_problems, refinements_that_fit
from .sections import (
    AUTO,
    CONFIDENCE_DEFAULT_PERCENT,
    HEIGHT_MAX_MM,
    Amplitude,
    Dynamics,
    Imperfection,
    Installation,
    Material,
    Method,
    Relaxation,
    Report,
    Section,
    Sheet,
    Stiffness,
    Study,
    Sweep,
    unit_field,
)
from .specimen import Specimen, clamps_of
from .tasks import CrumpleTask, RefineTask, ResponseTask

__all__ = ["Cell", "StudyConfig", "overlength_id", "thickness_id"]

# Beyond this ratio transverse shear matters and Kirchhoff-Love theory ends.
THICKNESS_TO_RADIUS_MAX = 1 / 20
# Of all thicknesses and heights; Snakemake cannot plan more in reasonable time.
REALISATIONS_MAX = 20_000


def _plain(value: float) -> str:
    """Number as part of a path: no dot, no exponent, three decimals at most."""
    return f"{value:.3f}".rstrip("0").rstrip(".").replace(".", "p")


def thickness_id(thickness_um: float) -> str:
    """Path and wildcard id of a thickness in um, such as ``t500um`` or ``t12p5um``."""
    return f"t{_plain(thickness_um)}um"


def overlength_id(reference_height_mm: float) -> str:
    """Path and wildcard id of a reference height in mm, such as ``h170mm`` or ``h167p5mm``."""
    return f"h{_plain(reference_height_mm)}mm"


FROM_RINGS_OUT_OF_TRUE = ("relaxation", "installation", "ring_alone")
"""Paths that need not begin in equilibrium."""


@dataclass(frozen=True)
class Cell:
    """One realisation of the sweep.

    Attributes
    ----------
    thickness_um : float
        Foil thickness in um.
    reference_height_mm : float
        Height of the uncrumpled cylinder in mm.
    overlength_percent : float
        Excess of the reference height over the gap height, in per cent of the gap height.
    seed : int
        Seed of the random imperfection.
    """

    thickness_um: float
    reference_height_mm: float
    overlength_percent: float
    seed: int

    @property
    def thickness_id(self) -> str:
        """Id of the thickness in paths and wildcards."""
        return thickness_id(self.thickness_um)

    @property
    def overlength_id(self) -> str:
        """Id of the overlength in paths and wildcards, made from the reference height."""
        return overlength_id(self.reference_height_mm)


def _default_material() -> Material:
    return Material.model_validate({})


class StudyConfig(Section):
    """Configuration of a study."""

    study: Study = Field(default_factory=Study, description="Identity of the study.")
    accuracy: Literal[tuple(ACCURACIES)] = unit_field(
        "choice",
        "One word for all tolerances; keys that are given win over it. "
        + "; ".join(f"`{name}`: {tier.words}" for name, tier in ACCURACIES.items())
        + ".",
        STANDARD.name,
    )
    sheet: Sheet = Field(
        default_factory=Sheet, description="Cylinder of foil and the gap it must fit."
    )
    material: Material = Field(
        default_factory=_default_material, description="Material of the foil."
    )
    specimen: Specimen = Field(
        default_factory=Specimen, description="In what foil and clamps are not ideal."
    )
    sweep: Sweep = Field(description="Parameter grid.")
    imperfection: Imperfection = Field(
        default_factory=Imperfection, description="Random imperfection."
    )
    mesh: Mesh = Field(default_factory=Mesh, description="Discretisation.")
    relaxation: Relaxation = Field(default_factory=Relaxation, description="Dynamic relaxation.")
    installation: Installation = Field(
        default_factory=Installation, description="How the foil is fitted."
    )
    contact: Contact = Field(
        default_factory=Contact, description="What parts of the foil do that come near each other."
    )
    method: Method = Field(default_factory=Method, description="Strategies of crumpling.")
    stiffness: Stiffness = Field(default_factory=Stiffness, description="Static stiffness.")
    dynamics: Dynamics = Field(default_factory=Dynamics, description="Dynamic stiffness.")
    air: Air = Field(default_factory=Air, description="Air about the foil.")
    amplitude: Amplitude = Field(
        default_factory=Amplitude, description="How far the stiffness holds."
    )
    isolation: Isolation = Field(
        default_factory=Isolation, description="Isolated payload with foil links."
    )
    export: Export = Field(default_factory=Export, description="Files for other tools.")
    report: Report = Field(default_factory=Report, description="Report page.")

    def __repr__(self) -> str:
        sweep = self.sweep
        realisations = f"at most {sweep.most}" if sweep.in_rounds else sweep.realisations
        counts = len(self.thicknesses_um), len(self.reference_heights_mm), realisations
        return "<StudyConfig: {}, {} thicknesses x {} heights x {} realisations>".format(
            self.study.name, *counts
        )

    __str__ = __repr__

    @model_validator(mode="before")
    @classmethod
    def _take_the_values_of_the_tier(cls, data: Any) -> Any:
        return completed(data) if isinstance(data, Mapping) else data

    @classmethod
    def sections(cls) -> dict[str, type[Section]]:
        """Its sections by name; the other keys hold a word."""
        return {
            name: field.annotation
            for name, field in cls.model_fields.items()
            if isinstance(field.annotation, type) and issubclass(field.annotation, Section)
        }

    @property
    def simulated(self) -> StudyConfig:
        """The study without the measurements that its page alone shows."""
        return self.model_copy(update={"report": self.report.model_copy(update={"measured": ()})})

    @property
    def tier(self) -> Accuracy:
        """What the word `accuracy` stands for."""
        return ACCURACIES[self.accuracy]

    @model_validator(mode="before")
    @classmethod
    def _default_confidence(cls, data: Any) -> Any:
        """What ends the rounds is written down, not only assumed."""
        if not isinstance(data, Mapping):
            return data
        sweep, report = data.get("sweep"), data.get("report", {})
        if not (isinstance(sweep, Mapping) and isinstance(report, Mapping)):
            return data  # wrong, or whole already
        if sweep.get("realisations") != AUTO or report.get("confidence_percent") is not None:
            return data
        return dict(data) | {"report": {**report, "confidence_percent": CONFIDENCE_DEFAULT_PERCENT}}

    @model_validator(mode="after")
    def _check_across_sections(self) -> StudyConfig:
        problems = list(self._height_problems()) or list(mesh_problems(self.mesh, self._mesh_use()))
        problems += self._size_problems()
        problems += self._thickness_problems()
        problems += self._installation_problems()
        problems += self._specimen_problems()
        problems += self._measured_problems()
        problems += self._following_problems()
        if not problems:  # its meshes are there
            problems += self._contact_problems()
        problems += _duplicates("sweep.thickness_um", self.sweep.thickness_um, thickness_id)
        if self.sweep.reference_height_mm is not None:
            problems += _duplicates(
                "sweep.reference_height_mm", self.sweep.reference_height_mm, overlength_id
            )
        if self.sweep.overlength_percent is not None:
            problems += _duplicates(
                "sweep.overlength_percent",
                self.sweep.overlength_percent,
                lambda percent: overlength_id(self._reference_height_mm(percent)),
            )
        if problems:
            raise ValueError("\n".join(problems))
        return self

    def _height_problems(self) -> Iterator[str]:
        gap = self.sheet.gap_height_mm
        for i, height in enumerate(self.sweep.reference_height_mm or ()):
            if height <= gap:
                yield (
                    f"sweep.reference_height_mm[{i}] is {height:g} mm, not above "
                    f"sheet.gap_height_mm ({gap:g} mm), so nothing would crumple; use a height "
                    "above the gap."
                )
        for i, percent in enumerate(self.sweep.overlength_percent or ()):
            height = self._reference_height_mm(percent)
            if height > HEIGHT_MAX_MM:
                yield (
                    f"sweep.overlength_percent[{i}] is {percent:g} %, which makes a height of "
                    f"{height:g} mm over sheet.gap_height_mm ({gap:g} mm), out of range; keep it "
                    f"to {HEIGHT_MAX_MM:g} mm, and check that the gap is in mm."
                )

    def _measured_problems(self) -> Iterator[str]:
        """Measurements of configurations that the sweep does not have."""
        kinds = (
            ("thickness_um", "sweep.thickness_um", self.thicknesses_um, "um"),
            ("height_mm", "the reference heights of the sweep", self.reference_heights_mm, "mm"),
        )
        for i, run in enumerate(self.report.measured):
            for key, place, known, unit in kinds:
                value = getattr(run, key)
                shown = ", ".join(f"{each:g}" for each in known)
                if value is None and len(known) > 1:
                    yield (
                        f"report.measured[{i}].{key} is missing, and the study has several "
                        f"({shown} {unit}); say which one was measured."
                    )
                elif value is not None and all(abs(value / each - 1) > 1e-3 for each in known):
                    yield (
                        f"report.measured[{i}].{key} is {value:g} {unit}, which is not among "
                        f"{place} ({shown} {unit}); give one of these."
                    )

    def _installation_problems(self) -> Iterator[str]:
        moves, path = self.installation.moves, self.method.path
        if moves and path != "installation":
            yield (
                f"installation.moves is given, but method.path is {path}, which has no moves; set "
                "method.path: installation, or remove them."
            )
        elif path == "installation" and not moves:
            yield (
                "method.path is installation, but installation.moves is not given; give moves such "
                "as [{shorten_percent: 125}], or remove method.path."
            )
        waits, relaxes = self.installation.waiting_hours, self.material.relaxation_per_decade
        if bool(waits) != bool(relaxes):
            given, missing = ("installation.waiting_hours", "material.relaxation_per_decade")
            if relaxes:
                given, missing = missing, given
            yield f"{given} is given, but without {missing} nothing relaxes; give both, or neither."
        radius, gap = self.sheet.diameter_mm / 2e3, self.sheet.gap_height_mm / 1e3
        wrong: dict[int, str] = {}
        for height in self.reference_heights_mm:
            for number, pose in poses(moves_of(self.installation)):
                if pose and number not in wrong:
                    wrong[number] = pose.beyond(radius, height / 1e3, gap)
        for number, reason in wrong.items():
            if reason:
                yield f"installation.moves[{number}] {reason}."

    def _specimen_problems(self) -> Iterator[str]:
        around = math.pi * self.sheet.diameter_mm
        if self.specimen.seam_width_mm >= around:
            yield (
                f"specimen.seam_width_mm is {self.specimen.seam_width_mm:g} mm, and the foil "
                f"measures {around:.4g} mm around; give a seam that is narrower."
            )
        if not self.specimen.even and "calculix" in self.export.formats:
            yield (
                "export.formats has calculix, whose deck knows one thickness and one modulus; "
                "remove it, or specimen.seam_width_mm and specimen.thickness_deviation_percent."
            )
        if self.specimen.gravity_m_s2 and self.installation.waiting_hours:
            yield (
                "installation.waiting_hours lets stress go, and with it what carries the weight of "
                "the foil; remove it, or specimen.gravity_m_s2."
            )
        radius, gap = self.sheet.diameter_mm / 2e3, self.sheet.gap_height_mm / 1e3
        if reason := clamps_of(self.specimen).beyond(radius, gap):
            keys = {"bends": "ring_ellipticity_mm", "lets": "clamp_slip_mm"}
            yield f"specimen.{keys.get(reason.split()[0], 'ring_tilt_deg')} {reason}."
        if not (self.specimen.true or self.method.path in FROM_RINGS_OUT_OF_TRUE):
            yield (
                f"method.path is {self.method.path}, which begins between true rings; remove "
                "specimen.ring_ellipticity_mm and specimen.ring_tilt_deg, or set method.path: "
                "relaxation."
            )
        if self.specimen.clamp_slip_mm and self.method.path not in FROM_RINGS_OUT_OF_TRUE:
            yield (
                f"method.path is {self.method.path}, which holds the edges of the foil; remove "
                "specimen.clamp_slip_mm, or set method.path: relaxation."
            )
        if self.specimen.clamp_slip_mm and self.contact.ring_planes:
            yield (
                "contact.ring_planes stands on three points of each edge, which clamps that let "
                "the foil slip move; remove it, or specimen.clamp_slip_mm."
            )

    def _contact_problems(self) -> Iterator[str]:
        use = ContactUse(
            self.sheet.diameter_mm,
            self.reference_heights_mm,
            {each: self.mesh_of(each).element_size_mm for each in self.thicknesses_um},
            self.mesh.ramp_coarsenings,
            self.stiffness.relaxed_refinements,
            self.method,
        )
        yield from contact_problems(self.contact, use)
        if self.contact.kind != "none" and self.imperfection.removal != "never":
            yield (
                "imperfection.removal is after_buckling, which contact does not know of; remove "
                "it, or set contact.kind: none."
            )

    def _following_problems(self) -> Iterator[str]:
        """Small motions whose answer is known, as nothing yields or touches in them."""
        if self.stiffness.one_sided and not (self.yields or self.contact.kind != "none"):
            yield (
                "stiffness.one_sided is given, but this foil is elastic and touches nothing, and "
                "so is as stiff one way as the other; remove it, or set material.law: plastic."
            )
        if self.dynamics.contacts and self.contact.kind == "none":
            yield (
                "dynamics.contacts is given, but contact.kind is none, so that nothing touches; "
                "remove it, or set contact.kind: barrier."
            )
        lists = (
            ("stiffness.one_sided", self.stiffness.one_sided),
            ("dynamics.contacts", self.dynamics.contacts),
        )
        for key, words in lists:
            if len(set(words)) < len(words):
                yield f"{key} is {list(words)}, which names one twice; name each once."

    def _size_problems(self) -> Iterator[str]:
        number = len(self.thicknesses_um) * len(self.reference_heights_mm) * len(self.seeds)
        if number > REALISATIONS_MAX:
            key = "sweep.realisations_max" if self.sweep.in_rounds else "sweep.realisations"
            yield (
                f"{key} is {self.sweep.most}, which makes {number} "
                f"realisations of all thicknesses and heights (at most {REALISATIONS_MAX}); use "
                "fewer, or shorter lists."
            )

    def _mesh_use(self) -> MeshUse:
        stiffness = self.stiffness
        by_need = stiffness.error_percent is not None
        refinements = min(1, stiffness.refinements) if by_need else stiffness.refinements
        return MeshUse(
            self.sheet.diameter_mm,
            self.reference_heights_mm,
            self.thicknesses_um,
            max(refinements, stiffness.relaxed_refinements),
            self.imperfection.correlation_length_mm,
        )

    def mesh_of(self, thickness_um: float) -> Mesh:
        """Mesh of a thickness; with ``auto`` its element size is that of the stated error."""
        return self.mesh.resolved(*self._sizing(thickness_um))

    def sized_by(self, thickness_um: float) -> str:
        """What decided the element size of a thickness, in a few words."""
        return self.mesh.sized_by(*self._sizing(thickness_um))

    def _sizing(self, thickness_um: float) -> tuple[float, float, float]:
        return self.sheet.diameter_mm, self.reference_heights_mm[0], thickness_um

    def relaxation_of(self, thickness_um: float) -> Relaxation:
        """Relaxation of a thickness, the steps of its ramp and after it numbers."""
        return self.relaxation.resolved(1e3 * self.sheet.diameter_mm / 2 / thickness_um)

    def _thickness_problems(self) -> Iterator[str]:
        limit = 1e3 * self.sheet.diameter_mm / 2 * THICKNESS_TO_RADIUS_MAX
        for i, thickness in enumerate(self.sweep.thickness_um):
            if thickness > limit:
                yield (
                    f"sweep.thickness_um[{i}] is {thickness:g} um, more than 1/20 of the radius, "
                    f"where thin-shell theory ends; use {limit:g} um or less, and check that the "
                    "value is in um."
                )

    def _reference_height_mm(self, overlength_percent: float) -> float:
        # Rounded to the picometre: 130 * 1.3 is 169, not 169.00000000000003.
        return round(self.sheet.gap_height_mm * (1 + overlength_percent / 100), 9)

    @cached_property
    def _heights_and_overlengths(self) -> tuple[tuple[float, float], ...]:
        gap = self.sheet.gap_height_mm
        if self.sweep.reference_height_mm is not None:
            heights = sorted(self.sweep.reference_height_mm)
            return tuple((height, 100 * (height - gap) / gap) for height in heights)
        overlengths = sorted(self.sweep.overlength_percent or ())
        return tuple((self._reference_height_mm(percent), percent) for percent in overlengths)

    @property
    def thicknesses_um(self) -> tuple[float, ...]:
        """Thicknesses of the sweep in um, ascending."""
        return tuple(sorted(self.sweep.thickness_um))

    @property
    def reference_heights_mm(self) -> tuple[float, ...]:
        """Reference heights of the sweep in mm, ascending, also where overlengths were given."""
        return tuple(height for height, _ in self._heights_and_overlengths)

    @property
    def overlengths_percent(self) -> tuple[float, ...]:
        """Overlengths of the sweep in per cent, ascending, also where heights were given."""
        return tuple(percent for _, percent in self._heights_and_overlengths)

    @property
    def seeds(self) -> tuple[int, ...]:
        """Seeds of the realisations: 0, 1, 2, ...; where these grow in rounds, of all possible."""
        return tuple(range(self.sweep.most))

    @property
    def beyond_elastic(self) -> bool:
        """Whether its foils are more than elastic shells, so that they have a state of their own.

        Then their true stiffness is measured; of elastic ones the pre-stressed one is that.
        """
        return (
            self.yields
            or self.installation.waiting_hours > 0
            or self.contact.kind != "none"
            or self.specimen.gravity_m_s2 != 0
            or self.specimen.clamp_slip_mm > 0
        )

    @property
    def yields(self) -> bool:
        """Whether its material may yield."""
        return self.material.law != "elastic"

    @property
    def lets_go(self) -> bool:
        """Whether a ring is let go as the foil is fitted."""
        return any(move.release for move in self.installation.moves)

    def with_fewest(self) -> StudyConfig:
        """The same study with a fixed number of realisations, those of the first round."""
        update = {"realisations": self.sweep.fewest, "realisations_max": None}
        return self.model_copy(update={"sweep": self.sweep.model_copy(update=update)})

    def cells(self) -> tuple[Cell, ...]:
        """All realisations, ordered by thickness, overlength and seed.

        Where they grow in rounds, all that there may be; see `foilstudy.study.sweep.rounds`.
        """
        return tuple(
            Cell(thickness, height, percent, seed)
            for thickness in self.thicknesses_um
            for height, percent in self._heights_and_overlengths
            for seed in self.seeds
        )

    @cached_property
    def _cell_by_id(self) -> dict[tuple[str, str, int], Cell]:
        return {(c.thickness_id, c.overlength_id, c.seed): c for c in self.cells()}

    def cell(self, thickness_id: str, overlength_id: str, seed: int | str) -> Cell:
        """Realisation with the given ids, as they stand in a path.

        Raises
        ------
        ConfigError
            If the sweep has no such realisation.
        """
        try:
            return self._cell_by_id[thickness_id, overlength_id, int(seed)]
        except (KeyError, ValueError):
            first, last = self.cells()[0], self.cells()[-1]
            raise ConfigError(
                f"Study {self.study.name} has no realisation {thickness_id}/{overlength_id}/{seed}:"
                f" its sweep runs from {first.thickness_id}/{first.overlength_id}/{first.seed} to "
                f"{last.thickness_id}/{last.overlength_id}/{last.seed}; use one of its ids, or add "
                "the value to the sweep."
            ) from None

    def crumple_task(self, cell: Cell) -> CrumpleTask:
        """Everything that decides how a realisation crumples."""
        return CrumpleTask(
            sheet=self.sheet,
            material=self.material,
            specimen=self.specimen,
            imperfection=self.imperfection,
            mesh=self.mesh_of(cell.thickness_um),
            relaxation=self.relaxation_of(cell.thickness_um),
            installation=self.installation,
            contact=self.contact,
            method=self.method,
            thickness_um=cell.thickness_um,
            reference_height_mm=cell.reference_height_mm,
            seed=cell.seed,
        )

    def response_task(self, cell: Cell) -> ResponseTask:
        """Everything, beside the crumpled shape, that decides its stiffness."""
        return ResponseTask(
            sheet=self.sheet,
            material=self.material,
            specimen=self.specimen,
            error_percent=self.stiffness.error_percent,
            refinements=self._refinements_of(cell),
            dynamics=self.dynamics,
            air=self.air,
            linear_directions=self.amplitude.directions,
            one_sided=self.stiffness.one_sided,
            thickness_um=cell.thickness_um,
            reference_height_mm=cell.reference_height_mm,
            seed=cell.seed,
        )

    def _refinements_of(self, cell: Cell) -> int:
        """Refinements of a shape; where they are made by need, as many as its mesh can carry."""
        if self.stiffness.error_percent is None:
            return self.stiffness.refinements
        area = math.pi * self.sheet.diameter_mm * cell.reference_height_mm
        size = self.mesh_of(cell.thickness_um).element_size_mm
        return refinements_that_fit(size, area, self.stiffness.refinements)

    def refine_task(self, cell: Cell) -> RefineTask:
        """Everything, beside the crumpled shape, that decides what refining makes of it."""
        return RefineTask(
            sheet=self.sheet,
            material=self.material,
            specimen=self.specimen,
            refinements=self.stiffness.relaxed_refinements,
            thickness_um=cell.thickness_um,
            reference_height_mm=cell.reference_height_mm,
            seed=cell.seed,
        )

    def cylinder_task(self) -> str:
        """Everything that decides the bounds of the perfect cylinder, as JSON."""
        grid = {"thickness_um", "reference_height_mm", "overlength_percent"}
        return self.model_dump_json(
            include={"sheet": True, "material": True, "sweep": grid, "mesh": True}
        )

    def to_yaml(self) -> str:
        """Full validated configuration as YAML, defaults included, for provenance."""
        from ._yaml import written  # jobs that only read a task need no YAML

        return written(self.model_dump(mode="json", exclude_none=True))


def _duplicates(
    path: str, values: Sequence[float], make_id: Callable[[float], str]
) -> Iterator[str]:
    first: dict[str, int] = {}
    for i, value in enumerate(values):
        j = first.setdefault(make_id(value), i)
        if j == i:
            continue
        if values[j] == value:
            yield f"{path}[{i}] repeats {path}[{j}] ({value:g}); remove one of them."
        else:
            yield (
                f"{path}[{i}] ({value!r}) and {path}[{j}] ({values[j]!r}) are too close: both "
                f"would be stored as {make_id(value)}; remove one, or set them 0.001 apart."
            )
