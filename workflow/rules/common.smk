"""The study, its paths, and the checks that come before any job."""

import fcntl
import os
import shlex
import subprocess
import sys
from pathlib import Path

from foilstudy.base.errors import Refusal
from foilstudy.base.manifest import MANIFEST
from foilstudy.base.numerals import duration
from foilstudy.config import ConfigError, load_merged
from foilstudy.config.chosen import choices
from foilstudy.config.slips import likely_slips
from foilstudy.present.figures import FIGURES
from foilstudy.present.files import StudyFiles
from foilstudy.present.measured_files import measured_of
from foilstudy.present.shown import shown
from foilstudy.study.registry import refuse_reserved_name
from foilstudy.study.sweep.expected import MEMORY_SPREAD, costly, expected
from snakemake.logging import logger


DEFAULT_CONFIG = "config/config.yaml"


def refuse(problem):
    """Stop before any job with the problem alone, not a traceback."""
    logger.error(str(problem))
    sys.exit(1)


def read_study():
    """The validated study, of the files and words themselves: Snakemake reads them by YAML 1.1."""
    files = [os.path.relpath(file) for file in workflow.configfiles or [DEFAULT_CONFIG]]
    return load_merged(files, workflow.config_settings.config_args or ())


try:
    STUDY = read_study()
    refuse_reserved_name(STUDY.study.name)
except ConfigError as problem:
    refuse(problem)

try:
    measured_of(STUDY)  # what cannot be read is refused before hours of physics
except Refusal as problem:
    refuse(problem)

RESULTS = f"results/{STUDY.study.name}"
LOGS = f"{RESULTS}/logs"
BENCHMARKS = f"{RESULTS}/benchmarks"
COST = expected(STUDY)
MEMORY_MB = {
    (each.thickness_um, each.reference_height_mm): each.most_memory_mb
    for each in COST.configurations
}
PRESENTED = shown(StudyFiles(Path(RESULTS, "cube.nc")))
RESULTS_LOCKS = []
# The interpreter that runs Snakemake, whether or not its environment is activated. A rule writes
# "{RUN} MODULE:FUNCTION words". Plain commands can be repeated by hand, and spare each job the
# import of Snakemake by `script:`; job.py spares it that of everything else, where there is a
# worker.
SCRIPTS = Path(workflow.basedir, "workflow/scripts")
RUN = shlex.join([sys.executable, "-I", "-S", f"{SCRIPTS}/job.py", f"{SCRIPTS}/call.py"])
# Another study's: this one may be a job of it, or run on another machine.
os.environ.pop("FOILSTUDY_WORKER", None)

CELL = "{thickness}/{overlength}/{seed}"
CELL_FLAT = "{thickness}_{overlength}_{seed}"
CRUMPLE = f"{RESULTS}/realisations/{CELL}/crumple.nc"
RESPONSE = f"{RESULTS}/realisations/{CELL}/response.nc"
REFINED = f"{RESULTS}/realisations/{CELL}/refined.nc"
EXPORT = f"{RESULTS}/realisations/{CELL}/export"


wildcard_constraints:
    thickness=r"t[0-9p]+um",
    overlength=r"h[0-9p]+mm",
    seed=r"[0-9]+",


# Texts of a configuration reach a rule through functions of `params` alone: anywhere else,
# Snakemake takes what stands in braces for a wildcard.


def cell_paths(pattern, cells):
    """The pattern's path for each of some realisations."""
    return [
        pattern.format(thickness=c.thickness_id, overlength=c.overlength_id, seed=c.seed)
        for c in cells
    ]


def crumple_task(wildcards):
    """JSON of all that decides how the realisation crumples."""
    return STUDY.crumple_task(STUDY.cell(*wildcards)).model_dump_json()


def response_task(wildcards):
    """JSON of all that decides how the crumpled realisation responds."""
    return STUDY.response_task(STUDY.cell(*wildcards)).model_dump_json()


def memory(wildcards):
    """MB for the largest job of a realisation, as expected; for schedulers that ask."""
    cell = STUDY.cell(*wildcards)
    return max(1000, round(MEMORY_SPREAD * MEMORY_MB[cell.thickness_um, cell.reference_height_mm]))


def refine_task(wildcards):
    """JSON of all that decides what refining makes of the crumpled realisation."""
    return STUDY.refine_task(STUDY.cell(*wildcards)).model_dump_json()


def refuse_results(reason, results=RESULTS):
    refuse(f"{results}: cannot be written ({reason}); change that, or run from another folder.")


def check_results():
    """See that the results can be written, without making anything: a dry-run comes here too."""
    folder = Path(RESULTS)
    while not folder.exists():
        if folder.is_symlink():
            refuse_results(f"{folder} is a link to {folder.readlink()}, which is not there")
        folder = folder.parent
    if not folder.is_dir():
        refuse_results(f"{folder} is not a folder")
    if not os.access(folder, os.W_OK | os.X_OK):
        refuse_results(f"no permission to write into {folder.resolve()}")


def claim_results():
    """Keep other runs out of every folder of results that this one writes, until it ends.

    The kernel drops such a lock with the process that holds it, however that ends. Snakemake's own
    lock files (off in profiles/default) would outlive a killed run and block the next.
    """
    written = (Path(file).parts for job in workflow.dag.needrun_jobs() for file in job.output)
    for folder in sorted({"/".join(parts[:2]) for parts in written if parts[0] == "results"}):
        try:
            Path(folder).mkdir(parents=True, exist_ok=True)
            RESULTS_LOCKS.append(open(f"{folder}/.lock", "w"))
        except OSError as problem:
            refuse_results(problem.strerror, folder)
        try:
            fcntl.flock(RESULTS_LOCKS[-1], fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            remedy = ", or give this one another study.name" if folder == RESULTS else ""
            refuse(f"{folder}: another run is writing this study; wait until it ends{remedy}.")
        except OSError as problem:
            # a file system without locks
            logger.warning(f"{folder}: not locked ({problem.strerror}); start no second run on it.")


def start_worker():
    """Fill the kernel cache before the fan-out, and keep a process that has everything loaded.

    Two processes writing the cache at once have crashed. In every run rather than as a rule,
    because the cache belongs to this machine and installation and not to the results. The worker
    ends with this process, however that ends, as its standard input does.
    """
    global worker
    log = Path(LOGS, "worker.log")
    log.parent.mkdir(parents=True, exist_ok=True)
    command = [sys.executable, "-P", f"{SCRIPTS}/worker.py"]
    if STUDY.contact.kind != "none":
        command.append("contact")
    with log.open("a") as errors:  # a run of another study may be writing to it
        # -P keeps a script's own folder from hiding modules.
        worker = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=errors, text=True
        )
    ready = worker.stdout.readline()
    if not ready:
        refuse(f"the kernels could not be compiled; {log} says why.")
    if ready.strip():
        os.environ["FOILSTUDY_WORKER"] = ready.strip()


check_results()


def warn_of_slips():
    """Name what is possible but most likely not meant, as `foilstudy check` does."""
    for slip in [*likely_slips(STUDY), *costly(COST)]:
        logger.warning(f"Most likely a slip: {slip}")


def tell_choices():
    """Say what the accuracy made of the study, and what all of it costs."""
    cost = f"about {duration(COST.processor_seconds, 2)} of processor time for the whole study"
    logger.info("\n".join([*choices(STUDY), f"  {cost}"]))


onstart:
    tell_choices()
    warn_of_slips()
    claim_results()
    start_worker()
