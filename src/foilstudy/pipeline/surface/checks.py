"""What a grid must be before it becomes a sheet; every refusal says what and what to do."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.shell.intersection import self_crossing_share
from foilstudy.pipeline.surface.grid import SurfaceGrid
from foilstudy.pipeline.surface.rings import Circle, fitted_circle

ROWS_MIN, COLUMNS_MIN = 4, 24
DIAMETER_RANGE = (1e-3, 10.0)
"""m, that of a study's configuration."""


@dataclass(frozen=True)
class Limits:
    """How far a grid may depart from what is wanted of it.

    Attributes
    ----------
    ring : float
        Distance of a ring's points from its circle, and of one ring's axis from the other's, over
        the radius.
    step : float
        Longest grid step over the median step in its direction.
    length : float
        Length of a row over the circumference of the rings, minus one.
    seam : float
        Gap between the last and the first column over the median step around.
    fold_degrees : float
        Angle between the normals of two neighbouring cells.
    """

    ring: float = 0.01
    step: float = 2.0
    length: float = 0.1
    seam: float = 2.0
    fold_degrees: float = 175.0


DEFAULT_LIMITS = Limits()


def closed_grid(grid: SurfaceGrid, limits: Limits) -> SurfaceGrid:
    """The grid as floating-point numbers, without a last column that repeats the first.

    Raises
    ------
    ValueError
        If the shape or the numbers are wrong, or if the seam is open.
    """
    points = np.asarray(grid.points)
    if points.ndim != 3 or points.shape[2] != 3 or not np.issubdtype(points.dtype, np.number):
        raise ValueError(
            f"a surface grid is an array of numbers of shape (rows, columns, 3), not of shape "
            f"{points.shape} and type {points.dtype}; put the coordinates last."
        )
    points = points.astype(float)
    bad = np.argwhere(~np.isfinite(points).all(axis=2))
    if bad.size:
        raise ValueError(
            f"{len(bad)} points of the grid are not finite, the first in row {bad[0][0]}, column "
            f"{bad[0][1]}; fill the gaps by interpolation."
        )
    rows, columns, _ = points.shape
    if rows < ROWS_MIN or columns < COLUMNS_MIN:
        raise ValueError(
            f"the grid has {rows} rows and {columns} columns; at least {ROWS_MIN} rows from ring "
            f"to ring and {COLUMNS_MIN} columns around are needed."
        )
    step = np.median(_lengths(points[:, 1:] - points[:, :-1]))
    gap = _lengths(points[:, 0] - points[:, -1])
    if gap.max() < 1e-6 * step:
        points = points[:, :-1]
    elif gap.max() > limits.seam * step:
        raise ValueError(
            f"the grid is open: in row {gap.argmax()} the last column is {gap.max():.3g} m from "
            f"the first, where neighbours are {step:.3g} m apart; rows must go all the way round "
            "(if they go from ring to ring, transpose the grid)."
        )
    _check_division(points, grid.points_per_element)
    return SurfaceGrid(points, grid.points_per_element)


def _check_division(points: np.ndarray, cells: int) -> None:
    rows, columns, _ = points.shape
    if cells < 1 or columns % cells or (rows - 1) % cells:
        raise ValueError(
            f"{cells} grid cells per element do not divide {columns} cells around and {rows - 1} "
            "along; choose another points_per_element, such as 1."
        )


def checked_rings(points: np.ndarray, limits: Limits) -> tuple[Circle, Circle]:
    """Circles of the first and the last row.

    Raises
    ------
    ValueError
        If the points are not in metres, not in order, or if the end rows are no rings of one axis.
    """
    _check_steps(points, limits)
    rings = []
    for name, row in (("first", points[0]), ("last", points[-1])):
        ring = fitted_circle(row)
        if ring.deviation > limits.ring * ring.radius:
            raise ValueError(
                f"the {name} row is not a plane circle: a point is {ring.deviation:.3g} m from the "
                f"best one, of radius {ring.radius:.3g} m; the end rows must lie on the rigid "
                "rings (leave out rows beyond them)."
            )
        rings.append(ring)
    bottom, top = rings
    smallest, largest = DIAMETER_RANGE
    if not smallest <= 2 * bottom.radius <= largest:
        raise ValueError(
            f"the first ring is {2 * bottom.radius:.3g} m wide, where {smallest:g} m to "
            f"{largest:g} m are possible; give the points in metres."
        )
    _check_one_axis(bottom, top, limits)
    _check_winding(points, bottom.radius, limits)
    return bottom, top


