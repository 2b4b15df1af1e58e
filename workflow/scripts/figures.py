"""Figures as PNG and SVG: figures.py FOLDER CUBE_NC --figures NAME... --crumples CRUMPLE_NC..."""

from argparse import ArgumentParser
from pathlib import Path

from foilstudy.figures import draw_figures

parser = ArgumentParser()
parser.add_argument("folder", type=Path)
parser.add_argument("cube_nc", type=Path)
parser.add_argument("--figures", nargs="+")
parser.add_argument("--crumples", nargs="*", type=Path)
arguments = parser.parse_args()
draw_figures(arguments.figures, arguments.cube_nc, arguments.crumples, arguments.folder)
