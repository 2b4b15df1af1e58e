"""The default reduction of one model: dynamics_check.py MODEL SHAPE_NPZ RECORD_JSON."""

import sys

from foilstudy.base.files import write_json
from foilstudy.study.dynamics.measure import check

name, shape, path = sys.argv[1:]
write_json(check(name, shape), path)
