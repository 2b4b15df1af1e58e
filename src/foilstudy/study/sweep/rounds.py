"""How many realisations each configuration takes until its mean is known as well as wished.

A configuration is a thickness with a height. All begin with the same few realisations; after each
round one whose mean is not known well enough gets more, by the scatter that it has shown so far.
What a round asks for follows from the values of the realisations alone: whoever goes through the
rounds again, from records in whatever order they were made, comes to the same realisations.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass
from itertools import count, groupby, islice
from pathlib import Path
from typing import Any, Self

import numpy as np

from foilstudy.base.confidence import MeanInterval
from foilstudy.base.files import json_text, read_json, written_whole
from foilstudy.base.numerals import plural
from foilstudy.base.origin import Origin
from foilstudy.base.outcome import USABLE
from foilstudy.base.record import read_attributes, read_record
from foilstudy.config import Cell, StudyConfig
from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.measure.verdicts import is_fault
from foilstudy.study.sweep.origins import cell_folder, refuse_departure, response_origin

__all__ = [
    "Round",
    "Standing",
    "Wish",
    "answering_values",
    "first_cells",
    "recorded_values",
    "round_job",
    "round_path",
    "rounds",
    "stiffnesses_of",
    "wanted_cells",
]

GROWTH = 2
"""Most that a round multiplies the realisations by: the scatter of few may be a chance."""

STEP = 2
"""Fewest that a round adds: one more seldom is the last one."""

STIFFNESSES = ("static_stiffness", "static_stiffness_converged", "static_stiffness_mesh_error")

Values = Mapping[str, np.ndarray]
"""The `STIFFNESSES` of one realisation by direction, N/m; none of them where it failed."""


def answering_values(plain: np.ndarray, limit: np.ndarray, error: np.ndarray) -> np.ndarray:
    """Stiffnesses of one configuration and direction that answer for it.

    Those in the mesh limit, or on the crumpled mesh where no mesh error is stated.
    """
    return limit if np.isfinite(error).any() else plain


@dataclass(frozen=True)
class Wish:
    """What ends the rounds of a configuration.

    Attributes
    ----------
    half_width : float
        Of the 95 % interval of the mean, over the mean, in each direction.
    most : int
        Realisations, those that failed among them.
    """

    half_width: float
    most: int

    @classmethod
    def of(cls, study: StudyConfig) -> Self:
        """That of a study whose realisations grow in rounds."""
        return cls(study.report.confidence_percent / 100, study.sweep.most)


@dataclass(frozen=True)
class Standing:
    """One configuration after a round.

    Attributes
    ----------
    made : int
        Realisations.
    usable : int
        Those with a stiffness; the others do not count, but they stay.
    half_width : float
        Of the interval of the mean over the mean, in the direction where it is larger.
    takes : float
        Usable realisations that the present scatter takes for the wish.
    wanted : int
        Realisations after the next round; those `made` where there are enough, or as many as there
        may be, or where none left a stiffness and more would hardly.
    """

    made: int
    usable: int
    half_width: float
    takes: float
    wanted: int

    @classmethod
    def of(cls, values: list[Values], wish: Wish) -> Self:
        """Of the realisations of a configuration so far."""
        means = [MeanInterval.of(sample) for sample in _samples(values)]
        made, usable = len(values), min(mean.n for mean in means)
        half_width = max(mean.half_width for mean in means)
        takes = max(mean.values_for(wish.half_width) for mean in means)
        if half_width <= wish.half_width or usable == 0:
            return cls(made, usable, half_width, takes, made)
        more = max(STEP, takes - usable)
        wanted = min(wish.most, GROWTH * made, made + more)
        return cls(made, usable, half_width, takes, max(made, int(wanted)))


def _samples(values: list[Values]) -> list[np.ndarray]:
    """Stiffness of the usable realisations, for each direction."""
    nothing = np.full(len(DIRECTIONS), np.nan)
    plain, limit, error = (
        np.array([each.get(name, nothing) for each in values]) for name in STIFFNESSES
    )
    return [answering_values(*parts) for parts in zip(plain.T, limit.T, error.T, strict=True)]


Configuration = tuple[str, str]
"""Ids of thickness and height, as in paths."""


@dataclass(frozen=True)
class Round:
    """All configurations after a round.

    Attributes
    ----------
    number : int
        From zero.
    standings : mapping
    """

    number: int
    wish: Wish
    standings: Mapping[Configuration, Standing]

    @property
    def is_last(self) -> bool:
        """Whether no configuration wants more."""
        return all(each.wanted == each.made for each in self.standings.values())

    @property
    def wanted(self) -> dict[Configuration, int]:
        """Realisations of each configuration after the next round."""
        return {name: each.wanted for name, each in self.standings.items()}

    def cells(self, study: StudyConfig) -> tuple[Cell, ...]:
        """Realisations of the next round and all before it."""
        wanted = self.wanted
        return tuple(c for c in study.cells() if c.seed < wanted[c.thickness_id, c.overlength_id])

    @property
    def sentence(self) -> str:
        """What came of it."""
        met = sum(each.half_width <= self.wish.half_width for each in self.standings.values())
        more = sum(each.wanted - each.made for each in self.standings.values())
        return (
            f"{met} of {plural(len(self.standings), 'configuration')} known to "
            f"{100 * self.wish.half_width:g} %, {more or 'no'} more realisations"
        )

    def text(self) -> str:
        """As a file holds it; the same realisations make the same text."""
        rows = []
        for (thickness, height), each in self.standings.items():
            # four decimals, as other machines have other last bits
            numbers = asdict(each) | {"half_width": round(each.half_width, 4)}
            rows.append({"thickness": thickness, "height": height} | numbers)
        return json_text({"round": self.number, "wish": asdict(self.wish), "configurations": rows})

    @classmethod
    def read(cls, path: str | Path) -> Self:
        """From its file."""
        content = read_json(Path(path))
        standings = {
            (row.pop("thickness"), row.pop("height")): Standing(
                **{name: math.inf if value is None else value for name, value in row.items()}
            )
            for row in content["configurations"]
        }
        return cls(content["round"], Wish(**content["wish"]), standings)


def round_path(results: Path, number: int) -> Path:
    """Where a round lies in the folder of a study."""
    return results / "rounds" / f"{number}.json"


def first_cells(study: StudyConfig) -> tuple[Cell, ...]:
    """Realisations of the first round."""
    return tuple(cell for cell in study.cells() if cell.seed < study.sweep.fewest)


def rounds(study: StudyConfig, values_of: Callable[[Cell], Values]) -> Iterator[Round]:
    """Go through the rounds of a study.

    Parameters
    ----------
    study : StudyConfig
        One whose realisations grow in rounds.
    values_of : callable
        Stiffnesses of a realisation; what it raises ends the rounds.
    """
    wish, cells = Wish.of(study), first_cells(study)
    for number in count():
        standings = {
            name: Standing.of([values_of(cell) for cell in made], wish)
            for name, made in groupby(cells, lambda c: (c.thickness_id, c.overlength_id))
        }
        found = Round(number, wish, standings)
        yield found
        if found.is_last:
            return
        cells = found.cells(study)


def wanted_cells(study: StudyConfig, values_of: Callable[[Cell], Values]) -> tuple[Cell, ...]:
    """Realisations of a study, where their number grows in rounds those after the last one."""
    if not study.sweep.in_rounds:
        return study.cells()
    *_, last = rounds(study, values_of)
    return last.cells(study)


def recorded_values(study: StudyConfig, results: Path, cell: Cell) -> Values:
    """Stiffnesses of a realisation from its record.

    Raises
    ------
    Refusal
        If that is not there, unreadable, or not of this study.
    """
    folder = cell_folder(results, cell)
    values, attributes = read_record(folder / "response.nc")
    crumple = read_attributes(folder / "crumple.nc")
    wanted = response_origin(study.response_task(cell), crumple)
    refuse_departure(folder / "response.nc", Origin.of(attributes), wanted)
    return stiffnesses_of(values, attributes)


def stiffnesses_of(values: Values, attributes: Mapping[str, Any]) -> Values:
    """Those of the content of a ``response.nc``."""
    if attributes["status"] not in USABLE or is_fault(values["verdict"]):
        return {}
    return {name: values[name] for name in STIFFNESSES if name in values}


def round_job(study: StudyConfig, number: int, results: Path, path: Path) -> None:
    """See which configurations want more realisations after a round, and write that down."""
    found = next(islice(rounds(study, lambda c: recorded_values(study, results, c)), number, None))
    with written_whole(path) as partial:
        partial.write_text(found.text(), encoding="utf-8")
    print(found.sentence)
