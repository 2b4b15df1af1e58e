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
from foilstudy.study.real.settings import Trial, by_foil, ladder
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
    thickness_um, height_mm : int
    state, direction : str
    mean : MeanInterval
        Stiffness of the seeds where it is positive, N/m.
    of : int
        All seeds.
    ratio : Ratio or None
        Of that mean to the one beside it; none where a seed of either has no positive stiffness, as
        the mean of the others says nothing then.
    """

    step: str
    words: str
    beside: str
    thickness_um: int
    height_mm: int
    state: str
    direction: str
    mean: MeanInterval
    of: int
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
    foils = by_foil(results)
    steps = {step.name: step for step in ladder(NAME).steps}
    for (name, *foil), seeds in foils.items():
        beside = steps[name].beside
        for state in SHOWN:
            for k, direction in enumerate(DIRECTIONS):
                mean, whole = _mean(seeds, state, k)
                ratio = None
                if beside is not None:
                    other, other_whole = _mean(foils[beside, *foil], state, k)
                    ratio = Ratio.of(mean, other) if whole and other_whole else None
                yield Influence(
                    name,
                    steps[name].words,
                    beside or "",
                    *foil,
                    state,
                    direction,
                    mean,
                    len(seeds),
                    ratio,
                )


def _mean(seeds: list[dict], state: str, k: int) -> tuple[MeanInterval, bool]:
    """Of the seeds that are positive, and whether all are."""
    mean = MeanInterval.of([number(result, STATES[state], k) for result in seeds])
    return mean, mean.n == len(seeds)


def table(found: Found) -> list[dict]:
    """A row for each way, foil, state and direction."""
    return [
        {
            "step": each.step,
            "beside": each.beside,
            "thickness_um": each.thickness_um,
            "height_mm": each.height_mm,
            "state": each.state,
            "direction": each.direction,
            "seeds": each.of,
            "positive": each.mean.n,
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
    """The same for people: a row for each way and foil."""
    rows: dict[tuple[str, int, int], list[Influence]] = {}
    for each in found.influences:
        rows.setdefault((each.step, each.thickness_um, each.height_mm), []).append(each)
    words = {each.step: each.words for each in found.influences}
    heads = ["way", "thickness, um", "height, mm", "seeds", "beside"]
    heads += [f"{state}, {direction}, N/m" for state in SHOWN for direction in DIRECTIONS]
    body = [
        [
            words[step],
            *foil,
            cells[0].of,
            words.get(cells[0].beside, ""),
            *(_cell(each) for each in cells),
        ]
        for (step, *foil), cells in rows.items()
    ]
    return markdown_table(heads, body)


def _cell(each: Influence) -> str:
    mean, ratio = each.mean, each.ratio
    if mean.n < each.of:
        return f"none or not positive in {each.of - mean.n} of {each.of}"
    words = f"{mean.mean:.4g} ({mean.low:.4g} to {mean.high:.4g})"
    if ratio is None:
        return words
    return f"{words}: **{ratio.value:.2f}** ({ratio.low:.2f} to {ratio.high:.2f})"
