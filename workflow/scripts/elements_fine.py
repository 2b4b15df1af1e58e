"""Crumples by the default element on a finer mesh: elements_fine.py SIZE_MM RECORD_JSON."""

import sys

from foilstudy.elementstudy.crumpling import fine_crumples
from foilstudy.elementstudy.records import write
from foilstudy.elementstudy.variants import DEFAULT

size_mm, record_json = sys.argv[1:]
write(fine_crumples(DEFAULT, float(size_mm) * 1e-3), record_json)
