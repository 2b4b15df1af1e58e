"""Stiffness of a crumple stopped at falling residuals: convergence_stops.py CASE RECORD_JSON."""

import sys

from foilstudy.convergence.records import write
from foilstudy.convergence.stops import run_stops

name, path = sys.argv[1:]
write(run_stops(name), path)
