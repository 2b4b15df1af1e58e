"""A crumple and its refined stiffness: elements_frozen.py THICKNESS_UM SHAPE_NPZ."""

import sys

from foilstudy.study.elements.frozen import frozen_shape
from foilstudy.study.elements.records import write_shape

thickness_um, shape_npz = sys.argv[1:]
write_shape(frozen_shape(float(thickness_um) * 1e-6), shape_npz)
