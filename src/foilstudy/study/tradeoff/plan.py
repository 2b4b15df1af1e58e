"""Which settings are charted, and in what."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from foilstudy.study.kernel.plan import Lazy, Part, Study
from foilstudy.study.published import CrumpleCase
from foilstudy.study.settings import read_settings
from foilstudy.study.tradeoff.settings import FILE, Family, Point, Settings


@dataclass(frozen=True)
class Ladder:
    """Points that are held against one truth, a row of panels.

    Attributes
    ----------
    part : str
        That measures them.
    default : Point
    families : tuple of Family
    reference : Point or None
        Of an ensemble: the point that counts as true.
    """

    part: str
    default: Point
    families: tuple[Family, ...]
    reference: Point | None = None

    @property
    def name(self) -> str:
        """For example ``ensembles, 500 um``."""
        thickness = self.default.thickness_um
        return self.part if thickness is None else f"{self.part}, {thickness} um"

    def true(self, family: Family) -> Point | None:
        """The point that counts as true for a family of an ensemble."""
        if family.reference is None:
            return self.reference
        return self.default.at(family, family.reference)

    @property
    def points(self) -> tuple[Point, ...]:
        """The default, the reference, and those of all families, each once."""
        found = [self.default, *([self.reference] if self.reference else [])]
        found += [point for family in self.families for point in self.default.points(family)]
        return tuple(dict.fromkeys(found))


def _ladders(settings: Settings) -> Iterator[Ladder]:
    yield Ladder("panel", Point(), settings.panel)
    frozen = settings.frozen
    for thickness in frozen.thickness_um:
        default = Point(thickness, frozen.height_mm, frozen.size_mm)
        yield Ladder("static", default, frozen.static)
        yield Ladder("dynamic", default, frozen.dynamic)
    for one in settings.ensembles:
        default = Point(one.thickness_um, one.height_mm, one.size_mm, one.seeds)
        family = Family(
            family="reference", change=one.reference.change, values=(one.reference.value,)
        )
        (reference,) = default.points(family)
        yield Ladder("ensembles", default, one.settings, reference)


# an installed package has no workflow, and no settings beside it
_SETTINGS = read_settings(FILE, Settings) if FILE.is_file() else None
LADDERS = tuple(_ladders(_SETTINGS)) if _SETTINGS else ()
RESOLVED = tuple(
    CrumpleCase("corner", one.thickness_um, one.height_mm, one.size_mm, 0)
    for one in (_SETTINGS.adaptive if _SETTINGS else ())
)
"""Crumples of which it is asked what an adaptive mesh would save."""


def shape_of(point: Point) -> CrumpleCase:
    """The crumple whose shape a point of a frozen ladder measures."""
    return CrumpleCase("corner", point.thickness_um, point.height_mm, point.size_mm, 0)


def _points(part: str) -> tuple[Point, ...]:
    return tuple(point for ladder in LADDERS if ladder.part == part for point in ladder.points)


def _needed(point: Point) -> tuple[CrumpleCase, ...]:
    return (shape_of(point),)


_HERE = "foilstudy.study.tradeoff"

STUDY = Study(
    name="tradeoff",
    title="speed against accuracy",
    parts=(
        Part("truth", ("panel",), Lazy(f"{_HERE}.panel:truth"), memory_mb=2000),
        Part(
            "shapes",
            tuple(dict.fromkeys(map(shape_of, _points("static")))),
            Lazy(f"{_HERE}.frozen:shape"),
            arrays=("points",),
            memory_mb=10_000,
        ),
        # what is timed goes first, while the processor is as it was
        Part("ensembles", _points("ensembles"), Lazy(f"{_HERE}.ensembles:measure"), priority=3),
        Part("panel", _points("panel"), Lazy(f"{_HERE}.panel:measure"), priority=2),
        Part(
            "static",
            _points("static"),
            Lazy(f"{_HERE}.frozen:static"),
            needs={"shapes": _needed},
            memory_mb=10_000,
        ),
        Part(
            "dynamic",
            _points("dynamic"),
            Lazy(f"{_HERE}.frozen:dynamic"),
            needs={"shapes": _needed},
            memory_mb=3000,
        ),
        Part(
            "adaptive",
            RESOLVED,
            Lazy(f"{_HERE}.adaptive.measure:measure"),
            arrays=("levels",),
            memory_mb=3000,
        ),
        Part("steps", ("all",), Lazy("foilstudy.study.convergence.timing:run_timing")),
    ),
    findings=Lazy(f"{_HERE}.points:gathered"),
    tables={
        "tradeoff.csv": Lazy(f"{_HERE}.tables:rows"),
        "tradeoff.md": Lazy(f"{_HERE}.tables:page"),
        "adaptive.csv": Lazy(f"{_HERE}.adaptive.present:rows"),
    },
    figures={
        **{name: Lazy(f"{_HERE}.figures:{name}") for name in ("panel", "static", "dynamic")},
        **{
            f"ensemble_{ladder.default.thickness_um}um": Lazy(
                f"{_HERE}.figures:ensemble", (ladder.name,)
            )
            for ladder in LADDERS
            if ladder.part == "ensembles"
        },
        "run_time": Lazy(f"{_HERE}.figures:run_time"),
        "adaptive": Lazy(f"{_HERE}.adaptive.present:figure"),
    },
)
