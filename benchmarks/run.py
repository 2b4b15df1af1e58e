"""Measure what jobs and studies cost, a section of benchmarks/results.md.

    .venv/bin/python benchmarks/run.py                                 parts of a job, a minute
    .venv/bin/python benchmarks/run.py config/config.yaml [...]        whole studies as well

Medians of several runs on one core; studies with `snakemake -j2 --forceall`, which makes their
results again. Run it on a machine that does nothing else. `kernel.py` has the kernels.
"""

from __future__ import annotations

import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from itertools import product
from pathlib import Path

from measuring import REPEATS, ROOT, physics_share, timed, write_section

from foilstudy.base.provenance import machine
from foilstudy.base.record import read_record
from foilstudy.base.tables import markdown_table
from foilstudy.config import load_config
from foilstudy.pipeline.crumple import uncrumpled
from foilstudy.pipeline.method import Mesh
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import Ramp, Scheme, StoppingRule, relax
from foilstudy.study.published import foil
from foilstudy.study.sweep.crumple import crumple_job
from foilstudy.study.sweep.respond import respond_job
from foilstudy.study.sweep.warmup import compile_kernels

SCRIPTS = ROOT / "workflow/scripts"
JOB = [sys.executable, "-I", "-S", str(SCRIPTS / "job.py"), str(SCRIPTS / "call.py")]
FOIL = foil(500, 170)


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


def crumple_rows(folder: Path) -> list[tuple[str, str]]:
    """One crumple of exactly 4000 steps, then whole realisations."""
    problem, scheme = Problem(uncrumpled(FOIL, Mesh(5e-3)).stressed), Scheme()
    ramp, rule = Ramp(FOIL.shortening, 2000), StoppingRule(0.0, 2000)
    seconds = timed(lambda: relax(problem, scheme.start(problem), ramp, rule)).median
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
    """Wall time of whole studies from nothing to the report, and what of their jobs is physics."""
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
        share = physics_share(ROOT / "results" / name)
        rows.append((f"study `{name}`, physics of the time of its jobs", str(share)))
    return rows


def main(configs: list[str]) -> None:
    """Measure and write the table."""
    compile_kernels()
    with tempfile.TemporaryDirectory() as folder:
        rows = crumple_rows(Path(folder)) + overhead_rows(Path(folder))
    rows += study_rows(configs)
    how = (
        f"{machine()}. Medians of {REPEATS} runs; realisations and studies are single runs. Jobs "
        "by themselves take the fingerprints of the code; in the worker these are taken once."
    )
    write_section("Jobs and studies", f"{how}\n\n{markdown_table(['', 'measured'], rows)}")


if __name__ == "__main__":
    main(sys.argv[1:])
