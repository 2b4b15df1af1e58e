"""Measure what the package costs and write benchmarks/results.md.

    .venv/bin/python benchmarks/run.py                                 parts of a job, a minute
    .venv/bin/python benchmarks/run.py config/config.yaml [...]        whole studies as well

Medians of several runs on one core; studies with `snakemake -j2 --forceall`, which makes their
results again. Run it on a machine that does nothing else.
"""

from __future__ import annotations

import os

for variable in ("OMP", "MKL", "OPENBLAS", "NUMBA"):
    os.environ[f"{variable}_NUM_THREADS"] = "1"

import resource  # noqa: E402
import statistics  # noqa: E402
import subprocess  # noqa: E402
import sys  # noqa: E402
import tempfile  # noqa: E402
import time  # noqa: E402
from collections.abc import Callable  # noqa: E402
from itertools import product  # noqa: E402
from pathlib import Path  # noqa: E402

import numpy as np  # noqa: E402

from foilstudy.base.provenance import machine  # noqa: E402
from foilstudy.base.record import read_record  # noqa: E402
from foilstudy.config import load_config  # noqa: E402
from foilstudy.model.foil import Foil  # noqa: E402
from foilstudy.model.materials import material  # noqa: E402
from foilstudy.pipeline.crumple import uncrumpled  # noqa: E402
from foilstudy.pipeline.method import Mesh  # noqa: E402
from foilstudy.solve.problem import Problem  # noqa: E402
from foilstudy.solve.relaxation import Ramp, Scheme, StoppingRule, relax  # noqa: E402
from foilstudy.solve.relaxation.mass.spectral import SpectralMassScaling  # noqa: E402
from foilstudy.study.sweep.crumple import crumple_job  # noqa: E402
from foilstudy.study.sweep.respond import respond_job  # noqa: E402
from foilstudy.study.sweep.warmup import compile_kernels  # noqa: E402

ROOT = Path(__file__).parents[1]
SCRIPTS = ROOT / "workflow/scripts"
JOB = [sys.executable, "-I", "-S", str(SCRIPTS / "job.py"), str(SCRIPTS / "call.py")]
REPEATS = 7
FOIL = Foil(0.2, 0.17, 0.13, 500e-6, material("FEP"))


def task_study(height_mm: float, **relaxation):
    """A study of one realisation, 500 um thick, at 5 mm."""
    return load_config(
        {
            "study": {"name": "benchmark"},
            "sweep": {
                "thickness_um": [500],
                "reference_height_mm": [height_mm],
                "realisations": 1,
            },
            "mesh": {"element_size_mm": 5},
            "relaxation": relaxation,
            "stiffness": {"refinements": 1},
        }
    )


def median_seconds(call: Callable[[], object], inner: int = 1) -> float:
    """Median time of one call, over `REPEATS` batches of `inner` calls."""
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        for _ in range(inner):
            call()
        times.append((time.perf_counter() - start) / inner)
    return statistics.median(times)


def kernel_rows() -> list[tuple[str, str]]:
    """Force evaluation and mass solve per element."""
    start = uncrumpled(FOIL, Mesh(5e-3))
    shell, patch = start.stressed, start.patch
    points = start.reference + 1e-3 * np.random.default_rng(0).standard_normal(patch.shape)
    force = np.empty_like(points)
    mass = SpectralMassScaling().start(Problem(shell))
    momentum = np.ascontiguousarray(force[:, 2:-2])
    elements = patch.elements_around * patch.elements_along
    per_force = median_seconds(lambda: shell.force(points, force), 200) / elements
    per_solve = median_seconds(lambda: mass.velocity(momentum), 200) / elements
    return [
        ("force evaluation, per element", f"{1e9 * per_force:.0f} ns"),
        ("mass solve, per element", f"{1e9 * per_solve:.0f} ns"),
    ]


