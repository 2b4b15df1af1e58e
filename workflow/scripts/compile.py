"""Fill the kernel cache: compile.py."""

from foilstudy.study.sweep.warmup import compile_kernels

compile_kernels()
