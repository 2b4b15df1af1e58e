"""What the jobs of the convergence study write, and reading it back."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foilstudy.convergence import plan
from foilstudy.files import written_whole


def write(record: dict | list[dict], path: str | Path) -> None:
    """Write a record as JSON, numbers that are not finite as null."""
    with written_whole(path) as partial:
        partial.write_text(json.dumps(_plain(record), indent=1, allow_nan=False) + "\n")


def read(path: str | Path) -> dict | list[dict]:
    """What `write` has written; null is None for single numbers, NaN in lists."""
    return json.loads(Path(path).read_text(), object_hook=_arrays)


def _plain(value):
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float) and not np.isfinite(value):
        return None
    return value


def _arrays(record: dict) -> dict:
    return {
        key: np.array(value, float) if isinstance(value, list) and _numeric(value) else value
        for key, value in record.items()
    }


def _numeric(value: list) -> bool:
    return all(item is None or isinstance(item, int | float) for item in value)


@dataclass(frozen=True)
class Study:
    """All records.

    Attributes
    ----------
    crumples : dict of Case to dict
        See `crumpling.run`.
    levels, stops : dict of Case to list of dict
        See `crumpling.run_levels` and `stops.run_stops`.
    timing : list of dict
        See `timing.run_timing`.
    """

    crumples: dict[plan.Case, dict]
    levels: dict[plan.Case, list[dict]]
    stops: dict[plan.Case, list[dict]]
    timing: list[dict]

    @classmethod
    def read(cls, folder: Path) -> Study:
        """Read what the jobs have written."""
        return cls(
            {case: read(folder / f"crumples/{case.name}.json") for case in plan.crumples()},
            {case: read(folder / f"levels/{case.name}.json") for case in plan.MULTILEVEL},
            {case: read(folder / f"stops/{case.name}.json") for case in plan.STOPPED},
            read(folder / "timing.json"),
        )

    def ensemble(
        self, key: str, thickness_um: int, element: str = "corner", index: int | None = None
    ) -> dict[float, np.ndarray]:
        """One number of all converged seeds at the common height, by element size (mm).

        Parameters
        ----------
        key : str
            Of the record.
        index : int, optional
            Direction, where the record has one number for each.
        """
        found: dict[float, list[float]] = {}
        for case, record in self.crumples.items():
            place = (case.thickness_um, case.element, case.height_mm)
            if place != (thickness_um, element, plan.HEIGHT_MM):
                continue
            if record["status"] == "converged":
                value = record[key] if index is None else record[key][index]
                found.setdefault(case.size_mm, []).append(value)
        return {size: np.array(values, float) for size, values in sorted(found.items())}
