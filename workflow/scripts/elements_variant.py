"""Errors of one element: elements_variant.py NAME RECORD_JSON SHAPE_NPZ..."""

import sys

from foilstudy.study.elements.records import measure, read_shape, write

name, record_json, *shapes = sys.argv[1:]
write(measure(name, [read_shape(path) for path in shapes]), record_json)
