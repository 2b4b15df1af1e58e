"""Which realisations a study has; with `sweep.realisations: auto` their number grows in rounds.

Each round is a checkpoint: Snakemake makes it from the responses so far, and then asks the input
functions below again, as what these return follows from it.
"""

from itertools import count

from foilstudy.study.sweep.rounds import Round, first_cells


def wanted_cells():
    """Realisations of the study, of all rounds there are to be; ends where one is not made yet."""
    if not STUDY.sweep.in_rounds:
        return STUDY.cells()
    for number in count():
        made = made_round(number)
        if made.is_last:
            return made.cells(STUDY)


def made_round(number):
    return Round.read(checkpoints.round.get(round=number).output[0])


def of_all(pattern):
    """Input function: the pattern's path for every realisation of the study."""
    return lambda wildcards: cell_paths(pattern, wanted_cells())


def responses_of_round(wildcards):
    """Those of the round, and of all before it."""
    number = int(wildcards.round)
    cells = made_round(number - 1).cells(STUDY) if number else first_cells(STUDY)
    return cell_paths(RESPONSE, cells)


if STUDY.sweep.in_rounds:

    checkpoint round:
        input:
            responses_of_round,
        output:
            f"{RESULTS}/rounds/{{round}}.json",
        params:
            study=lambda wildcards: STUDY.model_dump_json(),
        wildcard_constraints:
            round=r"[0-9]+",
        # nothing else can go on before it
        priority: 2
        log:
            f"{LOGS}/rounds/{{round}}.log",
        benchmark:
            f"{BENCHMARKS}/rounds/{{round}}.tsv"
        resources:
            mem_mb=1000,
        message:
            "round {wildcards.round}"
        shell:
            "{RUN} study.sweep.rounds:round_job {params.study:q} {wildcards.round} {RESULTS}"
            " {output} > {log} 2>&1"
