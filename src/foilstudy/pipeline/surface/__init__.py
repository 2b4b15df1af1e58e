"""Crumpled shapes from elsewhere: a grid of surface points becomes a sheet between rings."""

from foilstudy.pipeline.surface.checks import Limits
from foilstudy.pipeline.surface.grid import SurfaceGrid, read_grid
from foilstudy.pipeline.surface.sheet import sheet_from_grid

__all__ = ["Limits", "SurfaceGrid", "read_grid", "sheet_from_grid"]
