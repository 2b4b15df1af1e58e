"""The sections of a study configuration, with units in the key names and defaults in one place.

The defaults are the published case (M. Bader, Structural Dynamics of Crumpled Thin Sheets, TU
Delft, 2026), on a mesh that resolves it. Validators raise complete sentences that name the key
path, because the reader of the message looks at a YAML file, not at this code.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    PlainSerializer,
    WithJsonSchema,
    WrapValidator,
    model_serializer,
    model_validator,
)

from foilstudy.base.registry import Registry, did_you_mean
from foilstudy.measure.choices import (
    CLOSED_CONTACTS,
    REDUCTIONS,
    STRESS_REMOVALS,
    STRUCTURAL_DAMPINGS,
)
from foilstudy.model.imperfections import IMPERFECTIONS
from foilstudy.model.materials import MATERIALS
from foilstudy.model.shell.material import LAWS
from foilstudy.solve import pace
from foilstudy.solve.choices import DAMPINGS, MASSES, PATHS, SEARCHES

from .accuracy import ACCURACIES, AUTO, STANDARD
from .choices import choice_of

CORRELATION_LENGTH_DEFAULT_MM = 15.0
FIRST_ROUND = 6
"""Realisations that all begin with: the scatter of fewer says little about how many it takes."""
REALISATIONS_MAX_DEFAULT = 24
CONFIDENCE_DEFAULT_PERCENT = 20.0
RAMP_STEPS_MIN = 100
"""In fewer the foil cannot follow the ring."""
RAMP_STEPS_MAX = REST_STEPS_MAX = 10_000_000
TEXT_MAX = 200
# Any characters of any language, and several lines, but none that no file or terminal can show.
_SHOWN = r"^[^\x00-\x08\x0B-\x1F\x7F-\x9F\u2028\u2029]*$"
TEXT = {"min_length": 1, "max_length": TEXT_MAX, "pattern": _SHOWN}
CONSTANTS = ("youngs_modulus_mpa", "poisson_ratio", "density_kg_m3", "yield_stress_mpa")


def unit_field(unit: str, description: str, default: Any = ..., **constraints: Any) -> Any:
    """Field of a section with its unit recorded for the schema and the reference page."""
    return Field(default, description=description, json_schema_extra={"unit": unit}, **constraints)


def registry_field(registry: Registry, default: str, what: str = "") -> Any:
    """Field with the names of a registry for values, described by its words."""
    return unit_field("choice", f"{what}{registry.words}", default)


def tier_words(path: str) -> str:
    """What the tiers make of a key, for its description."""
    values = ", ".join(f"{tier.values[path]:g} ({name})" for name, tier in ACCURACIES.items())
    return f"Decided by `accuracy`: {values}."


def auto_or(kind: type, least: float, most: float) -> Any:
    """Type of a field whose value is a number or the word `auto`.

    One type with a word beside the numbers: of a union, Pydantic would report every branch.
    """

    def number_or_auto(value: Any, as_number: Callable[[Any], Any]) -> Any:
        return AUTO if value == AUTO else as_number(value)

    name = "integer" if kind is int else "number"
    schema = {"anyOf": [{"type": name, "minimum": least, "maximum": most}, {"const": AUTO}]}
    return Annotated[
        kind,
        Field(ge=least, le=most),
        WrapValidator(number_or_auto),
        PlainSerializer(lambda value: value),
        WithJsonSchema(schema),
    ]


class Section(BaseModel):
    """Base of everything configured: immutable, no unknown key, no silent conversion."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True, allow_inf_nan=False)
    unsaid_if_empty: ClassVar[tuple[str, ...]] = ()
    """Lists that are not written down when they are empty: cubes and records of studies without
    them stay what they were before there were any."""

    @model_serializer(mode="wrap")
    def _without_empty_lists(
        self, values_of: Callable[[Section], dict[str, Any]]
    ) -> dict[str, Any]:
        values = values_of(self)
        for name in self.unsaid_if_empty:
            if not values.get(name):
                values.pop(name, None)
        return values


