"""All reductions of one model: dynamics_chart.py MODEL SHAPE_NPZ RECORD_JSON."""

import sys

from foilstudy.dynamicsstudy.measure import chart
from foilstudy.files import write_json

name, shape, path = sys.argv[1:]
write_json(chart(name, shape), path)
