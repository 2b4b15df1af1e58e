"""Crumples by one element on 5 mm: elements_crumple.py NAME RECORD_JSON."""

import sys

from foilstudy.study.elements.crumpling import crumples
from foilstudy.study.elements.records import write

name, record_json = sys.argv[1:]
write(crumples(name), record_json)
