"""Fit the coefficients of `foilstudy.study.sweep.expected` to finished studies, and print them.

    .venv/bin/python benchmarks/expected.py results/default results/thesis

Of each folder, `cube.nc` says how many steps and how much time a realisation took, and
`benchmarks/`, if it is there, how long its jobs took. How time grows with the mesh is in
results/convergence, whose crumples have 7 to 1.25 mm. What a reduction needs of memory shows where
nothing is refined: four responses of the first folder with realisations are measured again, half a
minute. Logarithms are fitted, and every study has the same weight. The last lines say how far the
model is from what was measured, each study also against the model that was fitted without it.
"""

from __future__ import annotations

import csv
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, replace
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pandas as pd
import yaml
from scipy.optimize import least_squares

from foilstudy.base.cube import open_cube
from foilstudy.base.record import read_record
from foilstudy.config import Cell, StudyConfig, load_config
from foilstudy.config.foils import patch_of
from foilstudy.study.sweep.expected import MEASURED, CostModel, expected
from foilstudy.study.sweep.respond import respond_job

ROOT = Path(__file__).parents[1]
PHYSICS = ["seconds_crumple", "seconds_static", "seconds_dynamic"]
GATHERED = ("cylinder", "cube", "tables", "figures/*", "report")


@dataclass(frozen=True)
class Finished:
    """A finished study.

    Attributes
    ----------
    config : StudyConfig
    cells : DataFrame
        One row for each realisation: what was measured, and its `configuration`.
    folder : Path
    job_seconds, gathering_seconds : float
        Of a job beyond its physics, and of the jobs that are not those of a realisation; NaN where
        the folder holds no benchmarks.
    """

    config: StudyConfig
    cells: pd.DataFrame
    folder: Path
    job_seconds: float
    gathering_seconds: float

    @classmethod
    def read(cls, folder: Path) -> Finished:
        """The study in a folder of results."""
        cube = open_cube(folder / "cube.nc")
        config = load_config(yaml.safe_load(cube.attrs["config"]))
        names = [*PHYSICS, "steps", "reduced_coordinates", "peak_memory"]
        rows = []
        for configuration in expected(config).configurations:
            here = cube[names].sel(thickness=configuration.thickness_um)
            height = cube.reference_height.values == configuration.reference_height_mm
            table = here.isel(overlength=height).squeeze("overlength").to_dataframe()[names]
            rows.append(table.assign(configuration=configuration))
        cells = pd.concat(rows).dropna()
        cells["elements"] = [each.elements[0] for each in cells.configuration]
        thickness_mm = 1e-3 * np.array([each.thickness_um for each in cells.configuration])
        cells["slenderness"] = config.sheet.diameter_mm / 2 / thickness_mm
        jobs = [*_times(folder, "crumple/*"), *_times(folder, "response/*")]
        gathered = [seconds for name in GATHERED for seconds in _times(folder, name)]
        beyond = (sum(jobs) - cells[PHYSICS].to_numpy().sum()) / len(jobs) if jobs else np.nan
        return cls(config, cells, folder, beyond, sum(gathered) if gathered else np.nan)


def _times(folder: Path, pattern: str) -> list[float]:
    """Seconds of the jobs whose benchmark files match."""
    times = []
    for path in (folder / "benchmarks").glob(f"{pattern}.tsv"):
        with path.open() as file:
            times += [float(row["s"]) for row in csv.DictReader(file, delimiter="\t")]
    return times


def fitted(studies: Sequence[Finished]) -> CostModel:
    """The model of these studies and of the crumples on other meshes."""
    model = replace(
        MEASURED,
        **_fit_steps(studies),
        **_fit_coordinates(studies),
        **_fit_solves(studies),
        **_fit_memory(studies),
    )
    model = replace(model, **_fit_projection(studies, model))
    timed = [study for study in studies if np.isfinite(study.job_seconds)]
    if timed:
        model = replace(
            model,
            job=float(np.mean([study.job_seconds for study in timed])),
            gathering=float(np.mean([study.gathering_seconds for study in timed])),
        )
    return model


