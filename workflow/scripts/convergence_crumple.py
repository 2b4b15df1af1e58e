"""One crumple of the convergence study: convergence_crumple.py CASE RECORD_JSON."""

import sys

from foilstudy.convergence.crumpling import run
from foilstudy.files import write_json

name, path = sys.argv[1:]
write_json(run(name), path)