def crumple_rows(folder: Path) -> list[tuple[str, str]]:
    """One crumple of exactly 4000 steps, then whole realisations."""
    problem, scheme = Problem(uncrumpled(FOIL, Mesh(5e-3)).stressed), Scheme()
    ramp, rule = Ramp(FOIL.shortening, 2000), StoppingRule(0.0, 2000)
    seconds = median_seconds(lambda: relax(problem, scheme.start(problem), ramp, rule))
    rows = [("crumple, 0.17 m, 5 mm, 4000 steps", f"{seconds:.2f} s")]
    for height in (135, 170, 250):
        study = task_study(height)
        (cell,) = study.cells()
        paths = folder / f"{height}.nc", folder / f"{height}-response.nc"
        crumple_job(study.crumple_task(cell), paths[0])
        respond_job(study.response_task(cell), *paths)
        crumpled, responded = read_record(paths[0])[0], read_record(paths[1])[0]
        rows.append(
            (
                f"realisation, 500 um, {height / 1000:g} m: crumple to 1e-8 "
                f"({crumpled['steps']:.0f} steps), static, dynamic",
                f"{crumpled['seconds_crumple']:.1f}, {responded['seconds_static']:.1f}, "
                f"{responded['seconds_dynamic']:.1f} s",
            )
        )
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return [*rows, ("peak memory of the above", f"{peak:.0f} MB")]


def overhead_rows(folder: Path) -> list[tuple[str, str]]:
    """Time of a job beyond the physics that it reports, in the worker of a study and by itself."""
    study = task_study(170, ramp_steps=500, relaxation_steps_max=500)
    (cell,) = study.cells()
    paths = [folder / "overhead.nc", folder / "overhead-response.nc"]
    crumple, respond = study.crumple_task(cell), study.response_task(cell)
    jobs = {
        "crumple": ("crumple:crumple_job", crumple, paths[:1], ["seconds_crumple"]),
        "response": ("respond:respond_job", respond, paths, ["seconds_static", "seconds_dynamic"]),
    }
    rows = []
    command = [sys.executable, "-P", str(SCRIPTS / "worker.py")]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True) as worker:
        socket = worker.stdout.readline().strip()
        places = {
            "in the worker": os.environ | {"FOILSTUDY_WORKER": socket},
            "by itself": os.environ,
        }
        for (name, (function, task, files, physics)), place in product(jobs.items(), places):
            words = [f"study.sweep.{function}", task.model_dump_json(), *map(str, files)]
            extra = []
            for _ in range(REPEATS):
                start = time.perf_counter()
                subprocess.run([*JOB, *words], check=True, capture_output=True, env=places[place])
                wall = time.perf_counter() - start
                values, _ = read_record(files[-1])
                extra.append(wall - sum(float(values[key]) for key in physics))
            median = statistics.median(extra)
            rows.append((f"{name} job beyond its physics, {place}", f"{median:.2f} s"))
    return rows


def study_rows(configs: list[str]) -> list[tuple[str, str]]:
    """Wall time of whole studies from nothing to the report."""
    rows = []
    for config in configs:
        name = load_config(config).study.name
        snakemake = str(Path(sys.executable).with_name("snakemake"))
        start = time.perf_counter()
        subprocess.run(
            [snakemake, "-j2", "--forceall", "--configfile", config], check=True, cwd=ROOT
        )
        wall = time.perf_counter() - start
        rows.append((f"study `{name}`, two cores", f"{wall:.0f} s"))
    return rows


def main(configs: list[str]) -> None:
    """Measure and write the table."""
    compile_kernels()
    with tempfile.TemporaryDirectory() as folder:
        rows = kernel_rows() + crumple_rows(Path(folder)) + overhead_rows(Path(folder))
    rows += study_rows(configs)
    lines = ["| | measured |", "|---|---|"]
    lines += [f"| {what} | {value} |" for what, value in rows]
    how = f"{machine()}. Medians of {REPEATS} runs; realisations and studies are single runs."
    text = "\n".join(["# Measured", "", how, "", *lines, ""])
    (ROOT / "benchmarks" / "results.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main(sys.argv[1:])
