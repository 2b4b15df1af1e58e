"""The side studies of foilstudy.study.registry: snakemake -j2 verify, and so on by their names.

One rule per part, one that presents the records, and the target.
"""

import re

from foilstudy.study.registry import STUDIES


for side in STUDIES.values():
    FOLDER = f"results/{side.folder}"

    for part in side.parts:

        rule:
            name:
                f"{side.name}_{part.name}"
            input:
                lambda wildcards, side=side, part=part, folder=FOLDER: [
                    f"{folder}/{file}" for file in side.needed(part, wildcards.case)
                ]
                + make_stale_again(folder),
            output:
                [f"{FOLDER}/{file}" for file in part.files("{case}")],
            wildcard_constraints:
                case="|".join(map(re.escape, part.by_name)),
            params:
                study=side.name,
                part=part.name,
            priority: part.priority
            log:
                f"{FOLDER}/logs/{part.name}/{{case}}.log",
            resources:
                mem_mb=lambda wildcards, part=part: part.memory(wildcards.case),
            message:
                f"{side.name}: {part.name} of {{wildcards.case}}"
            shell:
                "{RUN} study.jobs:measure {params.study} {params.part} {wildcards.case} {output[0]}"
                " {input} > {log} 2>&1"

    rule:
        name:
            f"{side.name}_present"
        input:
            [f"{FOLDER}/{file}" for file in side.records()],
        output:
            [f"{FOLDER}/{file}" for file in (*side.outputs(), MANIFEST)],
        params:
            study=side.name,
            folder=FOLDER,
        log:
            f"{FOLDER}/logs/present.log",
        resources:
            mem_mb=2000,
        message:
            f"{side.name}: tables and figures"
        shell:
            "{RUN} study.jobs:present {params.study} {params.folder} > {log} 2>&1"

    # Apart from the tables, so that a study that misses its demands leaves all results behind.
    rule:
        name:
            side.name
        localrule: True
        input:
            [f"{FOLDER}/{file}" for file in side.outputs()],
        params:
            study=side.name,
            folder=FOLDER,
        log:
            f"{FOLDER}/logs/check.log",
        message:
            f"{side.title}: see {FOLDER}"
        shell:
            "{RUN} study.jobs:check {params.study} {params.folder} > {log} 2>&1"
