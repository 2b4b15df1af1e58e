"""Table and chart of the element study: elements_summary.py RESULTS_FOLDER."""

import sys
from pathlib import Path

from foilstudy.elementstudy.chart import draw
from foilstudy.elementstudy.summary import Study, write_csv, write_markdown
from foilstudy.figures.registry import save

folder = Path(sys.argv[1])
study = Study.read(folder)
write_csv(study, folder / "elements.csv")
write_markdown(study, folder / "elements.md")
save(draw(study), folder / "elements")
