"""Reductions against the full-order truth, error by order and cost: ``snakemake dynamics``."""

from foilstudy.study.dynamics.plan import STUDY

__all__ = ["STUDY"]
