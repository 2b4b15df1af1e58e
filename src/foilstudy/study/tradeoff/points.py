"""What the records say: of every setting its time and its error beside those of the default."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy import stats

from foilstudy.measure.dynamics import DynamicsOptions
from foilstudy.study.changes import value_at
from foilstudy.study.kernel.plan import Records
from foilstudy.study.tradeoff import ensembles, panel
from foilstudy.study.tradeoff.frozen import Static
from foilstudy.study.tradeoff.plan import LADDERS, Ladder, shape_of
from foilstudy.study.tradeoff.settings import Family, Point

_CONFIDENCE = 0.95
_SAME = 1e-4
"""Energies of one seed that differ by less, relatively, are of the same crumple."""


@dataclass(frozen=True)
class Error:
    """Of one quantity.

    Attributes
    ----------
    value : float
        Relative, with its sign where it has one; NaN where there was no answer.
    interval : float
        Half width, of 95 % confidence in an ensemble; else how far off the truth may be.
    scatter : float
        Of the quantity between realisations, relative standard deviation; NaN where there are none.
    """

    value: float
    interval: float = 0.0
    scatter: float = np.nan

    @property
    def bound(self) -> float:
        """What the error may well be."""
        return abs(self.value) + self.interval


@dataclass(frozen=True)
class Row:
    """One setting and one quantity.

    Attributes
    ----------
    ladder, family, value, quantity, change : str
    seconds : float
        Of the processor, for the stage that the setting changes; of one crumple in an ensemble.
    ratio : float
        Over the default, both in the same job.
    error : Error
    same : float
        Share of the seeds that gave the crumple of the default; NaN where there are none.
    failed : int
        Crumples that did not come to rest.
    held, default, reference, front : bool
        See `Family`; the default; what counts as true; no other setting of the ladder has both less
        time and a smaller bound of the error.
    truth : str
        The family where that has a truth of its own, so that its errors compare with no others.
    """

    ladder: str
    family: str
    value: str
    quantity: str
    change: str
    seconds: float
    ratio: float
    error: Error
    same: float
    failed: int
    held: bool
    default: bool
    reference: bool
    truth: str
    front: bool = False


@dataclass(frozen=True)
class Gathered:
    """All rows, the times of a step by thickness and element size, and what adapting would save."""

    rows: tuple[Row, ...]
    steps: list[dict]
    adaptive: dict[Any, dict]

    def of(self, **wanted: Any) -> list[Row]:
        """Rows whose attributes have these values."""
        return [row for row in self.rows if all(getattr(row, k) == v for k, v in wanted.items())]


def gathered(records: Records) -> Gathered:
    """Rows of all ladders, in the order of the plan."""
    rows = [row for ladder in LADDERS for row in _fronts(_rows(ladder, records))]
    adaptive = {case: record.result for case, record in records["adaptive"].items()}
    return Gathered(tuple(rows), records["steps"]["all"].result, adaptive)


def _rows(ladder: Ladder, records: Records) -> Iterator[Row]:
    for title in dict.fromkeys(family.family for family in ladder.families):
        families = [family for family in ladder.families if family.family == title]
        yield from _of_point(ladder, families[0], ladder.default, records)
        for family in families:
            for point in ladder.default.points(family):
                yield from _of_point(ladder, family, point, records)


def _of_point(ladder: Ladder, family: Family, point: Point, records: Records) -> Iterator[Row]:
    found = records[ladder.part]
    one, default = (found[each].result for each in (point, ladder.default))
    errors = _ERRORS[ladder.part](ladder, family, point, records)
    if ladder.part == "dynamic":
        stage = "grid" if family.change == "frequencies" else "reduction"
        one, default, errors = one[stage], default[stage], {stage: errors[stage]}
    seconds = np.mean(default["seconds"])
    ratio = _ratio(one, default)
    for quantity, error in errors.items():
        yield Row(
            ladder.name,
            family.family,
            text_of(ladder, family, point),
            quantity,
            family.change,
            float(ratio * seconds),
            ratio,
            error,
            _same(one, default),
            int(np.isnan(one["energy"]).sum()) if ladder.part == "ensembles" else 0,
            held=family.held,
            default=point == ladder.default,
            reference=point == ladder.true(family),
            truth=family.family if family.reference is not None else "",
        )


def _ratio(one: dict, default: dict) -> float:
    """Time over that of the default, with the pace of the machine in either job taken out."""
    if "failed" in one:
        return np.nan
    times = np.mean(one["seconds"]) / np.mean(default["seconds"])
    return float(times * default["pace"] / one["pace"])


def _same(one: dict, default: dict) -> float:
    if not np.ndim(one.get("energy", 0.0)):
        return np.nan
    return float(np.mean(np.abs(one["energy"] / default["energy"] - 1) < _SAME))


def text_of(ladder: Ladder, family: Family, point: Point) -> str:
    """Value of a setting as charts and tables have it, behind the initials of what is beside it."""
    value = point.value if point != ladder.default else value_at(default_of(ladder), family.change)
    number = isinstance(value, int | float) and not isinstance(value, bool)
    text = f"{value:g}" if number else str(value).lower()
    if family.beside is None:
        return text.replace("_", " ")
    name = family.beside.rpartition(".")[2]
    return f"{''.join(word[0].upper() for word in name.split('_'))} {text}"


def default_of(ladder: Ladder) -> Any:
    """The default specification of a ladder."""
    if ladder.part == "ensembles":
        return ensembles.recipe(ladder.default)
    return {"panel": panel.Followed, "static": Static, "dynamic": DynamicsOptions}[ladder.part]()


def _panel_errors(
    ladder: Ladder, family: Family, point: Point, records: Records
) -> dict[str, Error]:
    found, true = records["panel"][point].result, records["truth"]["panel"].result
    uncertain = {"energy": true["energy_error"] / true["energy"]}
    return {
        name: Error(value, uncertain.get(name, 0.0))
        for name, value in panel.errors(found, true).items()
    }


def _static_errors(
    ladder: Ladder, family: Family, point: Point, records: Records
) -> dict[str, Error]:
    found, true = records["static"][point].result, records["shapes"][shape_of(point)].result
    uncertain = true["static_error"] / true["static"]
    return {
        name: Error(_number(found[name]), float(share))
        for name, share in zip(("axial", "radial"), uncertain, strict=True)
    }


def _dynamic_errors(
    ladder: Ladder, family: Family, point: Point, records: Records
) -> dict[str, Error]:
    found = records["dynamic"][point].result
    return {stage: Error(_number(found[stage].get("error"))) for stage in ("reduction", "grid")}


def _ensemble_errors(
    ladder: Ladder, family: Family, point: Point, records: Records
) -> dict[str, Error]:
    found, true = (records["ensembles"][each].result for each in (point, ladder.true(family)))
    return {
        name: bias(found[name], true[name], of_itself=point == ladder.true(family))
        for name in ensembles.QUANTITIES
    }


_ERRORS = {
    "panel": _panel_errors,
    "static": _static_errors,
    "dynamic": _dynamic_errors,
    "ensembles": _ensemble_errors,
}


def bias(values: np.ndarray, true: np.ndarray, of_itself: bool = False) -> Error:
    """Relative error of the mean of an ensemble against that of another one.

    Parameters
    ----------
    values, true : ndarray
        By seed; NaN where a crumple did not come to rest.
    of_itself : bool
        Both are the same ensemble: its own mean alone is uncertain.
    """
    values, true = (np.asarray(each, float) for each in (values, true))
    values, true = values[np.isfinite(values)], true[np.isfinite(true)]
    if min(values.size, true.size) < 2:
        return Error(np.nan, np.nan)
    variances = [np.var(each, ddof=1) / each.size for each in (values, true)]
    variance = variances[1] if of_itself else sum(variances)
    width = stats.t.ppf(0.5 + _CONFIDENCE / 2, min(values.size, true.size) - 1)
    scatter = np.std(true, ddof=1) / true.mean()
    interval = width * np.sqrt(variance) / true.mean()
    return Error(float(values.mean() / true.mean() - 1), float(interval), float(scatter))


def _number(value: float | None) -> float:
    """NaN for what a record has as None."""
    return np.nan if value is None else float(value)


def _fronts(rows: Iterable[Row]) -> Iterator[Row]:
    """The rows of a ladder, those on the front of their quantity and truth marked."""
    rows = list(rows)
    for row in rows:
        others = [o for o in rows if (o.quantity, o.truth) == (row.quantity, row.truth)]
        yield replace(row, front=_on_front(row, others))


def _on_front(row: Row, others: list[Row]) -> bool:
    if not np.isfinite(row.ratio) or not np.isfinite(row.error.bound):
        return False
    return not any(
        other.ratio <= row.ratio
        and other.error.bound <= row.error.bound
        and (other.ratio < row.ratio or other.error.bound < row.error.bound)
        for other in others
    )
