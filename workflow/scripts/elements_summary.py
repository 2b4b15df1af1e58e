"""Table and chart of the element study: elements_summary.py RESULTS_FOLDER."""

import sys
from pathlib import Path

from foilstudy.plot.save import save
from foilstudy.study.elements.chart import draw
from foilstudy.study.elements.summary import Study, write_csv, write_markdown

folder = Path(sys.argv[1])
study = Study.read(folder)
write_csv(study, folder / "elements.csv")
write_markdown(study, folder / "elements.md")
save(draw(study), folder / "elements")
