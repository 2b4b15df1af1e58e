"""Every realisation in the formats of other tools, where `export.formats` asks for some."""

EXPORTS = of_all(EXPORT) if STUDY.export.formats else []


rule export:
    input:
        rules.crumple.output,
    # A folder, as a realisation that cannot be exported leaves its reason alone.
    output:
        directory(EXPORT),
    params:
        task=response_task,
        formats=list(STUDY.export.formats),
    log:
        f"{LOGS}/export/{CELL_FLAT}.log",
    benchmark:
        f"{BENCHMARKS}/export/{CELL_FLAT}.tsv"
    resources:
        mem_mb=memory,
    message:
        "export {wildcards.thickness} {wildcards.overlength} seed {wildcards.seed}"
    shell:
        "{RUN} study.sweep.export:export_realisation {params.task:q} {input} {output}"
        " {params.formats} > {log} 2>&1"
