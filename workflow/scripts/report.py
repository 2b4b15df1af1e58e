"""The page of a study: report.py RESULTS REPORT_HTML CRUMPLE_NC..."""

import sys
from pathlib import Path

from foilstudy.present.files import StudyFiles
from foilstudy.present.report import write_report

results, report_html, *crumples = map(Path, sys.argv[1:])
write_report(StudyFiles(results / "cube.nc", tuple(crumples)), report_html)
