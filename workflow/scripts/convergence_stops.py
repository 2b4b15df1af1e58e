"""Stiffness of a crumple stopped at falling residuals: convergence_stops.py CASE RECORD_JSON."""

import sys

from foilstudy.base.files import write_json
from foilstudy.study.convergence.stops import run_stops

name, path = sys.argv[1:]
write_json(run_stops(name), path)
