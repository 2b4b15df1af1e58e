"""One benchmark with one element as JSON: verify_benchmark.py NAME ELEMENT BENCHMARK_JSON."""

import sys

from foilstudy.study.verification.registry import run

name, element, benchmark_json = sys.argv[1:]
run(name, element).write(benchmark_json)
