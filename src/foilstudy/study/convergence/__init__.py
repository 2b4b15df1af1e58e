"""Convergence of the crumple with the mesh and with the residual: ``snakemake convergence``."""
