"""Element variants, error against cost: snakemake -j2 elements."""

from foilstudy.study.elements import VARIANT_NAMES

ELEMENT_STUDY = "results/elements"
FROZEN_UM = [50, 250, 500, 1000]
FINE_MM = ["2.5", "1.25"]


localrules:
    elements,


wildcard_constraints:
    variant="|".join(VARIANT_NAMES),
    micrometres=r"\d+",
    millimetres=r"[\d.]+",


rule elements_fine:
    output:
        f"{ELEMENT_STUDY}/fine_{{millimetres}}mm.json",
    params:
        version=VERSION,
    priority: 3
    log:
        f"{ELEMENT_STUDY}/logs/fine_{{millimetres}}mm.log",
    resources:
        mem_mb=2000,
    message:
        "default element, {wildcards.millimetres} mm"
    shell:
        "{RUN}/elements_fine.py {wildcards.millimetres} {output} > {log} 2>&1"


rule elements_frozen:
    output:
        f"{ELEMENT_STUDY}/frozen_t{{micrometres}}um.npz",
    params:
        version=VERSION,
    priority: 2
    log:
        f"{ELEMENT_STUDY}/logs/frozen_t{{micrometres}}um.log",
    resources:
        mem_mb=4000,
    message:
        "crumple of {wildcards.micrometres} um and its refined stiffness"
    shell:
        "{RUN}/elements_frozen.py {wildcards.micrometres} {output} > {log} 2>&1"


rule elements_buckled:
    output:
        f"{ELEMENT_STUDY}/buckled.json",
    params:
        version=VERSION,
    priority: 2
    log:
        f"{ELEMENT_STUDY}/logs/buckled.log",
    resources:
        mem_mb=2000,
    message:
        "post-buckling energy, refined"
    shell:
        "{RUN}/elements_buckled.py {output} > {log} 2>&1"


rule elements_variant:
    input:
        expand(rules.elements_frozen.output, micrometres=FROZEN_UM),
    output:
        f"{ELEMENT_STUDY}/variants/{{variant}}.json",
    params:
        version=VERSION,
    log:
        f"{ELEMENT_STUDY}/logs/{{variant}}.log",
    resources:
        mem_mb=1000,
    message:
        "errors of {wildcards.variant}"
    shell:
        "{RUN}/elements_variant.py {wildcards.variant} {output} {input} > {log} 2>&1"


rule elements_crumple:
    output:
        f"{ELEMENT_STUDY}/crumples/{{variant}}.json",
    params:
        version=VERSION,
    log:
        f"{ELEMENT_STUDY}/logs/crumple_{{variant}}.log",
    resources:
        mem_mb=1000,
    message:
        "crumples by {wildcards.variant}"
    shell:
        "{RUN}/elements_crumple.py {wildcards.variant} {output} > {log} 2>&1"


# Last, and alone on its core: it takes ratios within one run, but a full machine blurs them.
rule elements_cost:
    output:
        f"{ELEMENT_STUDY}/cost.json",
    params:
        version=VERSION,
    priority: -1
    log:
        f"{ELEMENT_STUDY}/logs/cost.log",
    resources:
        mem_mb=1000,
    message:
        "cost of the elements"
    shell:
        "{RUN}/elements_cost.py {output} > {log} 2>&1"


rule elements:
    input:
        expand(rules.elements_fine.output, millimetres=FINE_MM),
        expand(rules.elements_frozen.output, micrometres=FROZEN_UM),
        rules.elements_buckled.output,
        expand(rules.elements_variant.output, variant=VARIANT_NAMES),
        expand(rules.elements_crumple.output, variant=VARIANT_NAMES),
        rules.elements_cost.output,
    output:
        expand(f"{ELEMENT_STUDY}/elements.{{kind}}", kind=["csv", "md", "png", "svg"]),
    log:
        f"{ELEMENT_STUDY}/logs/summary.log",
    message:
        f"chart of the elements; see {ELEMENT_STUDY}/elements.md"
    shell:
        "{RUN}/elements_summary.py {ELEMENT_STUDY} > {log} 2>&1"