class Study(Section):
    """Identity of the study."""

    name: str = unit_field(
        "id",
        "Name of the study and of its folder `results/NAME`: "
        "letters, digits, `_` and `-`, starting with a letter or digit.",
        "study",
        pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]*$",
        max_length=64,
    )


class Sheet(Section):
    """Cylinder of foil and the gap it is crumpled into."""

    diameter_mm: float = unit_field(
        "mm", "Diameter of the foil cylinder and of both end rings.", 200.0, ge=1, le=10_000
    )
    gap_height_mm: float = unit_field(
        "mm", "Height between the end rings after crumpling.", 130.0, ge=1, le=10_000
    )


def _material_schema(schema: dict[str, Any]) -> None:
    """Constants are required only where the name does not supply them."""
    schema.pop("required", None)
    schema["if"] = {"properties": {"name": {"enum": list(MATERIALS)}}}
    schema["else"] = {"required": ["name", *CONSTANTS]}


class Material(Section):
    """Isotropic foil material.

    A known name fills the constants; any constant given beside it takes precedence. Another name
    needs all four constants.
    """

    model_config = ConfigDict(json_schema_extra=_material_schema)

    name: str = unit_field(
        "text", "Name of a known material (see below), or any other name.", "FEP", **TEXT
    )
    law: choice_of(LAWS) = registry_field(LAWS, "elastic")
    youngs_modulus_mpa: float = unit_field("MPa", "Young's modulus.", ge=1e-3, le=2e6)
    poisson_ratio: float = unit_field("1", "Poisson's ratio.", gt=-1, le=0.5)
    density_kg_m3: float = unit_field("kg/m3", "Density.", ge=0.1, le=30_000)
    yield_stress_mpa: float = unit_field(
        "MPa",
        "Uniaxial yield stress: of the plastic law, and with the elastic one only for the reported "
        "share of the surface beyond yield.",
        ge=1e-6,
        le=1e5,
    )
    hardening_mpa: float | None = unit_field(
        "MPa",
        "Slope of the stress over the plastic strain; only with `law: plastic`. Left out, it is a "
        "twentieth of Young's modulus. With less, folds may collapse and never come to rest.",
        None,
        ge=0,
        le=2e6,
    )
    relaxation_per_decade: float = unit_field(
        "1",
        "Share of its stress that the held foil loses in each tenfold of the time since it was "
        "fitted, for `installation.waiting_hours`; films lose about 0.1.",
        0.0,
        ge=0,
        le=1,
    )

    @model_validator(mode="after")
    def _hardening_only_where_it_counts(self) -> Material:
        if self.hardening_mpa is not None and self.law == "elastic":
            raise ValueError(
                "material.hardening_mpa is given, but material.law is elastic, which never yields; "
                "remove it, or set material.law: plastic."
            )
        return self

    @model_validator(mode="before")
    @classmethod
    def _fill_known_constants(cls, data: Any) -> Any:
        if not isinstance(data, Mapping):
            return data
        name = data.get("name", cls.model_fields["name"].default)
        # A name that is none has its own error; missing constants would only hide it.
        is_name = isinstance(name, str) and 0 < len(name) <= TEXT_MAX
        known = MATERIALS.get(name) if is_name else MATERIALS["FEP"]
        if known is not None:
            return {key: getattr(known, key) for key in CONSTANTS} | dict(data)
        missing = [f"material.{key}" for key in CONSTANTS if key not in data]
        if missing:
            raise ValueError(
                f"material.name is {name!r}, which is not a known material, and "
                f"{', '.join(missing)} {'is' if len(missing) == 1 else 'are'} missing; "
                f"{did_you_mean(name, MATERIALS)}"
                f"use one of {', '.join(MATERIALS)}, or give all four constants."
            )
        return data


