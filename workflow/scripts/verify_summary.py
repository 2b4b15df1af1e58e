"""Tables of all benchmarks: verify_summary.py CSV MARKDOWN BENCHMARK_JSON..."""

import sys

from foilstudy.study.verification.records import Benchmark
from foilstudy.study.verification.summary import write_csv, write_markdown

csv_path, markdown_path, *paths = sys.argv[1:]
benchmarks = [Benchmark.read(path) for path in paths]
write_csv(benchmarks, csv_path)
write_markdown(benchmarks, markdown_path)
