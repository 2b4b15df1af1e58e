"""Trials of one method on one foil together, held against the default."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, fields

import numpy as np

from foilstudy.measure.verdicts import FAULTS, Evidence, verdicts
from foilstudy.study.kernel.plan import Record, Records
from foilstudy.study.limits.plan import SETTINGS, Trial
from foilstudy.study.limits.settings import DEFAULT, Setting

QUANTITIES = ("energy", "axial", "radial")


@dataclass(frozen=True)
class FoilOfMap:
    """A column of the map."""

    thickness_um: int
    height_mm: int
    size_mm: float

    @property
    def words(self) -> str:
        """For people."""
        return f"{self.thickness_um} um, {self.height_mm} mm"


@dataclass(frozen=True)
class Bias:
    """Mean over that of the default, less one, with its standard error; NaN where there is none."""

    value: float = np.nan
    error: float = np.nan


@dataclass(frozen=True, eq=False)
class Field:
    """One method on one foil.

    Attributes
    ----------
    setting : Setting
    foil : FoilOfMap
    records : tuple of Record
        By seed.
    verdicts : Counter
        How many trials have which.
    bias : dict of str to Bias
        By `QUANTITIES`, of the trials without a fault.
    seconds : float
        Median, of the processor.
    """

    setting: Setting
    foil: FoilOfMap
    records: tuple[Record, ...]
    verdicts: Counter
    bias: dict[str, Bias]
    seconds: float

    @property
    def sound(self) -> int:
        """Trials that came to rest and have no fault."""
        return sum(map(is_sound, self.records))


def is_sound(record: Record) -> bool:
    """Whether a trial came to rest and has no fault."""
    names = found(record)
    return "converged" in names and not set(FAULTS) & set(names)


def found(record: Record) -> list[str]:
    """Names of the verdicts on a trial, by the limits as they are now."""
    known = {f.name: record.result[f.name] for f in fields(Evidence) if f.name in record.result}
    if "alternation" not in known:  # it has left no shape
        return record.result["verdicts"]
    known = {name: value for name, value in known.items() if value is not None}
    if "work_over_energy" not in known and "rate_dependent" in record.result["verdicts"]:
        known["work_over_energy"] = np.inf  # too fast to tell, and no number in a record
    return [verdict.name for verdict in verdicts(Evidence(**known))]


def mapped(records: Records) -> list[Field]:
    """All fields, in the order of the map."""
    cells: dict[tuple[str, FoilOfMap], list[Record]] = {}
    for trial, record in records["trials"].items():
        cells.setdefault((trial.setting, _foil(trial)), []).append(record)
    default = next(s.name for s in SETTINGS.values() if s.method == DEFAULT)
    return [
        Field(
            SETTINGS[name],
            foil,
            tuple(trials),
            Counter(verdict for record in trials for verdict in found(record)),
            _biases(trials, cells.get((default, foil), [])),
            _median(record.result.get("seconds") for record in trials),
        )
        for (name, foil), trials in cells.items()
    ]


def _foil(trial: Trial) -> FoilOfMap:
    return FoilOfMap(trial.thickness_um, trial.height_mm, trial.size_mm)


def _median(values: Iterable[float | None]) -> float:
    known = [value for value in values if value is not None]
    return float(np.median(known)) if known else np.nan


def _biases(trials: list[Record], default: list[Record]) -> dict[str, Bias]:
    return {name: _bias(_values(trials, name), _values(default, name)) for name in QUANTITIES}


def _values(records: list[Record], name: str) -> np.ndarray:
    """Of the sound trials."""
    results = [record.result for record in records if is_sound(record)]
    if name == "energy":
        return np.array([r["membrane_energy"] + r["bending_energy"] for r in results])
    return np.array(
        [r["static_stiffness"][("axial", "radial").index(name)] for r in results], float
    )


def _bias(values: np.ndarray, default: np.ndarray) -> Bias:
    values, default = values[np.isfinite(values)], default[np.isfinite(default)]
    if not (values.size and default.size):
        return Bias()
    ratio = values.mean() / default.mean()
    spread = [
        np.std(each, ddof=1) / np.sqrt(each.size) / abs(each.mean()) if each.size > 1 else np.nan
        for each in (values, default)
    ]
    return Bias(float(ratio - 1), float(abs(ratio) * np.hypot(*spread)))
