"""What the records of the convergence study say."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.study.convergence import plan
from foilstudy.study.kernel.files import Records


@dataclass(frozen=True)
class Findings:
    """All results.

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
    def of(cls, records: Records) -> Findings:
        """From the records of a run."""
        results = (
            {case: record.result for case, record in records[part].items()}
            for part in ("crumples", "levels", "stops")
        )
        return cls(*results, timing=records["timing"]["steps"].result)

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
