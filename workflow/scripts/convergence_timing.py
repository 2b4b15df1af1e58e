"""Time per step on every mesh: convergence_timing.py RECORD_JSON."""

import sys

from foilstudy.convergence.records import write
from foilstudy.convergence.timing import run_timing

(path,) = sys.argv[1:]
write(run_timing(), path)
