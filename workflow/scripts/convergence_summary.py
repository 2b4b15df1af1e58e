"""Table, text and figures of the convergence study: convergence_summary.py FOLDER."""

import sys
from pathlib import Path

from foilstudy.plot.save import save
from foilstudy.study.convergence.figures import FIGURES
from foilstudy.study.convergence.records import Study
from foilstudy.study.convergence.tables import write_crumples, write_markdown, write_stops

folder = Path(sys.argv[1])
study = Study.read(folder)
write_crumples(study, folder / "convergence.csv")
write_stops(study, folder / "stops.csv")
write_markdown(study, folder / "convergence.md")
for name, draw in FIGURES.items():
    save(draw(study), folder / name)
