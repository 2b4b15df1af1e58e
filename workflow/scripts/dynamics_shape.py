"""Crumple a shape for the dynamics study: dynamics_shape.py MODEL SHAPE_NPZ."""

import sys

from foilstudy.study.dynamics.shapes import crumple_shape

name, path = sys.argv[1:]
crumple_shape(name, path)