Thickness = Annotated[float, Field(ge=0.1, le=10_000)]
HEIGHT_MAX_MM = 10_000
Height = Annotated[float, Field(gt=0, le=HEIGHT_MAX_MM)]
Frequency = Annotated[float, Field(gt=0, le=1e6)]
Overlength = Annotated[float, Field(ge=0.01, le=1_000)]
# Lax only in the container: YAML and JSON know lists, the frozen model holds tuples.
_LIST = {"strict": False, "min_length": 1, "max_length": 1000}


class Sweep(Section):
    """Parameter grid: every thickness with every height, each crumpled several times."""

    model_config = ConfigDict(
        json_schema_extra={
            "oneOf": [{"required": ["reference_height_mm"]}, {"required": ["overlength_percent"]}]
        }
    )

    thickness_um: tuple[Thickness, ...] = unit_field("list of um", "Foil thicknesses.", **_LIST)
    reference_height_mm: tuple[Height, ...] | None = unit_field(
        "list of mm",
        "Heights of the uncrumpled cylinder, above the gap height. "
        "Either this or `overlength_percent`.",
        None,
        **_LIST,
    )
    overlength_percent: tuple[Overlength, ...] | None = unit_field(
        "list of %",
        "Overlengths, 100 (reference height - gap height) / gap height. "
        "Either this or `reference_height_mm`.",
        None,
        **_LIST,
    )
    realisations: auto_or(int, 1, 10_000) = unit_field(
        "1",
        "Random imperfections per thickness and height; their seeds are 0, 1, 2, ... `auto`: for "
        "each thickness and height as many as `report.confidence_percent` takes, in rounds.",
        6,
    )
    realisations_max: int | None = unit_field(
        "1",
        "Most realisations of a thickness and height "
        f"({REALISATIONS_MAX_DEFAULT} if left out); only with `realisations: auto`.",
        None,
        ge=2,
        le=10_000,
    )

    @property
    def in_rounds(self) -> bool:
        """Whether the number of realisations follows from their scatter."""
        return self.realisations == AUTO

    @property
    def fewest(self) -> int:
        """Smallest number of realisations that a thickness and height can have."""
        return min(FIRST_ROUND, self.most) if self.in_rounds else self.realisations

    @property
    def most(self) -> int:
        """Largest number of realisations that a thickness and height can have."""
        return self.realisations_max if self.in_rounds else self.realisations

    @model_validator(mode="before")
    @classmethod
    def _default_most(cls, data: Any) -> Any:
        if (
            isinstance(data, Mapping)
            and data.get("realisations") == AUTO
            and data.get("realisations_max") is None
        ):
            return dict(data) | {"realisations_max": REALISATIONS_MAX_DEFAULT}
        return data

    @model_validator(mode="after")
    def _most_only_if_in_rounds(self) -> Sweep:
        if not self.in_rounds and self.realisations_max is not None:
            raise ValueError(
                f"sweep.realisations_max is given, but sweep.realisations is {self.realisations}, "
                "which settles their number; remove one of them, or set sweep.realisations: auto."
            )
        return self

    @model_validator(mode="after")
    def _exactly_one_height(self) -> Sweep:
        given = (self.reference_height_mm is not None) + (self.overlength_percent is not None)
        if given == 2:
            raise ValueError(
                "sweep.reference_height_mm and sweep.overlength_percent are both given, but one "
                "follows from the other; remove one of them."
            )
        if given == 0:
            raise ValueError(
                "sweep has neither reference_height_mm nor overlength_percent; give one of them, "
                "such as overlength_percent: [15, 30, 60]."
            )
        return self


