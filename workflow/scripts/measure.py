"""Measure one case of a side study: measure.py STUDY PART CASE RECORD_JSON [NEEDED_JSON...]."""

import sys

from foilstudy.study.kernel.files import measure
from foilstudy.study.registry import STUDIES

study, part, case, record_json, *needed = sys.argv[1:]
cost = measure(STUDIES[study], part, case, record_json, needed).cost
print(f"{cost.cpu_seconds:.1f} s of processor time, {cost.peak_memory_mb:.0f} MB")
