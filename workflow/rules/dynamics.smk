"""Reductions held against the full order: snakemake -j2 dynamics."""

from foilstudy.study.dynamics import plan as DYNAMICS_PLAN

DYNAMICS = "results/dynamics"
DYNAMICS_FIGURES = ["cutoff", "cost", "frequency", "mac"]


def dynamics_shape(wildcards):
    """The crumple on 5 mm that a model is made of."""
    return f"{DYNAMICS}/shapes/{wildcards.model.rsplit('_r', 1)[0]}.npz"


def dynamics_records(folder, models):
    return [f"{DYNAMICS}/{folder}/{model.name}.json" for model in models]


def chart_memory(wildcards):
    """MB; on the finest mesh the modes count."""
    return {0: 1500, 1: 3000, 2: 8000}[DYNAMICS_PLAN.Model.named(wildcards.model).refinements]


localrules:
    dynamics,


rule dynamics_shape:
    output:
        f"{DYNAMICS}/shapes/{{shape}}.npz",
    params:
        version=VERSION,
    log:
        f"{DYNAMICS}/logs/shape_{{shape}}.log",
    resources:
        mem_mb=1000,
    message:
        "dynamics: crumple {wildcards.shape}"
    shell:
        "{RUN}/dynamics_shape.py {wildcards.shape}_r0 {output} > {log} 2>&1"


rule dynamics_chart:
    input:
        dynamics_shape,
    output:
        f"{DYNAMICS}/charts/{{model}}.json",
    params:
        version=VERSION,
    log:
        f"{DYNAMICS}/logs/chart_{{model}}.log",
    resources:
        mem_mb=chart_memory,
    message:
        "dynamics: reductions of {wildcards.model}"
    shell:
        "{RUN}/dynamics_chart.py {wildcards.model} {input} {output} > {log} 2>&1"


rule dynamics_check:
    input:
        dynamics_shape,
    output:
        f"{DYNAMICS}/checks/{{model}}.json",
    params:
        version=VERSION,
    log:
        f"{DYNAMICS}/logs/check_{{model}}.log",
    resources:
        mem_mb=1500,
    message:
        "dynamics: default reduction of {wildcards.model}"
    shell:
        "{RUN}/dynamics_check.py {wildcards.model} {input} {output} > {log} 2>&1"


rule dynamics:
    input:
        dynamics_records("charts", DYNAMICS_PLAN.CHARTED),
        dynamics_records("checks", DYNAMICS_PLAN.CHECKED),
    output:
        f"{DYNAMICS}/reductions.csv",
        f"{DYNAMICS}/checks.csv",
        f"{DYNAMICS}/dynamics.md",
        expand(f"{DYNAMICS}/{{name}}.{{kind}}", name=DYNAMICS_FIGURES, kind=["png", "svg"]),
    log:
        f"{DYNAMICS}/logs/summary.log",
    message:
        f"dynamics study: see {DYNAMICS}/dynamics.md"
    shell:
        "{RUN}/dynamics_summary.py {DYNAMICS} > {log} 2>&1"
