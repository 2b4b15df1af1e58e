"""One crumple of the convergence study: convergence_crumple.py CASE RECORD_JSON."""

import sys

from foilstudy.base.files import write_json
from foilstudy.study.convergence.crumpling import run

name, path = sys.argv[1:]
write_json(run(name), path)
