"""Means of every word with their intervals, over those that they stand beside, and their times."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from foilstudy.base.confidence import MeanInterval, Ratio
from foilstudy.base.outcome import USABLE
from foilstudy.base.tables import markdown_table
from foilstudy.study.accuracy.plan import NAME
from foilstudy.study.kernel.plan import Record, Records
from foilstudy.study.real.settings import Trial, by_foil, ladder

ENERGY, AXIAL, RADIAL = "energy", "axial", "radial"
QUANTITIES = (ENERGY, AXIAL, RADIAL)
SLOW = "_slow"
"""Behind the name of a step: the same with more steps of the ramp."""
_ENERGIES = ("membrane_energy", "bending_energy", "stabilisation_energy")
_LIMIT = "static_stiffness_converged"
STAGES = {"crumple": "seconds_crumple", "static": "seconds_static", "dynamic": "seconds_dynamic"}
"""By stage, the quantity of its time."""


@dataclass(frozen=True)
class Word:
    """One way to crumple and to measure a foil, and the one that it stands beside.

    Attributes
    ----------
    step, words, beside : str
        Names of both, `words` for people; `beside` is empty for what others stand beside.
    thickness_um, height_mm : int
    of, rested : int
        Seeds, and those that came to rest.
    means : mapping of str to MeanInterval
        By `QUANTITIES`: strain energy, J, and stiffness at the mesh limit, N/m.
    ratios : mapping of str to Ratio
        Of these to those beside it; none for what others stand beside.
    seconds : mapping of str to float
        By `STAGES`, the median of the seeds.
    cpu_seconds : float
        Processor time of a realisation, all that belongs to its jobs included; median.
    """

    step: str
    words: str
    beside: str
    thickness_um: int
    height_mm: int
    of: int
    rested: int
    means: Mapping[str, MeanInterval]
    ratios: Mapping[str, Ratio]
    seconds: Mapping[str, float]
    cpu_seconds: float


@dataclass(frozen=True, eq=False)
class Found:
    """What came out: the records, and what follows."""

    records: Mapping[Trial, Record]
    words: tuple[Word, ...]


def found(records: Records) -> Found:
    """Means, ratios and times of every word."""
    trials = records["trials"]
    return Found(trials, tuple(_summed(trials)))


def _summed(records: Mapping[Trial, Record]) -> Iterator[Word]:
    foils = by_foil(records)
    steps = {step.name: step for step in ladder(NAME).steps}
    means = {place: _means(seeds) for place, seeds in foils.items()}
    for (name, *foil), seeds in foils.items():
        here, beside = means[name, *foil], steps[name].beside
        ratios = {}
        if beside is not None:
            other = means[beside, *foil]
            ratios = {quantity: Ratio.of(here[quantity], other[quantity]) for quantity in here}
        seconds = {
            stage: float(np.median([seed.result.get(key, np.nan) for seed in seeds]))
            for stage, key in STAGES.items()
        }
        yield Word(
            name, steps[name].words, beside or "", *foil,
            len(seeds), sum(_rested(seed) for seed in seeds), here, ratios, seconds,
            float(np.median([seed.cost.cpu_seconds for seed in seeds])),
        )  # fmt: skip


def _rested(record: Record) -> bool:
    return record.result["status"] in USABLE


def _means(seeds: list[Record]) -> dict[str, MeanInterval]:
    """Of the seeds that came to rest."""
    values = [_values(seed.result) for seed in seeds if _rested(seed)]
    return {q: MeanInterval.of([value[q] for value in values]) for q in QUANTITIES}


def _values(result: Mapping) -> dict[str, float]:
    stiffness = dict(zip((AXIAL, RADIAL), result[_LIMIT], strict=True))
    return {ENERGY: sum(result[name] for name in _ENERGIES), **stiffness}


def trials(found: Found) -> list[dict]:
    """A row for each crumple."""
    return [
        {
            "step": trial.step,
            "thickness_um": trial.thickness_um,
            "height_mm": trial.height_mm,
            "seed": trial.seed,
            "status": record.result["status"],
            **(_values(record.result) if _rested(record) else dict.fromkeys(QUANTITIES, np.nan)),
            "steps": record.result.get("steps", np.nan),
            **{key: record.result.get(key, np.nan) for key in STAGES.values()},
            "cpu_seconds": record.cost.cpu_seconds,
        }
        for trial, record in found.records.items()
    ]


def table(found: Found) -> list[dict]:
    """A row for each word, foil and quantity."""
    return [
        {
            "step": each.step,
            "beside": each.beside,
            "thickness_um": each.thickness_um,
            "height_mm": each.height_mm,
            "quantity": quantity,
            "seeds": each.of,
            "at_rest": each.rested,
            "mean": mean.mean,
            "low": mean.low,
            "high": mean.high,
            "cv": mean.cv,
            **_ratio_columns(each.ratios.get(quantity)),
            "cpu_seconds": each.cpu_seconds,
        }
        for each in found.words
        for quantity, mean in each.means.items()
    ]


def _ratio_columns(ratio: Ratio | None) -> dict[str, float]:
    ratio = ratio or Ratio(np.nan, np.nan, np.nan)
    return {"ratio": ratio.value, "ratio_low": ratio.low, "ratio_high": ratio.high}


def page(found: Found) -> str:
    """The same for people: a row for each word and foil."""
    words = {each.step: each.words for each in found.words}
    heads = ["", "µm", "seeds", "over", "energy", "axial", "radial", "scatter axially, radially"]
    heads += ["crumple, static, dynamic, s", "in all, CPU s"]
    body = [
        [
            each.words,
            each.thickness_um,
            f"{each.rested} of {each.of}" if each.rested < each.of else each.of,
            words.get(each.beside, ""),
            *(_cell(each, quantity) for quantity in QUANTITIES),
            f"{100 * each.means[AXIAL].cv:.0f}, {100 * each.means[RADIAL].cv:.0f} %",
            ", ".join(f"{seconds:.2g}" for seconds in each.seconds.values()),
            f"{each.cpu_seconds:.2g}",
        ]
        for each in found.words
    ]
    return "\n".join([markdown_table(heads, body), *_of_the_ramp(found)])


def _of_the_ramp(found: Found) -> Iterator[str]:
    """What the ramp of a word does on its own mesh, where it was also given more steps."""
    by_name = {(each.step, each.thickness_um, each.height_mm): each for each in found.words}
    for (name, *foil), each in by_name.items():
        slow = by_name.get((f"{name}{SLOW}", *foil))
        if slow is None:
            continue
        ratios = (Ratio.of(each.means[quantity], slow.means[quantity]) for quantity in QUANTITIES)
        said = (f"{q} {_words(ratio)}" for q, ratio in zip(QUANTITIES, ratios))
        yield f"\n{each.words} over {slow.words}, {each.thickness_um} µm: {', '.join(said)}."


def _cell(each: Word, quantity: str) -> str:
    mean, ratio = each.means[quantity], each.ratios.get(quantity)
    if ratio is None:
        unit = "J" if quantity == ENERGY else "N/m"
        return f"{mean.mean:.3g} {unit} (to {100 * mean.half_width:.0f} %)"
    return _words(ratio)


def _words(ratio: Ratio) -> str:
    return f"**{ratio.value:.2f}** ({ratio.low:.2f} to {ratio.high:.2f})"
