"""From all realisations to the cube, the tables, the figures and the report."""

from foilstudy.present.statistics.tables import TABLES

FIGURE_FILES = expand(f"{RESULTS}/figures/{{name}}.{{kind}}", name=FIGURES, kind=["png", "svg"])


rule cube:
    input:
        cylinder=rules.cylinder.output,
        crumples=of_all(CRUMPLE),
        responses=of_all(RESPONSE),
        refined=of_all(REFINED) if STUDY.stiffness.relaxed_refinements else [],
    output:
        f"{RESULTS}/cube.nc",
    params:
        study=lambda wildcards: STUDY.simulated.model_dump_json(),
    log:
        f"{LOGS}/cube.log",
    benchmark:
        f"{BENCHMARKS}/cube.tsv"
    resources:
        mem_mb=2000,
    message:
        "cube"
    shell:
        "{RUN} study.sweep.cube:gather {params.study:q} {RESULTS} {output} > {log} 2>&1"


rule tables:
    input:
        rules.cube.output,
    output:
        [
            report(
                f"{RESULTS}/{name}.csv",
                caption="../report/tables.rst",
                category="Tables",
                labels={"table": table.title},
            )
            for name, table in TABLES.items()
        ],
    params:
        captions=[f"**{name}.csv:** {table.words}" for name, table in TABLES.items()],
    log:
        f"{LOGS}/tables.log",
    benchmark:
        f"{BENCHMARKS}/tables.tsv"
    resources:
        mem_mb=1000,
    message:
        "tables"
    shell:
        "{RUN} present.jobs:tables {input} > {log} 2>&1"


def figure_input(need, files):
    """What an input function returns, where the figure is drawn from that."""
    return lambda wildcards: files(wildcards) if need in FIGURES[wildcards.figure].needs else []


# The shapes need no cube and are the longest to draw: they fill the cores while responses end.
rule figure:
    input:
        cube=figure_input("cube", lambda wildcards: rules.cube.output),
        crumples=figure_input("crumple_paths", of_all(CRUMPLE)),
        responses=figure_input("response_paths", of_all(RESPONSE)),
    output:
        report(
            f"{RESULTS}/figures/{{figure}}.png",
            caption="../report/figure.rst",
            category="Figures",
            labels=lambda wildcards: {"figure": FIGURES[wildcards.figure].title},
        ),
        f"{RESULTS}/figures/{{figure}}.svg",
    params:
        title=lambda wildcards: FIGURES[wildcards.figure].title,
        caption=lambda wildcards: FIGURES[wildcards.figure].caption,
    log:
        f"{LOGS}/figures/{{figure}}.log",
    benchmark:
        f"{BENCHMARKS}/figures/{{figure}}.tsv"
    resources:
        mem_mb=1000,
    wildcard_constraints:
        figure="|".join(FIGURES),
    message:
        "figure {wildcards.figure}"
    shell:
        "{RUN} present.jobs:figure {wildcards.figure} {RESULTS} {input.crumples} > {log} 2>&1"


# Measurements on the page are no input, as Snakemake takes braces in a name for a wildcard: the page
# is made again when they have changed, by what its manifest holds (stale.smk).
rule report:
    input:
        cube=rules.cube.output,
        tables=rules.tables.output,
        figures=FIGURE_FILES,
        crumples=of_all(CRUMPLE),
        responses=of_all(RESPONSE),
    output:
        report(
            f"{RESULTS}/report.html",
            caption="../report/report.rst",
            category="Report",
            # not its title, in which Snakemake would look for wildcards
            labels={"page": STUDY.study.name},
        ),
        f"{RESULTS}/{MANIFEST}",
    params:
        study=lambda wildcards: STUDY.model_dump_json(),
    log:
        f"{LOGS}/report.log",
    benchmark:
        f"{BENCHMARKS}/report.tsv"
    resources:
        mem_mb=1000,
    message:
        "report"
    shell:
        "{RUN} present.jobs:report {params.study:q} {output[0]} {input.crumples} > {log} 2>&1"