class Imperfection(Section):
    """Random deviation from the perfect cylinder that decides where the foil buckles."""

    kind: choice_of(IMPERFECTIONS) = registry_field(IMPERFECTIONS, "gaussian")
    amplitude_um: float = unit_field(
        "um",
        "Standard deviation of each coordinate of a control point; of the radial one for "
        "`buckling_modes`.",
        10.0,
        gt=0,
        le=1e6,
    )
    correlation_length_mm: float | None = unit_field(
        "mm",
        "Correlation length of a `smoothed` imperfection "
        f"({CORRELATION_LENGTH_DEFAULT_MM:g} if left out); not for the other kinds.",
        None,
        gt=0,
        le=10_000,
    )
    removal: Literal["never", "after_buckling"] = unit_field(
        "choice",
        "Whether the imperfection stays in the stress-free shape (`never`), or is taken out of it "
        "at twice the shortening at which a perfect cylinder buckles (`after_buckling`), as if it "
        "had only chosen the first buckles.",
        "never",
    )

    @model_validator(mode="before")
    @classmethod
    def _default_correlation_length(cls, data: Any) -> Any:
        if (
            isinstance(data, Mapping)
            and data.get("kind") == "smoothed"
            and data.get("correlation_length_mm") is None
        ):
            return dict(data) | {"correlation_length_mm": CORRELATION_LENGTH_DEFAULT_MM}
        return data

    @model_validator(mode="after")
    def _correlation_only_if_smoothed(self) -> Imperfection:
        if self.kind != "smoothed" and self.correlation_length_mm is not None:
            raise ValueError(
                f"imperfection.correlation_length_mm is given, but a {self.kind} imperfection has "
                "no correlation length; remove it, or set imperfection.kind: smoothed."
            )
        return self


class RingMove(Section):
    """One move of the top ring: what is not named stays as it is."""

    shorten_percent: float | None = unit_field(
        "% of the shortening",
        "Where the ring goes, in per cent of the way that closes the gap: `125` is a quarter "
        "further, `0` pulls the foil straight.",
        None,
        ge=-1000,
        le=1000,
    )
    tilt_mrad: float | None = unit_field(
        "mrad", "Tilt of the ring about an axis across it.", None, ge=-500, le=500
    )
    twist_mrad: float | None = unit_field(
        "mrad", "Turn of the ring about its own axis.", None, ge=-1000, le=1000
    )
    shift_mm: float | None = unit_field(
        "mm", "Shift of the ring across the axis of the foil.", None, ge=-10_000, le=10_000
    )
    cycles: int = unit_field(
        "1",
        "How often the ring goes there and back to where it was; with 0 it goes there and stays.",
        0,
        ge=0,
        le=100,
    )
    release: bool = unit_field(
        "truth value",
        "Lets go of the ring instead, which springs along the axis to the free height of the foil.",
        False,
    )

    @model_validator(mode="after")
    def _says_one_thing(self) -> RingMove:
        places = (self.shorten_percent, self.tilt_mrad, self.twist_mrad, self.shift_mm)
        goes = any(place is not None for place in places)
        if self.release and (goes or self.cycles):
            raise ValueError(
                "installation.moves has a move with release: true and a place beside it; write two "
                "moves."
            )
        if not (goes or self.release):
            raise ValueError(
                "installation.moves has a move without a place; give it one, such as "
                "{shorten_percent: 125}, or {release: true}."
            )
        return self


class Installation(Section):
    """How the foil is fitted: what the top ring does before it comes to the gap."""

    moves: tuple[RingMove, ...] = unit_field(
        "list",
        "Moves of the top ring before it comes to the gap and stands straight, in turn, each a "
        "mapping of the keys below: `[{shorten_percent: 125}]` pushes a quarter further and pulls "
        "back, `[{shorten_percent: 100}, {shorten_percent: 105, cycles: 3}]` cycles. The foil "
        "comes near to rest after each. Needs `method.path: installation`.",
        (),
        max_length=50,
        strict=False,
    )
    waiting_hours: float = unit_field(
        "h",
        "Time that the foil stands in the gap before it is measured, in which its stress relaxes "
        "by `material.relaxation_per_decade`.",
        0.0,
        ge=0,
        le=1e7,
    )


