"""What a grid must be before it becomes a sheet; every refusal says what and what to do."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.shell.intersection import self_crossing_share
from foilstudy.pipeline.crumpled import SurfaceFaults
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
    folded_share, crossing_share : float
        Shares of the surface, of its cells and of its area, that may be turned over or folded back
        and that may cross the rest; shapes of codes without contact do so a little. What there is
        stands in `Crumpled.faults`.
    """

    ring: float = 0.01
    step: float = 2.0
    length: float = 0.1
    seam: float = 2.0
    fold_degrees: float = 175.0
    folded_share: float = 0.0
    crossing_share: float = 0.0


DEFAULT_LIMITS = Limits()
_PHASE = 0.1
"""Fourth differences at points over those between them below which the elements begin there."""
_SMOOTH = 1e-9
"""Fourth differences over the size of the shape that are more than rounding."""


def closed_grid(grid: SurfaceGrid, limits: Limits) -> SurfaceGrid:
    """The grid as floating-point numbers, without a last column that repeats the first.

    Raises
    ------
    ValueError
        If the shape or the numbers are wrong, or if the seam is open.
    """
    if np.ma.is_masked(grid.points):
        raise ValueError(
            f"{np.ma.count_masked(grid.points)} numbers of the grid are masked; fill the gaps by "
            "interpolation."
        )
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
    if grid.points_per_element == 2:
        _check_first_knot(points)
    return SurfaceGrid(points, grid.points_per_element)


def _check_division(points: np.ndarray, cells: int) -> None:
    rows, columns, _ = points.shape
    if cells < 1 or columns % cells or (rows - 1) % cells:
        raise ValueError(
            f"{cells} grid cells per element do not divide {columns} cells around and {rows - 1} "
            "along; choose another points_per_element, such as 1."
        )


def _check_first_knot(points: np.ndarray) -> None:
    """Refuse rows that begin in the middle of an element.

    On a quadratic spline with its knots at every second point, fourth differences vanish at the
    knots (there the slope is continuous) and not at the middles.
    """
    fourth = _lengths(np.diff(points, 4, axis=0)).max(axis=1)
    at_knots, at_middles = fourth[::2].max(), fourth[1::2].max(initial=0.0)
    if at_middles < _PHASE * at_knots and at_knots > _SMOOTH * np.abs(points).max():
        raise ValueError(
            "the first row lies in the middle of an element, where a grid with 2 points per "
            "element begins at an edge; give all rows from ring to ring, or set "
            "points_per_element to 1."
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
            f"{largest:g} m are possible; give the points in metres{_units(2 * bottom.radius)}."
        )
    _check_one_axis(bottom, top, limits)
    _check_winding(points, bottom.radius, limits)
    return bottom, top


def _units(diameter: float) -> str:
    """What a diameter that is none in metres would be in other units."""
    smallest, largest = DIAMETER_RANGE
    fitting = [
        f"times {size:g} if they are in {name} (then it is {size * diameter:.3g} m wide)"
        for name, size in (("millimetres", 1e-3), ("inches", 0.0254), ("micrometres", 1e-6))
        if smallest <= size * diameter <= largest
    ]
    return f": {', '.join(fitting)}" if fitting else ""


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


def checked_folds(points: np.ndarray, limits: Limits) -> SurfaceFaults:
    """Refuse a surface that is degenerate, or more turned over or crossing than the limits allow.

    Returns
    -------
    SurfaceFaults
        What of it there is.

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
    if turned.mean() > limits.folded_share:
        _refuse_cell(turned, "turned over", "a corner of it points the other way", "folded_share")
    limit = np.cos(np.radians(limits.fold_degrees))
    folded = (normals * np.roll(normals, -1, axis=1)).sum(axis=2) < limit
    folded[:-1] |= (normals[:-1] * normals[1:]).sum(axis=2) < limit
    faulty = turned | folded
    if faulty.mean() > limits.folded_share:
        _refuse_cell(
            faulty, "folded back", "its normal is opposite to its neighbour's", "folded_share"
        )
    crossing = self_crossing_share(np.ascontiguousarray(np.moveaxis(points, 2, 0)))
    if crossing > limits.crossing_share:
        raise ValueError(
            f"the surface crosses itself on {100 * crossing:.2g} % of its area, which no real foil "
            "does; correct the shape, resolve its folds with a finer grid, or analyse it as it is "
            f"with limits=Limits(crossing_share={_rounded_up(crossing)})."
        )
    return SurfaceFaults(float(faulty.mean()), crossing)


def _refuse_cell(where: np.ndarray, what: str, why: str, option: str = "") -> None:
    row, column = np.argwhere(where)[0]
    as_it_is = ""
    if option:
        limit = f"{option}={_rounded_up(where.mean())}"
        as_it_is = f", or analyse the shape as it is with limits=Limits({limit})"
    raise ValueError(
        f"{int(where.sum())} cells of the grid are {what}, the first in row {row}, column "
        f"{column}: {why}; correct the points there, or resolve the fold with a finer grid"
        f"{as_it_is}."
    )


def _rounded_up(share: float) -> str:
    """With two digits, so that as a limit it lets the share pass."""
    return f"{1.1 * share:.2g}"


def _lengths(vectors: np.ndarray) -> np.ndarray:
    return np.linalg.norm(vectors, axis=-1)
