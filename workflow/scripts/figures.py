"""Figures as PNG and SVG: figures.py FOLDER CUBE_NC --figures NAME... --crumples CRUMPLE_NC..."""

from argparse import ArgumentParser
from pathlib import Path

from foilstudy.present.figures import draw_figures
from foilstudy.present.files import StudyFiles

parser = ArgumentParser()
parser.add_argument("folder", type=Path)
parser.add_argument("cube_nc", type=Path)
parser.add_argument("--figures", nargs="+")
parser.add_argument("--crumples", nargs="*", type=Path)
arguments = parser.parse_args()
files = StudyFiles(arguments.cube_nc, tuple(arguments.crumples))
draw_figures(arguments.figures, files, arguments.folder)
