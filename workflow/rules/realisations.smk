"""The fan-out: one crumple and one response per thickness, overlength and seed."""


rule crumple:
    input:
        lambda wildcards: make_stale_again(RESULTS),
    output:
        CRUMPLE,
    params:
        task=crumple_task,
    log:
        f"{LOGS}/crumple/{CELL_FLAT}.log",
    benchmark:
        f"{BENCHMARKS}/crumple/{CELL_FLAT}.tsv"
    resources:
        mem_mb=memory,
    message:
        "crumple {wildcards.thickness} {wildcards.overlength} seed {wildcards.seed}"
    shell:
        "{RUN} study.sweep.crumple:crumple_job {params.task:q} {output} > {log} 2>&1"


rule response:
    input:
        rules.crumple.output,
    output:
        RESPONSE,
    params:
        task=response_task,
    # Finished realisations first: an interrupted study then holds whole ones.
    priority: 1
    log:
        f"{LOGS}/response/{CELL_FLAT}.log",
    benchmark:
        f"{BENCHMARKS}/response/{CELL_FLAT}.tsv"
    resources:
        mem_mb=memory,
    message:
        "response {wildcards.thickness} {wildcards.overlength} seed {wildcards.seed}"
    shell:
        "{RUN} study.sweep.respond:respond_job {params.task:q} {input} {output} > {log} 2>&1"


rule refine:
    input:
        rules.crumple.output,
    output:
        REFINED,
    params:
        task=refine_task,
    priority: 1
    log:
        f"{LOGS}/refine/{CELL_FLAT}.log",
    benchmark:
        f"{BENCHMARKS}/refine/{CELL_FLAT}.tsv"
    resources:
        mem_mb=memory,
    message:
        "refine {wildcards.thickness} {wildcards.overlength} seed {wildcards.seed}"
    shell:
        "{RUN} study.sweep.relax_refined:refine_job {params.task:q} {input} {output} > {log} 2>&1"


rule cylinder:
    input:
        lambda wildcards: make_stale_again(RESULTS),
    output:
        f"{RESULTS}/cylinder.nc",
    params:
        study=lambda wildcards: STUDY.cylinder_task(),
    log:
        f"{LOGS}/cylinder.log",
    benchmark:
        f"{BENCHMARKS}/cylinder.tsv"
    resources:
        mem_mb=1000,
    message:
        "stiffness of the uncrumpled cylinders"
    shell:
        "{RUN} study.sweep.cylinder:cylinder_bounds {params.study:q} {output} > {log} 2>&1"
