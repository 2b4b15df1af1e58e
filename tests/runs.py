"""Runs of the workflow in a folder of their own."""

import atexit
import os
import re
import signal
import subprocess
import sys
from functools import cache
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[1]
_NAMES = (
    "accuracy.yaml", "limits.yaml", "real.yaml", "specimen.yaml", "tradeoff.yaml", "truth.yaml",
)  # fmt: skip
_OF_SIDE_STUDIES = {ROOT / "config" / name for name in _NAMES}
STUDY_FILES = sorted(set((ROOT / "config").glob("*.yaml")) - _OF_SIDE_STUDIES)
"""Configurations of studies; the others hold settings of side studies."""
SNAKEMAKE = str(Path(sys.executable).with_name("snakemake"))
JOB = [sys.executable, "-I", "-S", str(ROOT / "workflow/scripts/job.py")]
# A worker of the study, but with Snakemake and what its rules import for the kernels.
HOLDER = """
import snakemake.cli
from foilstudy.base.manifest import MANIFEST
from foilstudy.present.figures import FIGURES
from foilstudy.present.statistics.tables import TABLES
from foilstudy.study import worker
from foilstudy.study.registry import STUDIES
from foilstudy.study.sweep import expected, rounds, stale
worker.compile_kernels = bool
worker.work(again=True)
"""


def command(folder, config, *options):
    """Snakemake on the config, which is written into the folder, as is everything it makes."""
    path = folder / "study.yaml"
    path.write_text(yaml.safe_dump(config), encoding="utf-8")
    return [
        SNAKEMAKE,
        *("--snakefile", str(ROOT / "Snakefile"), "--directory", str(folder)),
        *("--configfile", str(path), *options),
    ]


def heed_interrupts():
    """Of a shell's background job, which these tests may be, children would ignore them."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@cache
def holder():
    """Socket of a process that forks one Snakemake per run, and ends with the tests.

    More than half of a dry-run goes into imports and the reading of sources. Tests of the command,
    of malformed files, of signals and of other code start a Snakemake of their own.
    """
    process = subprocess.Popen(
        [sys.executable, "-P", "-c", HOLDER],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,  # as that of a Snakemake, which is not to find it seekable
        text=True,
        cwd=ROOT,
    )
    # its end is that of its standard input
    atexit.register(process.communicate)
    return process.stdout.readline().strip()


def snakemake(folder, config, *options):
    return run(command(folder, config, *options))


def run(words):
    """What a Snakemake says and ends with, in a fork of the holder; by itself where none can be."""
    return subprocess.run(
        [*JOB, *words],
        capture_output=True,
        text=True,
        cwd=ROOT,
        check=False,
        env=os.environ | {"FOILSTUDY_WORKER": holder()},
    )


def plan(folder, config):
    """Number of jobs per rule that a run would start; nothing where all is up to date."""
    run = snakemake(folder, config, "--dry-run")
    assert run.returncode == 0, run.stderr
    header = re.search(r"^\d+ jobs: (.*)$", run.stdout, re.MULTILINE)
    if header is None:
        assert "Nothing to be done" in run.stdout
        return {}
    jobs = (part.split(" ") for part in header[1].split(", "))
    return {rule: int(count) for count, rule in jobs}
