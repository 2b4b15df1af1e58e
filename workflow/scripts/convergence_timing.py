"""Time per step on every mesh: convergence_timing.py RECORD_JSON."""

import sys

from foilstudy.base.files import write_json
from foilstudy.study.convergence.timing import run_timing

(path,) = sys.argv[1:]
write_json(run_timing(), path)
