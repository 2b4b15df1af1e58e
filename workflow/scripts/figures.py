"""Figures as PNG and SVG: figures.py FOLDER CUBE_NC --figures NAME... --crumples CRUMPLE_NC..."""

from argparse import ArgumentParser
from pathlib import Path

from foilstudy.present.figures import FigureInputs, draw_figures

parser = ArgumentParser()
parser.add_argument("folder", type=Path)
parser.add_argument("cube_nc", type=Path)
parser.add_argument("--figures", nargs="+")
parser.add_argument("--crumples", nargs="*", type=Path)
arguments = parser.parse_args()
# the response of a realisation lies beside its crumple
responses = [crumple.with_name("response.nc") for crumple in arguments.crumples]
files = FigureInputs(arguments.cube_nc, arguments.crumples, responses)
draw_figures(arguments.figures, files, arguments.folder)
