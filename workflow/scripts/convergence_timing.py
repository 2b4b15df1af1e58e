"""Time per step on every mesh: convergence_timing.py RECORD_JSON."""

import sys

from foilstudy.convergence.timing import run_timing
from foilstudy.files import write_json

(path,) = sys.argv[1:]
write_json(run_timing(), path)