def _fit_steps(studies: Sequence[Finished]) -> dict[str, float]:
    def deviation(model, study):
        options = study.config.relaxation
        free = model.steps_after_ramp(study.cells.slenderness)
        given = [options.resolved(slenderness) for slenderness in study.cells.slenderness]
        ramps, most = np.array([(g.ramp_steps, g.relaxation_steps_max) for g in given]).T
        return np.log(study.cells.steps / (ramps + np.minimum(free, most)))

    return _fit(studies, deviation, "relaxation_steps", "slenderness_exponent")


def _fit_coordinates(studies: Sequence[Finished]) -> dict[str, float]:
    def deviation(model, study):
        band_hz = study.config.dynamics.shown_max_hz
        coordinates = model.reduced_coordinates(study.cells.slenderness, band_hz)
        return np.log(study.cells.reduced_coordinates / coordinates)

    return _fit(studies, deviation, "coordinates", "coordinates_exponent")


def _fit_solves(studies: Sequence[Finished]) -> dict[str, float]:
    """Steps, settling and static stiffness; the crumples on other meshes count as one study."""
    meshes = pd.read_csv(ROOT / "results/convergence/convergence.csv")
    meshes = meshes[(meshes.element == "corner") & (meshes.path == "own mesh")]
    meshes = meshes[meshes.hessians == 1]  # more of them are bad luck, not the mesh

    def deviation(model, study):
        if study is None:
            settling = model.crumple_seconds(meshes.elements, 0)
            steps = meshes.ramp_steps + meshes.steps
            pairs = (
                (meshes.cpu_seconds_settling, settling),
                (
                    meshes.cpu_seconds_relaxing,
                    model.crumple_seconds(meshes.elements, steps) - settling,
                ),
                (meshes.cpu_seconds_static, model.solve_seconds(meshes.elements)),
            )
        else:
            cells = study.cells
            static = [model.static_seconds(each.elements) for each in cells.configuration]
            pairs = (
                (cells.seconds_crumple, model.crumple_seconds(cells.elements, cells.steps)),
                (cells.seconds_static, static),
            )
        return np.concatenate([np.log(measured / model) for measured, model in pairs])

    names = ("step", "step_exponent", "settling", "condensation", "solve_exponent")
    return _fit([*studies, None], deviation, *names)


def _fit_projection(studies: Sequence[Finished], model: CostModel) -> dict[str, float]:
    """With the coordinates that a realisation has, as their number is fitted by itself."""

    def deviation(candidate, study):
        candidate = replace(model, projection=candidate.projection)
        cells = study.cells
        seconds = candidate.dynamic_seconds(cells.elements, cells.reduced_coordinates)
        return np.log(cells.seconds_dynamic / seconds)

    return _fit(studies, deviation, "projection")


def _fit_memory(studies: Sequence[Finished]) -> dict[str, float]:
    def deviation(model, study):
        finest = np.array([each.elements[-1] for each in study.cells.configuration])
        cells = study.cells
        memory = model.peak_memory_mb(finest, cells.elements, cells.reduced_coordinates)
        return np.log(cells.peak_memory / memory)

    return _fit(studies, deviation, "memory_base_mb", "memory_mb")


def projection_memory_mb(study: Finished, model: CostModel) -> float:
    """Memory of a reduction, from responses that are measured anew without refinement."""
    cells = [cell for cell in study.config.cells() if cell.seed == 0]
    cases = [(study, cell, hz) for cell in (cells[0], cells[-1]) for hz in (800.0, 1600.0)]
    # a process each, as its peak counts
    with ProcessPoolExecutor(1, get_context("spawn"), max_tasks_per_child=1) as pool:
        found = list(pool.map(_coordinates_and_memory, cases))
    products, memory = np.array(found).T
    beyond = np.log((memory - model.memory_base_mb) / products)
    return float(np.exp(beyond.mean()))


