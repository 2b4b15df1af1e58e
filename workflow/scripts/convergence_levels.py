"""A crumple refined and relaxed level by level: convergence_levels.py CASE RECORD_JSON."""

import sys

from foilstudy.convergence.crumpling import run_levels
from foilstudy.files import write_json

name, path = sys.argv[1:]
write_json(run_levels(name), path)
