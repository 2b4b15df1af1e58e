"""Reductions against the full-order truth, error by order and cost: ``snakemake dynamics``."""
