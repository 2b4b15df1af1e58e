"""Convergence of the crumple with the mesh and with the residual: snakemake -j2 convergence."""

from foilstudy.study.convergence import plan as CONVERGENCE_PLAN

CONVERGENCE = "results/convergence"
CONVERGENCE_FIGURES = ["energy", "stiffness", "stabilisation", "run_time", "stops"]


def convergence_records(folder, cases):
    return [f"{CONVERGENCE}/{folder}/{case.name}.json" for case in cases]


def crumple_memory(wildcards):
    """MB; the tangent of the finest mesh is what counts."""
    return 6000 if CONVERGENCE_PLAN.Case.named(wildcards.case).size_mm < 2 else 3000


localrules:
    convergence,


rule convergence_crumple:
    output:
        f"{CONVERGENCE}/crumples/{{case}}.json",
    params:
        version=VERSION,
    log:
        f"{CONVERGENCE}/logs/crumples_{{case}}.log",
    resources:
        mem_mb=crumple_memory,
    message:
        "convergence: {wildcards.case}"
    shell:
        "{RUN}/convergence_crumple.py {wildcards.case} {output} > {log} 2>&1"


rule convergence_levels:
    output:
        f"{CONVERGENCE}/levels/{{case}}.json",
    params:
        version=VERSION,
    priority: 1
    log:
        f"{CONVERGENCE}/logs/levels_{{case}}.log",
    resources:
        mem_mb=6000,
    message:
        "convergence: {wildcards.case} refined"
    shell:
        "{RUN}/convergence_levels.py {wildcards.case} {output} > {log} 2>&1"


rule convergence_stops:
    output:
        f"{CONVERGENCE}/stops/{{case}}.json",
    params:
        version=VERSION,
    log:
        f"{CONVERGENCE}/logs/stops_{{case}}.log",
    resources:
        mem_mb=1000,
    message:
        "convergence: {wildcards.case} stopped early"
    shell:
        "{RUN}/convergence_stops.py {wildcards.case} {output} > {log} 2>&1"


# Last, when the machine is emptier: it takes the least of several times, but shared caches count.
rule convergence_timing:
    output:
        f"{CONVERGENCE}/timing.json",
    params:
        version=VERSION,
    priority: -1
    log:
        f"{CONVERGENCE}/logs/timing.log",
    resources:
        mem_mb=1000,
    message:
        "convergence: time per step"
    shell:
        "{RUN}/convergence_timing.py {output} > {log} 2>&1"


rule convergence:
    input:
        convergence_records("crumples", CONVERGENCE_PLAN.crumples()),
        convergence_records("levels", CONVERGENCE_PLAN.MULTILEVEL),
        convergence_records("stops", CONVERGENCE_PLAN.STOPPED),
        rules.convergence_timing.output,
    output:
        f"{CONVERGENCE}/convergence.csv",
        f"{CONVERGENCE}/stops.csv",
        f"{CONVERGENCE}/convergence.md",
        expand(f"{CONVERGENCE}/{{name}}.{{kind}}", name=CONVERGENCE_FIGURES, kind=["png", "svg"]),
    log:
        f"{CONVERGENCE}/logs/summary.log",
    message:
        f"convergence study: see {CONVERGENCE}/convergence.md"
    shell:
        "{RUN}/convergence_summary.py {CONVERGENCE} > {log} 2>&1"
