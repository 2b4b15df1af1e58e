"""Stiffness of a crumple stopped at falling residuals: convergence_stops.py CASE RECORD_JSON."""

import sys

from foilstudy.convergence.stops import run_stops
from foilstudy.files import write_json

name, path = sys.argv[1:]
write_json(run_stops(name), path)
