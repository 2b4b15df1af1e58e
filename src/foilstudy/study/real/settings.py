"""The models of the real foil, as data: ``config/real.yaml``; cheap to import."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pydantic

from foilstudy.config.sections import Section
from foilstudy.config.sources import merged

FILE = Path(__file__).resolve().parents[4] / "config/real.yaml"
"""Beside the sources: a package without them has no workflow, either."""

_List = {"strict": False}
Sections = dict[str, dict[str, Any]]


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
    thickness_um : tuple of int or None
        Of the foils that it is computed for; None for all.
    """

    name: str = pydantic.Field(pattern=r"^[A-Za-z0-9_]+$")
    words: str
    after: str | None = None
    sections: Sections = {}
    thickness_um: tuple[int, ...] | None = pydantic.Field(None, **_List)


class Ladder(Section):
    """All models, and the foils that they are computed for."""

    thickness_um: tuple[int, ...] = pydantic.Field(**_List)
    reference_height_mm: tuple[int, ...] = pydantic.Field(**_List)
    seeds: int = pydantic.Field(ge=1)
    sections: Sections
    steps: tuple[Step, ...] = pydantic.Field(**_List)

    @pydantic.model_validator(mode="after")
    def _in_order(self) -> Ladder:
        known: set[str] = set()
        for step in self.steps:
            if step.name in known:
                raise ValueError(f"two steps are called {step.name!r}; rename one")
            if step.after is not None and step.after not in known:
                raise ValueError(
                    f"step {step.name!r} comes after {step.after!r}, which is none of the steps "
                    "above it"
                )
            known.add(step.name)
        return self

    def sections_of(self, name: str) -> Sections:
        """Sections of a step, those that it takes over among them."""
        step = next(step for step in self.steps if step.name == name)
        inherited = self.sections if step.after is None else self.sections_of(step.after)
        return merged([inherited, step.sections])
