"""From a grid of surface points to a sheet between two rigid rings."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from foilstudy.model.foil import Foil
from foilstudy.model.materials import Material
from foilstudy.model.patch import cylinder_control_points
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.surface.checks import (
    DEFAULT_LIMITS,
    Limits,
    check_folds,
    checked_rings,
    closed_grid,
)
from foilstudy.pipeline.surface.fit import fitted_patch
from foilstudy.pipeline.surface.grid import SurfaceGrid, read_grid
from foilstudy.pipeline.surface.rings import on_axis

THICKNESS_TO_RADIUS_MAX = 1 / 20
"""Beyond it thin-shell theory ends."""


def sheet_from_grid(
    source: str | Path | np.ndarray | SurfaceGrid,
    thickness: float,
    material: Material | str,
    limits: Limits = DEFAULT_LIMITS,
) -> Crumpled:
    """A crumpled shape from elsewhere as what the package measures.

    The first and the last row become the rigid rings, which hold the position and the slope of
    the foil there. The shape is stress-free, as for every stress-free stiffness of the package;
    its reference, a cylinder of the same developed size, only spreads the mass evenly over the
    foil, so that a pre-stressed stiffness of it means nothing.

    Parameters
    ----------
    source : path, array or SurfaceGrid
        File (see `read_grid`), or points of shape (rows, columns, 3), m.
    thickness : float
        m.
    material : Material
        Or the name of a known one.
    limits : Limits
        What is refused.

    Returns
    -------
    Crumpled
        Standing on z = 0, its axis z.

    Raises
    ------
    ValueError
        If the grid is open, out of order, folded into itself, without rings, not in metres, or if
        the foil is too thick for a thin shell.
    """
    grid = closed_grid(_grid_of(source), limits)
    bottom, top = checked_rings(grid.points, limits)
    if not 0 < thickness <= THICKNESS_TO_RADIUS_MAX * bottom.radius:
        raise ValueError(
            f"a thickness of {thickness:g} m between rings of {bottom.radius:.3g} m radius is not "
            "that of a thin shell (at most 1/20 of the radius); give it in metres."
        )
    check_folds(grid.points, limits)
    points = on_axis(grid.points, bottom, top)
    patch, control = fitted_patch(replace(grid, points=points))
    foil = Foil(
        diameter=patch.elements_around * patch.size_around / np.pi,
        reference_height=patch.elements_along * patch.size_along,
        gap_height=float(points[-1, :, 2].mean()),
        thickness=thickness,
        material=material,
    )
    reference = cylinder_control_points(patch, foil.diameter)
    return Crumpled(foil, patch, control, reference, Corner())


def _grid_of(source: str | Path | np.ndarray | SurfaceGrid) -> SurfaceGrid:
    if isinstance(source, SurfaceGrid):
        return source
    if isinstance(source, str | Path):
        return read_grid(source)
    return SurfaceGrid(np.asarray(source))
