"""Tables, text and figures of the dynamics study: dynamics_summary.py FOLDER."""

import sys
from pathlib import Path

from foilstudy.plot.save import save
from foilstudy.study.dynamics.figures import FIGURES
from foilstudy.study.dynamics.records import Study
from foilstudy.study.dynamics.tables import write_chart, write_checks, write_markdown

folder = Path(sys.argv[1])
study = Study.read(folder)
write_chart(study, folder / "reductions.csv")
write_checks(study, folder / "checks.csv")
write_markdown(study, folder / "dynamics.md")
for name, draw in FIGURES.items():
    save(draw(study), folder / name)
