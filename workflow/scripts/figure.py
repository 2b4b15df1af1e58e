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
from foilstudy.present.figures import FigureInputs, draw_figure

name, results, *crumples = sys.argv[1:]
crumples = list(map(Path, crumples))
# the response of a realisation lies beside its crumple
responses = [crumple.with_name("response.nc") for crumple in crumples]
files = FigureInputs(Path(results, "cube.nc"), crumples, responses)
draw_figure(name, files, Path(results, "figures", name))
