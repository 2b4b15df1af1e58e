"""What is changed, as data: the families of ``config/tradeoff.yaml``; cheap to import."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

import pydantic

from foilstudy.config.sections import Section
from foilstudy.study.changes import Value, changed

FILE = Path(__file__).resolve().parents[4] / "config/tradeoff.yaml"
"""Beside the sources: a package without them has no workflow, either."""
_List = {"strict": False}

DEFAULT = "default"
"""In place of a setting: nothing is changed."""

Spec = TypeVar("Spec")


class Family(Section):
    """Values of one setting, a panel of the charts.

    Attributes
    ----------
    family : str
        Title; entries of one title share a panel.
    change : str
        Place of the setting in the specification of the ladder: ``path.scheme.mass.safety``. A
        length may end in its unit, ``element_size_mm``.
    values : tuple
        All but the default.
    beside : str or None
        What else is set with each of them: ``reduction.hintz_herting``, place and name.
    held : bool
        Whether a study has this default, so that none of the values may beat it.
    reference : value or None
        Of an ensemble, the one that counts as true in this family instead of the common one, which
        has the default mesh.
    """

    family: str
    change: str
    values: tuple[Value, ...] = pydantic.Field(**_List)
    beside: str | None = None
    held: bool = True
    reference: Value | None = None


class Frozen(Section):
    """Shapes of crumples, and what is changed in measuring them."""

    thickness_um: tuple[int, ...] = pydantic.Field(**_List)
    height_mm: int
    size_mm: float
    static: tuple[Family, ...] = pydantic.Field(**_List)
    dynamic: tuple[Family, ...] = pydantic.Field(**_List)


class Reference(Section):
    """The change that makes the ensemble which counts as true."""

    change: str
    value: Value


class Ensemble(Section):
    """Crumples of one foil by several seeds, and what is changed in crumpling them."""

    thickness_um: int
    height_mm: int
    size_mm: float
    seeds: int = pydantic.Field(ge=2)
    reference: Reference
    settings: tuple[Family, ...] = pydantic.Field(**_List)


class Resolved(Section):
    """A crumple on the mesh that resolves it."""

    thickness_um: int
    height_mm: int
    size_mm: float


class Settings(Section):
    """All that the study changes, and the crumples whose elements are counted."""

    panel: tuple[Family, ...] = pydantic.Field(**_List)
    frozen: Frozen
    ensembles: tuple[Ensemble, ...] = pydantic.Field(**_List)
    adaptive: tuple[Resolved, ...] = pydantic.Field(**_List)


@dataclass(frozen=True)
class Point:
    """One setting of one ladder; what makes the foil is None where the ladder has its own.

    Attributes
    ----------
    thickness_um, height_mm, size_mm, seeds
        Of the foil, its coarsest mesh, and how many crumples there are.
    change, value, beside
        See `Family`.
    """

    thickness_um: int | None = None
    height_mm: int | None = None
    size_mm: float | None = None
    seeds: int | None = None
    change: str = DEFAULT
    value: Value | None = None
    beside: str | None = None

    def applied(self, spec: Spec) -> Spec:
        """The specification of the ladder with this setting changed."""
        if self.beside is not None:
            place, _, name = self.beside.rpartition(".")
            spec = changed(spec, place, name)
        return spec if self.change == DEFAULT else changed(spec, self.change, self.value)

    @property
    def default(self) -> Point:
        """The point of the same ladder at which nothing is changed."""
        return replace(self, change=DEFAULT, value=None, beside=None)

    def at(self, family: Family, value: Value) -> Point:
        """With one value of a family."""
        return replace(self, change=family.change, beside=family.beside, value=value)

    def points(self, family: Family) -> tuple[Point, ...]:
        """Of all values of a family."""
        return tuple(self.at(family, value) for value in family.values)
