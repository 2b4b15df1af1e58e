"""From all realisations to the cube, the tables, the figures and the report."""

CRUMPLES = cell_paths(f"{RESULTS}/realisations/{CELL}/crumple.nc")
RESPONSES = cell_paths(f"{RESULTS}/realisations/{CELL}/response.nc")
REFINED = []
if STUDY.stiffness.relaxed_refinements:
    REFINED = cell_paths(f"{RESULTS}/realisations/{CELL}/refined.nc")

# Label of each table in `snakemake --report`; captions in workflow/report.
TABLES = {
    "powerlaw": "power law",
    "stiffness_summary": "stiffness of each configuration",
    "variability": "coefficient of variation",
    "variability_law": "coefficient of variation against overlength",
    "eigenfrequency_law": "first eigenfrequency law",
    "isolation": "foil links beside a mount",
}
FIGURE_FILES = expand(f"{RESULTS}/figures/{{name}}.{{kind}}", name=FIGURES, kind=["png", "svg"])

# Figures share a job with those of the same input: loading what draws one costs more than drawing.
# Those that read responses wait for all of them; the shapes are drawn without.
FIGURE_JOBS = {"cube": {}, "shapes": {}, "modes": {}}
for name, figure in FIGURES.items():
    source = "modes" if "response_paths" in figure.needs else "shapes"
    FIGURE_JOBS["cube" if "cube" in figure.needs else source][name] = figure


rule cube:
    input:
        cylinder=rules.cylinder.output,
        crumples=CRUMPLES,
        responses=RESPONSES,
        refined=REFINED,
    output:
        f"{RESULTS}/cube.nc",
    params:
        study=STUDY.model_dump_json(),
    log:
        f"{LOGS}/cube.log",
    benchmark:
        f"{BENCHMARKS}/cube.tsv"
    resources:
        mem_mb=2000,
    message:
        "cube"
    shell:
        "{RUN}/cube.py {params.study:q} {RESULTS} {output} > {log} 2>&1"


rule tables:
    input:
        rules.cube.output,
    output:
        [
            report(
                f"{RESULTS}/{name}.csv",
                caption=f"../report/{name}.rst",
                category="Tables",
                labels={"table": label},
            )
            for name, label in TABLES.items()
        ],
    log:
        f"{LOGS}/tables.log",
    benchmark:
        f"{BENCHMARKS}/tables.tsv"
    resources:
        mem_mb=1000,
    message:
        "tables"
    shell:
        "{RUN}/tables.py {input} {RESULTS} > {log} 2>&1"


for source, figures in FIGURE_JOBS.items():

    rule:
        name:
            f"figures_{source}"
        input:
            cube=rules.cube.output,
            crumples=CRUMPLES if source != "cube" else [],
            responses=RESPONSES if source == "modes" else [],
        output:
            [
                report(
                    f"{RESULTS}/figures/{name}.png",
                    caption="../report/figures.rst",
                    category="Figures",
                    labels={"figure": figure.title},
                )
                for name, figure in figures.items()
            ],
            expand(f"{RESULTS}/figures/{{name}}.svg", name=figures),
        params:
            names=list(figures),
            captions={figure.title: figure.caption for figure in figures.values()},
            version=VERSION,
        log:
            f"{LOGS}/figures_{source}.log",
        benchmark:
            f"{BENCHMARKS}/figures_{source}.tsv"
        resources:
            mem_mb=1000,
        message:
            f"figures of the {source}"
        shell:
            "{RUN}/figures.py {RESULTS}/figures {input.cube}"
            " --figures {params.names} --crumples {input.crumples} > {log} 2>&1"


rule report:
    input:
        cube=rules.cube.output,
        tables=rules.tables.output,
        figures=FIGURE_FILES,
        crumples=CRUMPLES,
        responses=RESPONSES,
    output:
        report(
            f"{RESULTS}/report.html",
            caption="../report/report.rst",
            category="Report",
            labels={"page": STUDY.report.title},
        ),
    log:
        f"{LOGS}/report.log",
    benchmark:
        f"{BENCHMARKS}/report.tsv"
    resources:
        mem_mb=1000,
    message:
        "report"
    shell:
        "{RUN}/report.py {RESULTS} {output} {input.crumples} > {log} 2>&1"