class Relaxation(Section):
    """Dynamic relaxation: ramp of the moving ring, then relaxation to equilibrium."""

    ramp_steps: int | None = unit_field(
        "steps",
        "Steps in which the top ring closes the gap. Left out, `ramp_slowness` decides.",
        None,
        ge=10,
        le=RAMP_STEPS_MAX,
    )
    ramp_slowness: float | None = unit_field(
        "steps",
        "Those steps for each unit of radius over thickness, as thin foil moves slowly; only where "
        f"`ramp_steps` is left out. In fewer than {STANDARD.ramp_slowness:g} foil may come out too "
        "stiff axially. " + tier_words("relaxation.ramp_slowness"),
        None,
        gt=0,
        le=10_000,
    )
    relaxation_steps_max: int | None = unit_field(
        "steps",
        "Most explicit steps after the ramp; what still moves then is minimised with its tangent, "
        "which is slower. Left out: seven for each step of the ramp, at most 70 for each unit of "
        "radius over thickness, at least 14000.",
        None,
        ge=0,
        le=REST_STEPS_MAX,
    )
    switch_residual: float = unit_field(
        "1",
        "Residual at which relaxation gives way to minimisation with the tangent.",
        1e-3,
        gt=0,
        lt=1,
    )
    residual_tolerance: float = unit_field(
        "1", "Free force norm over ring force norm, at equilibrium.", 1e-8, gt=0, lt=1
    )
    check_interval: int = unit_field(
        "steps", "Steps between two checks for equilibrium and entries of the history.", 20, ge=1,
        le=1000,
    )  # fmt: skip

    @model_validator(mode="before")
    @classmethod
    def _default_slowness(cls, data: Any) -> Any:
        if (
            isinstance(data, Mapping)
            and data.get("ramp_steps") is None
            and data.get("ramp_slowness") is None
        ):
            return dict(data) | {"ramp_slowness": STANDARD.ramp_slowness}
        return data

    @model_validator(mode="after")
    def _steps_or_slowness(self) -> Relaxation:
        if self.ramp_steps is not None and self.ramp_slowness is not None:
            raise ValueError(
                "relaxation.ramp_slowness is given, but relaxation.ramp_steps settles the ramp; "
                "remove one of them."
            )
        return self

    def resolved(self, slenderness: float) -> Relaxation:
        """That of a foil of one R/t, the steps of its ramp and after it numbers."""
        steps, most = self.ramp_steps, self.relaxation_steps_max
        if steps is None:
            steps = pace.ramp_steps(slenderness, self.ramp_slowness)
            steps = min(max(RAMP_STEPS_MIN, steps), RAMP_STEPS_MAX)
        if most is None:
            most = min(pace.rest_steps(steps, slenderness), REST_STEPS_MAX)
        numbers = {"ramp_steps": steps, "ramp_slowness": None, "relaxation_steps_max": most}
        return self.model_copy(update=numbers)


class Method(Section):
    """Strategies of crumpling; each is recorded with its numbers in every result."""

    path: choice_of(PATHS) = registry_field(PATHS, "relaxation")
    mass: choice_of(MASSES) = registry_field(MASSES, "spectral")
    damping: choice_of(DAMPINGS) = registry_field(DAMPINGS, "adaptive_viscous")
    search: choice_of(SEARCHES) = registry_field(SEARCHES, "quasi_newton")
    stress_removal: choice_of(STRESS_REMOVALS) = registry_field(STRESS_REMOVALS, "reset")
    retries: int = unit_field(
        "1",
        "Further attempts at a crumple that has diverged, not converged, folded as a whole or come "
        "to a saddle, each with safer settings: the spectral mass with more safety, "
        "`adaptive_viscous`, a slower spread ramp. Which attempt a crumple is of is recorded as "
        "`attempt`. By default a failure is flagged and stays one.",
        0,
        ge=0,
        le=3,
    )


Direction = Literal["axial", "radial"]


