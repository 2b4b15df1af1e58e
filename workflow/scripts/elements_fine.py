"""Crumples by the default element on a finer mesh: elements_fine.py SIZE_MM RECORD_JSON."""

import sys

from foilstudy.study.elements.crumpling import fine_crumples
from foilstudy.study.elements.records import write
from foilstudy.study.elements.variants import DEFAULT

size_mm, record_json = sys.argv[1:]
write(fine_crumples(DEFAULT, float(size_mm) * 1e-3), record_json)
