"""Fail if a benchmark misses what is asked of it: verify_check.py BENCHMARK_JSON..."""

import sys

from foilstudy.study.verification.records import Benchmark

problems = [problem for path in sys.argv[1:] for problem in Benchmark.read(path).problems()]
sys.exit("\n".join(problems) or 0)
