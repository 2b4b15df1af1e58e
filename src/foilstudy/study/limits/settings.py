"""The methods of the map, as data: ``config/limits.yaml``; cheap to import."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pydantic

from foilstudy.base.errors import ConfigError
from foilstudy.config.sections import Section
from foilstudy.study.changes import Value
from foilstudy.study.settings import content_digest, read_settings

FILE = Path(__file__).resolve().parents[4] / "config/limits.yaml"
"""Beside the sources: a package without them has no workflow, either."""

DEFAULT = "default"
"""The method that nothing is changed of, to which all others are compared."""

_List = {"strict": False}
_SLUG = re.compile(r"[^A-Za-z0-9.+]+")


class MappedFoil(Section):
    """A foil of the map and the mesh it is crumpled on."""

    thickness_um: int
    height_mm: int
    size_mm: float
    seeds: int = pydantic.Field(ge=1)
    groups: tuple[str, ...] | None = pydantic.Field(None, **_List)
    """Those that are tried on it; all if it is left out."""


class Mapped(Section):
    """A method and what is varied of it.

    Attributes
    ----------
    group : str
        Methods of one group stand together in the map.
    method : str
        What it is called there.
    set : mapping
        Values by their places in a `foilstudy.pipeline.crumpled.Recipe`, in this order.
    vary : str or None
        A further place; one ending in ``_over_t`` counts in thicknesses of the foil.
    values : tuple
        Of that place, a row of the map each.
    seeds, only_um : optional
        Where it takes long: most trials on a foil, and the foils it is tried on.
    """

    group: str
    method: str
    set: dict[str, Value] = {}
    vary: str | None = None
    values: tuple[Value, ...] = pydantic.Field((), **_List)
    seeds: int | None = pydantic.Field(None, ge=1)
    only_um: tuple[int, ...] | None = pydantic.Field(None, **_List)


class Way(Section):
    """A way to measure a stiffness: a name, and an entry of ``STIFFNESS_MEASURES`` with values."""

    name: str
    measure: str
    set: dict[str, Value | list[float]] = {}


class MeasuredFoil(Section):
    """A foil whose crumples are measured in every way."""

    thickness_um: int
    height_mm: int
    size_mm: float
    seeds: int = pydantic.Field(ge=1)
    ramp_steps: tuple[int, ...] = pydantic.Field((), **_List)
    """Beside that of the map."""


class Measures(Section):
    """Ways to measure, and what is measured."""

    foils: tuple[MeasuredFoil, ...] = pydantic.Field(**_List)
    ways: tuple[Way, ...] = pydantic.Field(**_List)


class VibratingFoil(Section):
    """A foil whose dynamics are reduced with too low a cut-off."""

    thickness_um: int
    height_mm: int
    size_mm: float
    cutoff_hz: float
    seeds: int = pydantic.Field(ge=1)


class QuarteredFoil(Section):
    """A foil of which a quarter is followed along its equilibria."""

    thickness_um: int
    height_mm: int
    size_mm: float
    amplitudes_um: tuple[float, ...] = pydantic.Field(**_List)


class FollowedWay(Section):
    """A path by continuation, and the surface of an arc length."""

    path: str
    surface: str | None = None


class Bounds(Section):
    """What is reduced beyond its band, and which paths are followed on a quarter."""

    vibrating: tuple[VibratingFoil, ...] = pydantic.Field(**_List)
    quarters: tuple[QuarteredFoil, ...] = pydantic.Field(**_List)
    ways: tuple[FollowedWay, ...] = pydantic.Field(**_List)
    budget: int = pydantic.Field(ge=1)


class Limits(Section):
    """All that is tried, in full and in the corner that takes minutes.

    `ramp_slowness` is that of the default, and of every method that does not change the ramp.
    """

    ramp_slowness: float = pydantic.Field(gt=0)
    foils: tuple[MappedFoil, ...] = pydantic.Field(**_List)
    quick: tuple[MappedFoil, ...] = pydantic.Field(**_List)
    methods: tuple[Mapped, ...] = pydantic.Field(**_List)
    measures: Measures
    bounds: Bounds


@dataclass(frozen=True)
class Setting:
    """One row of the map.

    Attributes
    ----------
    group, method : str
    value : str
        Of what is varied; empty where nothing is.
    changes : tuple of (place, value)
    seeds : int or None
        Most trials on a foil.
    only_um : tuple of int or None
        Thicknesses of the foils that it is tried on; None for all.
    """

    group: str
    method: str
    value: str
    changes: tuple[tuple[str, Value], ...]
    seeds: int | None = None
    only_um: tuple[int, ...] | None = None

    @property
    def name(self) -> str:
        """Part of file names: in words, with a digest of the changes behind it."""
        words = _SLUG.sub("_", f"{self.method} {self.value}").strip("_")
        return f"{words}-{content_digest(self.changes)}"

    @property
    def words(self) -> str:
        """For people."""
        return f"{self.method}, {self.value}" if self.value else self.method


def settings_of(limits: Limits) -> Iterator[Setting]:
    """Every row of the map, in its order."""
    for one in limits.methods:
        fixed = tuple(one.set.items())
        if one.vary is None:
            yield Setting(one.group, one.method, "", fixed, one.seeds, one.only_um)
        for value in one.values:
            shown = f"{value:g}" if isinstance(value, float) else str(value)
            changes = (*fixed, (one.vary, value))
            yield Setting(one.group, one.method, shown, changes, one.seeds, one.only_um)


def read_limits(path: Path) -> Limits:
    """The methods in a file.

    Raises
    ------
    ConfigError
        If it cannot be read or is of another form, or has no method without changes.
    """
    limits = read_settings(path, Limits)
    if not any(s.method == DEFAULT and not s.changes for s in settings_of(limits)):
        raise ConfigError(
            f"{path}: methods: none is called {DEFAULT!r}; add one without changes, to which the "
            "others are compared."
        )
    return limits
