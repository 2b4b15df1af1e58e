"""Uniform quadratic B-spline patch, periodic in theta, with unclamped (uniform) knots.

All elements share one stencil: element ``(j, i)`` is carried by the control rows ``j, j+1, j+2``
and the control columns ``i, i+1, i+2`` (columns modulo their number). With unclamped knots the
position and the slope of an edge depend on its two outer control rows only, so that a rigid
clamped ring owns exactly two rows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

RING_ROWS = 2
"""Control rows owned by a clamped ring."""


@dataclass(frozen=True)
class Patch:
    """Element grid of a cylinder; the parameters are arc length around and height.

    Attributes
    ----------
    elements_around, elements_along : int
        Number of elements around the circumference and along the height.
    size_around, size_along : float
        Element lengths in the parameter directions, m.
    """

    elements_around: int
    elements_along: int
    size_around: float
    size_along: float

    @classmethod
    def for_cylinder(cls, diameter: float, height: float, element_size: float) -> Patch:
        """Nearly square elements of about `element_size`; lengths in m."""
        around = round(np.pi * diameter / element_size)
        along = round(height / element_size)
        return cls(around, along, np.pi * diameter / around, height / along)

    @property
    def rows(self) -> int:
        """Number of control rows."""
        return self.elements_along + 2

    @property
    def columns(self) -> int:
        """Number of control columns."""
        return self.elements_around

    @property
    def shape(self) -> tuple[int, int, int]:
        """Shape of an array of control points: component, row, column."""
        return (3, self.rows, self.columns)

    def refined(self) -> Patch:
        """The patch with every element split in two in both directions."""
        return Patch(
            2 * self.elements_around,
            2 * self.elements_along,
            self.size_around / 2,
            self.size_along / 2,
        )


def cylinder_control_points(patch: Patch, diameter: float) -> np.ndarray:
    """Control points of a straight cylinder standing on z = 0, shape (3, rows, columns), m.

    The control radius is chosen such that an element has the arc length of the circle at its
    middle, to fourth order; area and mass are then right, the radius is 1e-4 too large at 126
    elements around.
    """
    step = 2 * np.pi / patch.columns
    mean_of_basis = np.array([1 / 6, 2 / 3, 1 / 6])
    radius = 0.5 * diameter / (mean_of_basis @ np.cos(step * np.array([-1, 0, 1])))
    angle = step * np.arange(patch.columns)
    height = patch.size_along * (np.arange(patch.rows) - 0.5)
    points = np.empty(patch.shape)
    points[0] = radius * np.cos(angle)
    points[1] = radius * np.sin(angle)
    points[2] = height[:, None]
    return points


def knot_points(control_points: np.ndarray) -> np.ndarray:
    """Surface points at the knots (element corners), shape (3, rows - 1, columns), m."""
    along = 0.5 * (control_points[:, :-1] + control_points[:, 1:])
    return 0.5 * (along + np.roll(along, -1, axis=2))


def refine(control_points: np.ndarray) -> np.ndarray:
    """Split every element in two by knot insertion; the surface is exactly the same.

    Each pair of neighbouring control points p, q gives 3/4 p + 1/4 q and 1/4 p + 3/4 q.
    """
    lower, upper = control_points[:, :-1], control_points[:, 1:]
    along = np.empty((3, 2 * lower.shape[1], control_points.shape[2]))
    along[:, 0::2] = 0.75 * lower + 0.25 * upper
    along[:, 1::2] = 0.25 * lower + 0.75 * upper
    left, right = along, np.roll(along, -1, axis=2)
    fine = np.empty((3, along.shape[1], 2 * along.shape[2]))
    fine[:, :, 0::2] = 0.75 * left + 0.25 * right
    fine[:, :, 1::2] = 0.25 * left + 0.75 * right
    return fine
