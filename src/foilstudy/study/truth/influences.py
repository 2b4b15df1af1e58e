"""Stiffness by one way of crumpling over that by another, each a mean of its seeds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from foilstudy.base.confidence import MeanInterval, Ratio
from foilstudy.base.tables import markdown_table
from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.study.kernel.plan import Records
from foilstudy.study.real.laws import STATES, number
from foilstudy.study.real.settings import Step, Trial, ladder
from foilstudy.study.truth.plan import NAME

SHOWN = ("with its stresses", "stress-free")
"""States of the foil, the true one first."""


@dataclass(frozen=True)
class Influence:
    """One way of crumpling a foil, and the one that it stands beside.

    Attributes
    ----------
    step, words, beside : str
        Names of both, `words` for people; `beside` is empty for what others stand beside.
    thickness_um : int
    state, direction : str
    mean : MeanInterval
        Stiffness of the seeds, N/m.
    ratio : Ratio or None
        Of that mean to the one beside it.
    """

    step: str
    words: str
    beside: str
    thickness_um: int
    state: str
    direction: str
    mean: MeanInterval
    ratio: Ratio | None


@dataclass(frozen=True, eq=False)
class Found:
    """What came out: the records, and what follows."""

    records: dict[Trial, dict]
    influences: tuple[Influence, ...]


def found(records: Records) -> Found:
    """Means of every way, and their ratios."""
    results = {trial: record.result for trial, record in records["trials"].items()}
    return Found(results, tuple(_influences(results)))


def _influences(results: dict[Trial, dict]) -> Iterator[Influence]:
    models = ladder(NAME)
    for step in models.steps:
        for thickness in step.thickness_um or models.thickness_um:
            for state in SHOWN:
                for k, direction in enumerate(DIRECTIONS):
                    mean = _mean(results, step.name, thickness, state, k)
                    yield Influence(
                        step.name,
                        step.words,
                        step.beside or "",
                        thickness,
                        state,
                        direction,
                        mean,
                        _ratio(mean, results, step, thickness, state, k),
                    )


def _mean(results: dict[Trial, dict], step: str, thickness: int, state: str, k: int):
    return MeanInterval.of(
        [
            number(result, STATES[state], k)
            for trial, result in results.items()
            if (trial.step, trial.thickness_um) == (step, thickness)
        ]
    )


def _ratio(
    mean: MeanInterval, results: dict[Trial, dict], step: Step, thickness: int, state: str, k: int
) -> Ratio | None:
    if step.beside is None:
        return None
    return Ratio.of(mean, _mean(results, step.beside, thickness, state, k))


def table(found: Found) -> list[dict]:
    """A row for each way, thickness, state and direction."""
    return [
        {
            "step": each.step,
            "beside": each.beside,
            "thickness_um": each.thickness_um,
            "state": each.state,
            "direction": each.direction,
            "seeds": each.mean.n,
            "mean_n_per_m": each.mean.mean,
            "low": each.mean.low,
            "high": each.mean.high,
            "cv": each.mean.cv,
            "ratio": each.ratio.value if each.ratio else np.nan,
            "ratio_low": each.ratio.low if each.ratio else np.nan,
            "ratio_high": each.ratio.high if each.ratio else np.nan,
        }
        for each in found.influences
    ]


def page(found: Found) -> str:
    """The same for people: a row for each way and thickness."""
    rows: dict[tuple[str, int], list[Influence]] = {}
    for each in found.influences:
        rows.setdefault((each.step, each.thickness_um), []).append(each)
    words = {each.step: each.words for each in found.influences}
    heads = ["way", "thickness, um", "beside"]
    heads += [f"{state}, {direction}, N/m" for state in SHOWN for direction in DIRECTIONS]
    body = [
        [
            words[step],
            thickness,
            words.get(cells[0].beside, ""),
            *(_cell(each) for each in cells),
        ]
        for (step, thickness), cells in rows.items()
    ]
    return markdown_table(heads, body)


def _cell(each: Influence) -> str:
    mean = f"{each.mean.mean:.4g} ({each.mean.low:.4g} to {each.mean.high:.4g}; {each.mean.n})"
    if each.ratio is None:
        return mean
    ratio = each.ratio
    return f"{mean}: **{ratio.value:.2f}** ({ratio.low:.2f} to {ratio.high:.2f})"
