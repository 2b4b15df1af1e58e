"""Figure of one benchmark with all elements: verify_figure.py FIGURE_PNG BENCHMARK_JSON...

The SVG goes beside the PNG.
"""

import sys
from pathlib import Path

from foilstudy.plot.save import save
from foilstudy.study.verification.figures import draw
from foilstudy.study.verification.records import Benchmark

figure_png, *paths = sys.argv[1:]
save(draw([Benchmark.read(path) for path in paths]), Path(figure_png).with_suffix(""))