class Stiffness(Section):
    """Static stiffness between the end rings."""

    unsaid_if_empty = ("one_sided",)

    error_percent: float | None = unit_field(
        "%",
        "Largest mesh error of the stress-free stiffness of the crumpled shape, axial and radial, "
        "by its own estimate: the shape is refined until that meets it and no further, "
        "`refinements` times at most; the estimate is measured for the corner element. "
        "If that number is given and this is not, the shape is "
        "refined so often. " + tier_words("stiffness.error_percent"),
        None,
        ge=0.01,
        le=20,
    )
    refinements: int = unit_field(
        "1",
        "Exact refinements of the crumpled shape, each halving the elements, for the mesh error "
        "of the stress-free stiffness; with 2 it is extrapolated. With `error_percent` the most "
        "that are made, fewer where elements would become too many.",
        2,
        ge=0,
        le=3,
    )
    relaxed_refinements: int = unit_field(
        "1",
        "Refinements after which the crumple is relaxed again, for the pre-stressed stiffness; "
        "each costs more than the crumple itself.",
        0,
        ge=0,
        le=2,
    )
    one_sided: tuple[Direction, ...] = unit_field(
        "list",
        "Directions of `stiffness_loading` and `stiffness_unloading`: the top ring is moved by a "
        "fiftieth of the thickness one way and the other, what yields, touches and rubs following; "
        "clamps hold. For foil that may yield or touch itself. Left out, none is computed.",
        (),
        max_length=2,
        strict=False,
    )


class Amplitude(Section):
    """How far the stiffness holds: amplitude at which that of the foil as it is changes by 1 %."""

    directions: tuple[Direction, ...] = unit_field(
        "list",
        "Directions of `amplitude_1_percent`: the top ring is moved there and back, up to 1 mm. At "
        "elements of 5 mm it takes 5 to 15 s a direction of a realisation. Left out, none is "
        "computed.",
        (),
        max_length=2,
        strict=False,
    )


class Dynamics(Section):
    """Dynamic stiffness between the end rings."""

    unsaid_if_empty = ("contacts",)

    reduction: choice_of(REDUCTIONS) = registry_field(
        REDUCTIONS, "rational_krylov", "How the foil is reduced. "
    )
    tolerance: float = unit_field(
        "1",
        "Largest relative error of the reduction in the shown band, by its own estimate; beyond "
        "the frequency up to which the estimate meets it, the dynamic stiffness is left out. "
        + tier_words("dynamics.tolerance"),
        STANDARD.reduction_tolerance,
        ge=1e-6,
        lt=1,
    )
    cutoff_hz: float | None = unit_field(
        "Hz",
        "Modes up to this frequency are kept, only for `hintz_herting` and `craig_bampton`; there "
        "the default is twice `shown_max_hz`, raised until the tolerance is met.",
        None,
        gt=0,
        le=1e6,
    )
    shown_min_hz: float = unit_field("Hz", "Lowest frequency computed.", 1.0, ge=0.01, le=1e6)
    shown_max_hz: float = unit_field("Hz", "Highest frequency computed.", 800.0, gt=0, le=1e6)
    frequencies: int = unit_field(
        "1", "Number of frequencies, spaced logarithmically.", 200, ge=2, le=100_000
    )
    damping: choice_of(STRUCTURAL_DAMPINGS) = registry_field(STRUCTURAL_DAMPINGS, "modal")
    damping_percent: float = unit_field("%", "Share of the critical damping.", 5.0, gt=0, lt=100)
    rayleigh_hz: tuple[Frequency, Frequency] | None = unit_field(
        "list of Hz", "Two frequencies, rising, only for `rayleigh` damping.", None, strict=False
    )
    eigenfrequencies: int = unit_field(
        "1", "Number of eigenfrequencies with both rings clamped.", 20, ge=1, le=1000
    )
    mode_shapes: int = unit_field(
        "1", "Mode shapes of these that are kept, for the report and other tools.", 6, ge=0, le=100
    )
    contacts: tuple[Literal[CLOSED_CONTACTS], ...] = unit_field(
        "list",
        "What closed contacts do in dynamic stiffnesses beside the one in which they are open: "
        "springs along their gaps as stiff as the barrier (`normal`), rigid ones (`rigid`), or "
        "rigid in all directions (`stuck`). Each takes one more reduction.",
        (),
        max_length=len(CLOSED_CONTACTS),
        strict=False,
    )

    @model_validator(mode="after")
    def _fits_together(self) -> Dynamics:
        problems = []
        if self.shown_min_hz >= self.shown_max_hz:
            problems.append(
                f"dynamics.shown_min_hz is {self.shown_min_hz:g} Hz, which is not below "
                f"dynamics.shown_max_hz ({self.shown_max_hz:g} Hz); lower the first or raise the "
                "second."
            )
        if self.cutoff_hz is not None and not REDUCTIONS.choice(self.reduction).has_cutoff:
            problems.append(
                f"dynamics.cutoff_hz is given, but the reduction {self.reduction} has no cut-off; "
                "remove it, or set dynamics.reduction: hintz_herting."
            )
        elif self.cutoff_hz is not None and self.cutoff_hz < self.shown_max_hz:
            problems.append(
                f"dynamics.cutoff_hz is {self.cutoff_hz:g} Hz, below the shown band, which ends at "
                f"dynamics.shown_max_hz ({self.shown_max_hz:g} Hz); raise the cut-off (to "
                f"{2 * self.shown_max_hz:g} Hz, say), remove it, or lower shown_max_hz."
            )
        problems += self._rayleigh_problems()
        if problems:
            raise ValueError("\n".join(problems))
        return self

    def _rayleigh_problems(self) -> list[str]:
        wanted, given = self.damping == "rayleigh", self.rayleigh_hz is not None
        if wanted != given:
            return [
                "dynamics.rayleigh_hz goes with dynamics.damping: rayleigh, e.g. [20, 800]; "
                f"{'give' if wanted else 'remove'} it."
            ]
        if given and self.rayleigh_hz[0] >= self.rayleigh_hz[1]:
            return [
                f"dynamics.rayleigh_hz is {list(self.rayleigh_hz)} Hz; give two positive, rising "
                "frequencies."
            ]
        return []


