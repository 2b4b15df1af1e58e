"""From one config file to a report: crumple, measure, gather, fit, draw, write.

    snakemake -j2                                      config/config.yaml
    snakemake -j2 --configfile config/thesis.yaml      another study

Everything a study makes lies in results/NAME, NAME being `study.name` of its config.
"""

import os

# One thread per job, -j says how many jobs: numerical libraries must neither oversubscribe the
# cores nor change the order of their sums with the number of them. What the user's shell asks of
# them (other layers, code paths, all jobs bound to one core) is not for this run.
for variable in tuple(os.environ):
    if variable.startswith(("OMP_", "KMP_", "GOMP_", "MKL_", "OPENBLAS_")):
        del os.environ[variable]
for variable in ("OMP", "MKL", "OPENBLAS", "NUMBA"):
    os.environ[f"{variable}_NUM_THREADS"] = "1"


report: "workflow/report/workflow.rst"


include: "workflow/rules/common.smk"


# A user's config replaces the default one; merged, the two would make a third that nobody wrote.
if not workflow.configfiles:
    configfile: DEFAULT_CONFIG


include: "workflow/rules/stale.smk"
include: "workflow/rules/rounds.smk"
include: "workflow/rules/realisations.smk"
include: "workflow/rules/results.smk"
include: "workflow/rules/export.smk"
include: "workflow/rules/studies.smk"


localrules:
    study,


rule study:
    default_target: True
    input:
        rules.report.output,
        rules.tables.output,
        FIGURE_FILES,
        EXPORTS,
    message:
        f"study {STUDY.study.name}: see {RESULTS}/report.html"
