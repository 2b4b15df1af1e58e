"""The default reduction of one model: dynamics_check.py MODEL SHAPE_NPZ RECORD_JSON."""

import sys

from foilstudy.dynamicsstudy.measure import check
from foilstudy.files import write_json

name, shape, path = sys.argv[1:]
write_json(check(name, shape), path)
