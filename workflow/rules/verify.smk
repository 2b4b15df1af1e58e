"""The benchmarks of the shell with every element: snakemake -j2 verify."""

from foilstudy.study.verification.registry import ELEMENT_NAMES
from foilstudy.study.verification.registry import MODULES as BENCHMARK_NAMES

VERIFICATION = "results/verification"
BENCHMARK_RECORD = f"{VERIFICATION}/{{element}}/{{name}}.json"
# for the table: the elements of one benchmark follow each other
BENCHMARK_RECORDS = [
    BENCHMARK_RECORD.format(element=element, name=name)
    for name in BENCHMARK_NAMES
    for element in ELEMENT_NAMES
]
BENCHMARK_FIGURES = expand(f"{VERIFICATION}/figures/{{name}}.png", name=BENCHMARK_NAMES)


localrules:
    verify,


rule verify_benchmark:
    output:
        BENCHMARK_RECORD,
    params:
        version=VERSION,
    log:
        f"{VERIFICATION}/logs/{{element}}/{{name}}.log",
    benchmark:
        f"{VERIFICATION}/benchmarks/{{element}}/{{name}}.tsv"
    resources:
        mem_mb=2000,
    wildcard_constraints:
        name="|".join(BENCHMARK_NAMES),
        element="|".join(ELEMENT_NAMES),
    message:
        "verify {wildcards.name} with element {wildcards.element}"
    shell:
        "{RUN}/verify_benchmark.py {wildcards.name} {wildcards.element} {output} > {log} 2>&1"


rule verify_figure:
    input:
        expand(BENCHMARK_RECORD, element=ELEMENT_NAMES, allow_missing=True),
    output:
        png=f"{VERIFICATION}/figures/{{name}}.png",
        svg=f"{VERIFICATION}/figures/{{name}}.svg",
    params:
        version=VERSION,
    log:
        f"{VERIFICATION}/logs/figures/{{name}}.log",
    resources:
        mem_mb=1000,
    wildcard_constraints:
        name="|".join(BENCHMARK_NAMES),
    message:
        "figure of {wildcards.name}"
    shell:
        "{RUN}/verify_figure.py {output.png} {input} > {log} 2>&1"


rule verify_summary:
    input:
        BENCHMARK_RECORDS,
    output:
        csv=f"{VERIFICATION}/verification.csv",
        markdown=f"{VERIFICATION}/verification.md",
    params:
        version=VERSION,
    log:
        f"{VERIFICATION}/logs/summary.log",
    resources:
        mem_mb=500,
    message:
        "table of the benchmarks"
    shell:
        "{RUN}/verify_summary.py {output} {input} > {log} 2>&1"


# Apart from the table, so that a benchmark that misses its tolerance leaves all results behind.
rule verify:
    input:
        tables=rules.verify_summary.output,
        figures=BENCHMARK_FIGURES,
        records=BENCHMARK_RECORDS,
    log:
        f"{VERIFICATION}/logs/verify.log",
    message:
        f"what the benchmarks miss, if anything; see {VERIFICATION}/verification.md"
    shell:
        "{RUN}/verify_check.py {input.records} > {log} 2>&1"