class MeasuredRun(Section):
    """A measured dynamic stiffness from a file, and what it is of."""

    file: str = unit_field(
        "text",
        "CSV, MAT or Universal File as for `foilstudy compare`, with its units; a relative path is "
        "from the folder with the Snakefile.",
        **TEXT,
    )
    thickness_um: float | None = unit_field(
        "um", "One of the sweep; may be left out where there is one only.", None, gt=0, le=1e6
    )
    height_mm: float | None = unit_field(
        "mm", "Reference height, one of the sweep; likewise.", None, gt=0, le=HEIGHT_MAX_MM
    )
    direction: Direction = unit_field("choice", "Of the motion.", "axial")
    definition: Literal["transfer", "driving", "relative"] = unit_field(
        "choice", "Which dynamic stiffness it is.", "transfer"
    )
    function: str | None = unit_field(
        "text", "Part of the name of the response, where the file holds several.", None, **TEXT
    )


class Report(Section):
    """The report page."""

    unsaid_if_empty = ("measured",)

    title: str = unit_field("text", "Title of the report.", "Stiffness of crumpled foil", **TEXT)
    confidence_percent: float | None = unit_field(
        "%",
        "Half width of the 95 % interval of the mean stiffness, over that mean, that is wished for "
        f"at every thickness and height; with `sweep.realisations: auto` "
        f"{CONFIDENCE_DEFAULT_PERCENT:g} if left out.",
        None,
        ge=0.1,
        le=1000,
    )
    measured: tuple[MeasuredRun, ...] = unit_field(
        "list",
        "Measurements that the page draws beside the simulated stiffness of their configurations, "
        "each a mapping of the keys below: `[{file: axial.csv, thickness_um: 500, height_mm: "
        "170}]`. The page alone depends on them.",
        (),
        max_length=50,
        strict=False,
    )
