"""One figure as PNG and SVG: figure.py NAME CUBE_NC FIGURE_PNG CRUMPLE_NC..."""

import sys
from pathlib import Path

from foilstudy.figures import draw_figure

name, *paths = sys.argv[1:]
cube_nc, figure_png, *crumples = map(Path, paths)
draw_figure(name, cube_nc, crumples, figure_png.with_suffix(""))
