"""Whether the study can be trusted: verdicts, limits of the model and costs."""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from foilstudy.base.outcome import STATUSES
from foilstudy.config.model import overlength_id, thickness_id
from foilstudy.present.configuration import configuration
from foilstudy.present.report.spread import Spread
from foilstudy.present.statistics.cells import realised

_CELL = ("thickness", "overlength", "seed")
_STAGES = {
    "seconds_crumple": "crumple",
    "seconds_static": "static stiffness",
    "seconds_dynamic": "dynamic stiffness",
    "seconds_refined": "relaxing again",
}


@dataclass(frozen=True)
class FlaggedCell:
    """A realisation without a converged equilibrium, here or relaxed again, or without its band."""

    thickness_um: float
    overlength_percent: float
    reference_height_mm: float
    seed: int
    status: str
    message: str
    residual: float


@dataclass(frozen=True)
class ModelLimit:
    """How far one configuration strains beyond yield or passes through itself."""

    thickness_um: float
    overlength_percent: float
    beyond_yield: Spread | None
    self_crossing: Spread | None


@dataclass(frozen=True)
class StageCost:
    """Time spent in one stage [s], over all realisations."""

    stage: str
    total_s: float
    share: float
    per_realisation: Spread


@dataclass(frozen=True)
class Health:
    """Verdicts, limits and costs of a study.

    Attributes
    ----------
    counts
        Realisations by status, in the order of `STATUSES`.
    flagged
        Every realisation that is not converged, or whose reduced model is not valid over the
        whole band.
    model
        What the model holds, for a sentence.
    model_limits
        One entry per configuration that left the model anywhere.
    costs
        Stages that were timed.
    peak_memory_mb
        Largest memory of a job [MB]; None when not recorded.
    jobs
        Per rule: jobs and wall time [s], from the workflow's benchmark files. What else these hold
        is of the process that waits for the job in the worker.
    """

    counts: dict[str, int]
    flagged: tuple[FlaggedCell, ...]
    model: str
    model_limits: tuple[ModelLimit, ...]
    configurations: int
    costs: tuple[StageCost, ...]
    peak_memory_mb: float | None
    jobs: tuple[dict, ...]

    @property
    def total(self) -> int:
        """Number of realisations in the sweep."""
        return sum(self.counts.values())


def assess(cube: xr.Dataset, benchmarks: Path | None = None) -> Health:
    """Read the verdicts, limits and costs of a study from its cube.

    Parameters
    ----------
    cube
        The study's result cube.
    benchmarks
        Folder of the workflow's benchmark tables, searched recursively; None to leave them out.
    """
    status = cube["status"].astype(str).transpose(*_CELL)
    names, numbers = np.unique(status.values[realised(cube).values], return_counts=True)
    found = dict(zip(names.tolist(), numbers.tolist(), strict=True))
    counts = {name: found.pop(name, 0) for name in STATUSES} | found
    memory = Spread.of(_values(cube, "peak_memory"))
    return Health(
        counts=counts,
        flagged=_flagged(cube, status),
        model=_model(cube),
        model_limits=_model_limits(cube),
        configurations=cube.sizes["thickness"] * cube.sizes["overlength"],
        costs=_costs(cube),
        peak_memory_mb=memory.highest if memory else None,
        jobs=_jobs(benchmarks, cube),
    )


def _values(cube: xr.Dataset, name: str) -> np.ndarray:
    return cube[name].values if name in cube else np.array([])


def _flagged(cube: xr.Dataset, status: xr.DataArray) -> tuple[FlaggedCell, ...]:
    cells = []
    wrong = status.values != "converged"
    if "valid_to_frequency" in cube:
        valid_to = cube["valid_to_frequency"].transpose(*_CELL).values
        wrong |= valid_to < float(cube["frequency"][-1])  # a reduced model that ends before
    if "refined_status" in cube:
        relaxed = cube["refined_status"].transpose(*_CELL).values
        wrong |= ~np.isin(relaxed, ["", "converged"])
    for where in np.argwhere(wrong & realised(cube).values):
        cell = cube.isel(dict(zip(_CELL, where, strict=True)))
        cells.append(
            FlaggedCell(
                float(cell["thickness"]),
                float(cell["overlength"]),
                float(cell["reference_height"]),
                int(cell["seed"]),
                str(cell["status"].values),
                str(cell["message"].values),
                float(cell["equilibrium_residual"]),
            )
        )
    return tuple(cells)


def _model(cube: xr.Dataset) -> str:
    law = "elastic up to the yield stress" if "plastic_share" in cube else "linear elastic"
    contact = "lets parts of the foil touch" if "contact_share" in cube else "knows no contact"
    return f"is {law} and {contact}"


def _model_limits(cube: xr.Dataset) -> tuple[ModelLimit, ...]:
    limits = []
    for t in cube["thickness"].values:
        for o in cube["overlength"].values:
            cell = cube.sel(thickness=t, overlength=o)
            limit = ModelLimit(
                float(t),
                float(o),
                Spread.of(_values(cell, "beyond_yield_share")),
                Spread.of(_values(cell, "self_crossing_share")),
            )
            if any(s and s.highest > 0 for s in (limit.beyond_yield, limit.self_crossing)):
                limits.append(limit)
    return tuple(limits)


def _costs(cube: xr.Dataset) -> tuple[StageCost, ...]:
    spreads = {
        stage: (np.nansum(_values(cube, name)), Spread.of(_values(cube, name)))
        for name, stage in _STAGES.items()
    }
    everything = sum(total for total, _ in spreads.values())
    return tuple(
        StageCost(stage, float(total), float(total / everything), spread)
        for stage, (total, spread) in spreads.items()
        if spread and everything > 0
    )


def _jobs(folder: Path | None, cube: xr.Dataset) -> tuple[dict, ...]:
    """Sum Snakemake's benchmark tables, one file per job, by the rule that names the folder.

    Tables of realisations and rules that an earlier configuration had stay around: they do not
    count, nor does what a killed job has left half-written.
    """
    if folder is None or not Path(folder).is_dir():
        return ()
    cells, rows = set(_cell_names(cube)), []
    for path in sorted(Path(folder).rglob("*.tsv")):
        rule, *rest = path.relative_to(folder).with_suffix("").parts
        if rest and rule in _RULES_OF_CELLS and not (rest[0] in cells and _in_use(rule, cube)):
            continue
        with suppress(ValueError, KeyError):
            table = pd.read_csv(path, sep="\t", na_values="-")
            rows.append({"rule": rule, "wall_s": float(table["s"].sum())})
    if not rows:
        return ()
    grouped = pd.DataFrame(rows).groupby("rule", sort=True)
    summary = grouped.agg(jobs=("rule", "size"), wall_s=("wall_s", "sum"))
    return tuple(summary.reset_index().to_dict("records"))


_RULES_OF_CELLS = ("crumple", "response", "refine", "export")
"""Those with a job for each realisation."""


def _cell_names(cube: xr.Dataset) -> Iterator[str]:
    """Realisations of the cube, as the workflow names their benchmark tables."""
    for where in np.argwhere(realised(cube).values):
        cell = cube.isel(dict(zip(_CELL, where, strict=True)))
        height = overlength_id(float(cell["reference_height"]))
        yield f"{thickness_id(float(cell['thickness']))}_{height}_{int(cell['seed'])}"


def _in_use(rule: str, cube: xr.Dataset) -> bool:
    if rule == "refine":
        return "refined_status" in cube
    return rule != "export" or bool(configuration(cube).get("export", {}).get("formats"))
