"""Models of the foil as data, such as those of ``config/real.yaml``, and trials of them.

Cheap to import.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any, TypeVar

import pydantic

from foilstudy.config.accuracy import completed
from foilstudy.config.sections import Section
from foilstudy.config.sources import merged
from foilstudy.study.settings import content_digest, read_settings

FOLDER = Path(__file__).resolve().parents[4] / "config"
"""Beside the sources: a package without them has no workflow, either."""

_List = {"strict": False}
Sections = dict[str, Any]
"""Of a configuration, and its word of accuracy."""
Measured = TypeVar("Measured")


@dataclass(frozen=True)
class Trial:
    """One foil by one model.

    Attributes
    ----------
    step : str
        Name of the model.
    content : str
        Digest of its sections, as another content is another case; the study that it is of, if any.
    thickness_um, height_mm, seed : int
    """

    step: str
    content: str
    thickness_um: int
    height_mm: int
    seed: int


class Step(Section):
    """A model of the foil.

    Attributes
    ----------
    name, words : str
        In file names and for people.
    after : str or None
        The step whose sections it has besides its own.
    sections : mapping
        Of a study's configuration.
    beside : str or None
        The step above that it is held against, foil by foil, where a study does that.
    thickness_um, reference_height_mm : tuple of int or None
        Of the foils that it is computed for; None for all.
    seeds : int or None
        Of them; None for as many as elsewhere.
    """

    name: str = pydantic.Field(pattern=r"^[A-Za-z0-9_]+$")
    words: str
    after: str | None = None
    beside: str | None = None
    sections: Sections = {}
    thickness_um: tuple[int, ...] | None = pydantic.Field(None, **_List)
    reference_height_mm: tuple[int, ...] | None = pydantic.Field(None, **_List)
    seeds: int | None = pydantic.Field(None, ge=1)


class Studied(Section):
    """A model whose trials are realisations of studies.

    Attributes
    ----------
    name, words : str
        As of a step.
    studies : tuple of str
        Their names; no two have a realisation of one foil and seed.
    """

    name: str = pydantic.Field(pattern=r"^[A-Za-z0-9_]+$")
    words: str
    studies: tuple[str, ...] = pydantic.Field(**_List, min_length=1)


class Ladder(Section):
    """All models, and the foils that they are computed for."""

    thickness_um: tuple[int, ...] = pydantic.Field(**_List)
    reference_height_mm: tuple[int, ...] = pydantic.Field(**_List)
    seeds: int = pydantic.Field(ge=1)
    sections: Sections
    steps: tuple[Step, ...] = pydantic.Field(**_List)
    studied: tuple[Studied, ...] = pydantic.Field((), **_List)

    @pydantic.model_validator(mode="after")
    def _in_order(self) -> Ladder:
        known: set[str] = set()
        for step in self.steps:
            if step.name in known:
                raise ValueError(f"two steps are called {step.name!r}; rename one")
            for word, other in (("comes after", step.after), ("stands beside", step.beside)):
                if other is not None and other not in known:
                    raise ValueError(
                        f"step {step.name!r} {word} {other!r}, which is none of the steps above it"
                    )
            known.add(step.name)
        for entry in self.studied:
            if entry.name in known:
                raise ValueError(f"two models are called {entry.name!r}; rename one")
            known.add(entry.name)
        foils = {step.name: set(self._foils(step)) for step in self.steps}
        for step in self.steps:
            if step.beside and not foils[step.name] <= foils[step.beside]:
                thickness, height = min(foils[step.name] - foils[step.beside])
                raise ValueError(
                    f"step {step.name!r} has foil of {thickness} um and {height} mm, which "
                    f"{step.beside!r}, beside which it stands, has not; add it there"
                )
        return self

    def _foils(self, step: Step) -> Iterator[tuple[int, int]]:
        return product(
            step.thickness_um or self.thickness_um,
            step.reference_height_mm or self.reference_height_mm,
        )

    def sections_of(self, name: str) -> Sections:
        """Sections of a step, those that it takes over among them."""
        step = next(step for step in self.steps if step.name == name)
        inherited = self.sections if step.after is None else self.sections_of(step.after)
        return merged([inherited, step.sections])

    def trials(self) -> Iterator[Trial]:
        """Of every step, every foil."""
        for step in self.steps:
            content = content_digest(_meant(self.sections_of(step.name)))
            for foil in self._foils(step):
                for seed in range(step.seeds or self.seeds):
                    yield Trial(step.name, content, *foil, seed)


def _meant(sections: Sections) -> Sections:
    """With what a word of accuracy stands for: with another meaning it is another model."""
    return completed(sections) if "accuracy" in sections else sections


@cache
def ladder(study: str) -> Ladder | None:
    """Models of a side study; None in an installed package, which has no such file beside it."""
    file = FOLDER / f"{study}.yaml"
    return read_settings(file, Ladder) if file.is_file() else None


def trials(study: str) -> tuple[Trial, ...]:
    """All trials of a side study; none in an installed package."""
    models = ladder(study)
    return () if models is None else tuple(models.trials())


def cube_of(study: str) -> Path:
    """Where a study of this repository has its cube."""
    return FOLDER.parent / "results" / study / "cube.nc"


def by_foil(measured: Mapping[Trial, Measured]) -> dict[tuple[str, int, int], list[Measured]]:
    """What was measured of every seed, by step, thickness (um) and height (mm)."""
    foils: dict[tuple[str, int, int], list[Measured]] = {}
    for trial, each in measured.items():
        foils.setdefault((trial.step, trial.thickness_um, trial.height_mm), []).append(each)
    return foils
