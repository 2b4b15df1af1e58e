"""Runs of the workflow in a folder of their own."""

import re
import signal
import subprocess
import sys
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[1]
_OF_SIDE_STUDIES = {ROOT / "config" / name for name in ("tradeoff.yaml", "limits.yaml")}
STUDY_FILES = sorted(set((ROOT / "config").glob("*.yaml")) - _OF_SIDE_STUDIES)
"""Configurations of studies; the others hold settings of side studies."""
SNAKEMAKE = str(Path(sys.executable).with_name("snakemake"))


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


def snakemake(folder, config, *options):
    return subprocess.run(
        command(folder, config, *options), capture_output=True, text=True, cwd=ROOT, check=False
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
