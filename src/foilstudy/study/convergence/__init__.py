"""Convergence of the crumple with the mesh and with the residual: ``snakemake convergence``."""

from foilstudy.study.convergence.plan import STUDY

__all__ = ["STUDY"]
