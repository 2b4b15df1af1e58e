"""What is there but does not count is made again, whatever became of Snakemake's own notes.

Snakemake decides by the dates of files and by what it has noted in .snakemake, which copying,
cloning or deleting folders changes. The records themselves say what they were made of.
"""

from functools import cache

from foilstudy.present.measured_files import stale_page
from foilstudy.study.kernel.files import stale_results as stale_side_results
from foilstudy.study.stale import sentences
from foilstudy.study.sweep.stale import stale_results


@cache
def make_stale_again(folder):
    """Tell Snakemake which results of a study do not count; no input, so that rules can ask for it.

    As an input function, as these are called while the jobs are found and before it is decided
    which of them run.
    """
    # a job on another machine is told by the main process what to make
    if workflow.is_main_process:
        sides = {f"results/{side.folder}": side for side in STUDIES.values()}
        if folder in sides:
            found = list(stale_side_results(sides[folder], folder))
        else:
            found = list(stale_results(STUDY.simulated, Path(folder), PRESENTED))
            found += stale_page(STUDY, Path(folder, "report.html"))
        for sentence in sentences(folder, found):
            logger.warning(sentence)
        workflow.dag.forcefiles.update(str(each.path) for each in found)
    return []
