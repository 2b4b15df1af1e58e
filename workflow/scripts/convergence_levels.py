"""A crumple refined and relaxed level by level: convergence_levels.py CASE RECORD_JSON."""

import sys

from foilstudy.base.files import write_json
from foilstudy.study.convergence.crumpling import run_levels

name, path = sys.argv[1:]
write_json(run_levels(name), path)
