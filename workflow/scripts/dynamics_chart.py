"""All reductions of one model: dynamics_chart.py MODEL SHAPE_NPZ RECORD_JSON."""

import sys

from foilstudy.base.files import write_json
from foilstudy.study.dynamics.measure import chart

name, shape, path = sys.argv[1:]
write_json(chart(name, shape), path)
