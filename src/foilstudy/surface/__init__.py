"""Crumpled shapes from elsewhere: a grid of surface points becomes a sheet between rings."""

from foilstudy.surface.checks import Limits
from foilstudy.surface.grid import SurfaceGrid, read_grid
from foilstudy.surface.sheet import sheet_from_grid

__all__ = ["Limits", "SurfaceGrid", "read_grid", "sheet_from_grid"]
