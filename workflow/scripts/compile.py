"""Fill the kernel cache: compile.py."""

from foilstudy.warmup import compile_kernels

compile_kernels()
