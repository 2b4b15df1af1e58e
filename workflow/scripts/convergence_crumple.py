"""One crumple of the convergence study: convergence_crumple.py CASE RECORD_JSON."""

import sys

from foilstudy.convergence.crumpling import run
from foilstudy.convergence.records import write

name, path = sys.argv[1:]
write(run(name), path)
