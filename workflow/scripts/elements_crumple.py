"""Crumples by one element on 5 mm: elements_crumple.py NAME RECORD_JSON."""

import sys

from foilstudy.elementstudy.crumpling import crumples
from foilstudy.elementstudy.records import write

name, record_json = sys.argv[1:]
write(crumples(name), record_json)