def _check_steps(points: np.ndarray, limits: Limits) -> None:
    closed = np.concatenate([points, points[:, :1]], axis=1)
    for way, axis in (("around", 1), ("along", 0)):
        steps = _lengths(np.diff(closed, axis=axis))
        typical = np.median(steps)
        if not typical:
            raise ValueError(f"the grid is degenerate: its points coincide {way}.")
        if steps.max() > limits.step * typical:
            row, column = np.unravel_index(steps.argmax(), steps.shape)
            raise ValueError(
                f"neighbours {way} at row {row}, column {column} are {steps.max():.3g} m apart, "
                f"where {typical:.3g} m is the median; the points must stand row by row in their "
                "order around, evenly spaced on the undeformed foil (reorder or resample them)."
            )


def _check_one_axis(bottom: Circle, top: Circle, limits: Limits) -> None:
    arm = top.centre - bottom.centre
    offset = np.linalg.norm(arm - (arm @ bottom.normal) * bottom.normal)
    tilt = bottom.radius * np.linalg.norm(np.cross(bottom.normal, top.normal))
    if max(offset, tilt) > limits.ring * bottom.radius:
        raise ValueError(
            f"the rings have no common axis: the centre of the last is {offset:.3g} m beside that "
            f"of the first, and its edge tilts by {tilt:.3g} m; stiffness is defined between "
            "parallel rings on one axis."
        )
    if abs(arm @ bottom.normal) < limits.ring * bottom.radius:
        raise ValueError("the first and the last row lie in one plane; there is no foil between.")


def _check_winding(points: np.ndarray, radius: float, limits: Limits) -> None:
    lengths = _lengths(np.roll(points, -1, axis=1) - points).sum(axis=1)
    ratio = lengths / (2 * np.pi * radius)
    # chords of a folded row are shorter than the foil; longer than the ring it cannot be
    if ratio.max() > 1 + limits.length or min(ratio[0], ratio[-1]) < 1 - limits.length:
        row = int(ratio.argmax())
        raise ValueError(
            f"row {row} is {ratio[row]:.2f} times as long as the circumference of the rings; a "
            "foil hardly stretches, so the points are not in their order around, or not those of "
            "one foil between two equal rings."
        )


def check_folds(points: np.ndarray, limits: Limits) -> None:
    """Refuse a surface that is degenerate, turned over or crosses itself.

    Raises
    ------
    ValueError
    """
    right = np.roll(points, -1, axis=1)
    around, along = right - points, np.diff(points, axis=0)
    normals = np.cross(right[1:] - points[:-1], points[1:] - right[:-1])
    areas = _lengths(normals)
    flat = areas < 1e-6 * np.median(areas)
    if flat.any():
        _refuse_cell(flat, "degenerate", "it has no area")
    normals /= areas[..., None]
    corners = [
        np.cross(a, b)
        for a in (around[:-1], around[1:])
        for b in (along, np.roll(along, -1, axis=1))
    ]
    turned = np.min([(corner * normals).sum(axis=2) for corner in corners], axis=0) <= 0
    if turned.any():
        _refuse_cell(turned, "turned over", "a corner of it points the other way")
    limit = np.cos(np.radians(limits.fold_degrees))
    folded = (normals * np.roll(normals, -1, axis=1)).sum(axis=2) < limit
    folded[:-1] |= (normals[:-1] * normals[1:]).sum(axis=2) < limit
    if folded.any():
        _refuse_cell(folded, "folded back", "its normal is opposite to its neighbour's")
    crossing = self_crossing_share(np.ascontiguousarray(np.moveaxis(points, 2, 0)))
    if crossing:
        raise ValueError(
            f"the surface crosses itself on {100 * crossing:.2g} % of its area, which no real foil "
            "does; correct the shape, or resolve its folds with a finer grid."
        )


def _refuse_cell(where: np.ndarray, what: str, why: str) -> None:
    row, column = np.argwhere(where)[0]
    raise ValueError(
        f"{int(where.sum())} cells of the grid are {what}, the first in row {row}, column "
        f"{column}: {why}; correct the points there, or resolve the fold with a finer grid."
    )


def _lengths(vectors: np.ndarray) -> np.ndarray:
    return np.linalg.norm(vectors, axis=-1)