def _coordinates_and_memory(case: tuple[Finished, Cell, float]) -> tuple[float, float]:
    """Thousand elements times thousand coordinates, and peak memory in MB."""
    study, cell, band_hz = case
    task = study.config.response_task(cell)
    dynamics = task.dynamics.model_copy(update={"shown_max_hz": band_hz})
    task = task.model_copy(update={"error_percent": None, "refinements": 0, "dynamics": dynamics})
    place = study.folder / "realisations" / cell.thickness_id / cell.overlength_id / "0"
    with tempfile.TemporaryDirectory() as folder:
        respond_job(task, place / "crumple.nc", Path(folder) / "response.nc")
        values, _ = read_record(Path(folder) / "response.nc")
    patch = patch_of(study.config.crumple_task(cell))
    elements = patch.elements_around * patch.elements_along
    return elements * float(values["reduced_coordinates"]) / 1e6, float(values["peak_memory"])


def _fit(studies: Sequence, deviation: Callable, *names: str) -> dict[str, float]:
    """Positive coefficients that make the deviations of logarithms least."""

    def coefficients(x):
        return dict(zip(names, np.exp(x).tolist(), strict=True))

    def residuals(x):
        model = replace(MEASURED, **coefficients(x))
        parts = [deviation(model, study) for study in studies]
        return np.concatenate([part / np.sqrt(len(part)) for part in parts])

    start = np.log([getattr(MEASURED, name) for name in names])
    return coefficients(least_squares(residuals, start).x)


def judged(study: Finished, model: CostModel) -> str:
    """What was measured over what was expected."""
    cells, cost = study.cells, expected(study.config, model)
    place = {(c.thickness_um, c.reference_height_mm): c for c in cost.configurations}
    asked = [place[each.thickness_um, each.reference_height_mm] for each in cells.configuration]
    crumple = np.array([each.seconds_of["crumple"] for each in asked])
    response = np.array([each.seconds_of["response"] for each in asked])
    jobs = 2 * model.job
    measured = cells[PHYSICS].sum(axis=1).to_numpy() + jobs
    ratio = measured / (crumple + response + jobs)
    factor = np.exp(np.quantile(np.abs(np.log(ratio)), 0.9))
    return (
        f"{study.config.study.name}: {measured.sum():.0f} s, "
        f"{measured.sum() / (crumple + response + jobs).sum():.2f} of the expected "
        f"(crumples {cells.seconds_crumple.sum() / crumple.sum():.2f}, "
        f"responses {cells[PHYSICS[1:]].to_numpy().sum() / response.sum():.2f}, "
        f"memory {cells.peak_memory.max() / cost.peak_memory_mb:.2f}); "
        f"9 of 10 realisations within a factor of {factor:.2f}"
    )


def start_seconds() -> float:
    """Time until Snakemake knows its jobs and the kernels are seen to be compiled."""
    clock = time.perf_counter()
    compiling = "from foilstudy.study.sweep import warmup; warmup.compile_kernels()"
    for words in (
        [sys.executable, "-m", "snakemake", "--dry-run", "--configfile", "config/tiny.yaml"],
        [sys.executable, "-c", compiling],
    ):
        subprocess.run(words, cwd=ROOT, check=True, capture_output=True)
    return time.perf_counter() - clock


def main(folders: Sequence[str]) -> None:
    """Print coefficients and spread."""
    studies = [Finished.read(Path(folder)) for folder in folders]
    model = replace(fitted(studies), start=start_seconds())
    kept = [study for study in studies if (study.folder / "realisations").is_dir()]
    if kept:
        model = replace(model, projection_memory_mb=projection_memory_mb(kept[0], model))
    for name, value in asdict(model).items():
        print(f"    {name}: float = {value:.3g}")
    for study in studies:
        print("fitted with it,    ", judged(study, model))
        others = [other for other in studies if other is not study]
        if others:
            print("fitted without it, ", judged(study, replace(fitted(others), job=model.job)))


if __name__ == "__main__":
    main(sys.argv[1:])
