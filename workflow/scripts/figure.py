"""One figure as PNG and SVG: figure.py NAME RESULTS [CRUMPLE_NC...]."""

# ruff: noqa: F401
import sys
from pathlib import Path

# What most figures load on first use; named here, a worker keeps it for the next of them.
import matplotlib.backends.backend_agg
import matplotlib.backends.backend_svg
import matplotlib.projections
import statsmodels.regression.linear_model
import xarray

import foilstudy.plot.render
from foilstudy.present.figures import draw_figures
from foilstudy.present.files import StudyFiles

name, results, *crumples = sys.argv[1:]
files = StudyFiles(Path(results, "cube.nc"), tuple(map(Path, crumples)))
draw_figures([name], files, Path(results, "figures"))
