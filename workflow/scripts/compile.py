"""Fill the kernel cache: compile.py MARKER."""

import sys
from pathlib import Path

from foilstudy.warmup import compile_kernels

marker = Path(sys.argv[1])
compile_kernels()
marker.touch()
