"""The page of a study: report.py RESULTS REPORT_HTML CRUMPLE_NC..."""

import sys
from pathlib import Path

from foilstudy.present.report import ReportInputs, write_report

results, report_html, *crumples = map(Path, sys.argv[1:])
write_report(
    ReportInputs(
        cube_path=results / "cube.nc",
        powerlaw_csv=results / "powerlaw.csv",
        variability_csv=results / "variability.csv",
        eigenfrequency_csv=results / "eigenfrequency_law.csv",
        stiffness_summary_csv=results / "stiffness_summary.csv",
        isolation_csv=results / "isolation.csv",
        figures_dir=results / "figures",
        crumple_paths=crumples,
        # the response of a realisation lies beside its crumple
        response_paths=[crumple.with_name("response.nc") for crumple in crumples],
        benchmarks_dir=results / "benchmarks",
    ),
    report_html,
)
