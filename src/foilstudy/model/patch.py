"""Uniform quadratic B-spline patch, closed around (periodic) or open, with unclamped knots.

All elements share one stencil: element ``(j, i)`` is carried by the control rows ``j, j+1, j+2``
and the control columns ``i, i+1, i+2`` (modulo their number on a periodic patch). With unclamped
knots the position and the slope of an edge depend on its two outer control rows only, so that a
rigid clamped ring owns exactly two rows.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from foilstudy.base.ranges import require_number

RING_ROWS = 2
"""Control rows owned by a clamped ring."""


@dataclass(frozen=True)
class Patch:
    """Element grid of a sheet; on a cylinder the parameters are arc length around and height.

    Attributes
    ----------
    elements_around, elements_along : int
        Number of elements in the first (around) and the second parameter direction (along).
    size_around, size_along : float
        Element lengths in the parameter directions, m.
    periodic : bool
        Whether the first direction closes on itself.
    """

    elements_around: int
    elements_along: int
    size_around: float
    size_along: float
    periodic: bool = True

    @classmethod
    def for_cylinder(
        cls, diameter: float, height: float, element_size: float, halvings: int = 0
    ) -> Patch:
        """Nearly square elements of about `element_size`; lengths in m.

        With `halvings` it is a patch of larger elements, refined so many times.

        The number around has no prime factor above 7, for the Fourier transform of the mass
        scaling: with 251 or 503 elements, primes next to 2.5 and 1.25 mm, a step takes twice the
        time.
        """
        for what, length in (("diameter", diameter), ("height", height), ("element", element_size)):
            require_number(f"{what} of a cylinder's patch", length, "m", above=0)
        larger = element_size * 2**halvings
        around = _nearest_smooth(np.pi * diameter / larger) * 2**halvings
        along = round(height / larger) * 2**halvings
        return cls(around, along, np.pi * diameter / around, height / along)

    @property
    def rows(self) -> int:
        """Number of control rows."""
        return self.elements_along + 2

    @property
    def columns(self) -> int:
        """Number of control columns."""
        return self.elements_around if self.periodic else self.elements_around + 2

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
            self.periodic,
        )

    def parameters(self) -> tuple[np.ndarray, np.ndarray]:
        """Parameters (columns,) and (rows,) at which the control points stand; edges are at 0."""
        around = self.size_around * (np.arange(self.columns) - (0.0 if self.periodic else 0.5))
        return around, self.size_along * (np.arange(self.rows) - 0.5)


@lru_cache(maxsize=1)
def _smooth_numbers() -> np.ndarray:
    """Numbers whose prime factors are 2, 3, 5 and 7."""
    powers = (float(prime) ** np.arange(16) for prime in (2, 3, 5, 7))
    return np.prod(np.meshgrid(*powers), axis=0).ravel()


def _nearest_smooth(wanted: float) -> int:
    """The one of them that is nearest to `wanted`."""
    smooth = _smooth_numbers()
    return int(smooth[np.abs(smooth - wanted).argmin()])


def fitted_control_points(
    patch: Patch, surface: Callable[[np.ndarray, np.ndarray], np.ndarray]
) -> np.ndarray:
    """Control points of a smooth surface, accurate to fourth order in the element size.

    P = x - (h^2/8) x'' in both directions, the second difference in place of the derivative, so
    that the spline takes the values of the surface at the control parameters.

    Parameters
    ----------
    patch : Patch
    surface : callable
        Maps parameters around and along, arrays of one shape, to positions of shape (3, ...); it
        is evaluated up to 1.5 elements beyond the edges.

    Returns
    -------
    ndarray, shape (3, rows, columns)
    """
    around, along = patch.parameters()
    h1, h2 = patch.size_around, patch.size_along
    around = np.concatenate([[around[0] - h1], around, [around[-1] + h1]])
    along = np.concatenate([[along[0] - h2], along, [along[-1] + h2]])
    x = np.asarray(surface(*np.meshgrid(around, along)))
    x = x[:, :, 1:-1] - np.diff(x, 2, axis=2) / 8
    return np.ascontiguousarray(x[:, 1:-1] - np.diff(x, 2, axis=1) / 8)


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


def knot_points(control_points: np.ndarray, periodic: bool = True) -> np.ndarray:
    """Surface points at the knots (element corners), shape (3, rows - 1, knots around), m."""
    along = 0.5 * (control_points[:, :-1] + control_points[:, 1:])
    if periodic:
        return 0.5 * (along + np.roll(along, -1, axis=2))
    return 0.5 * (along[:, :, :-1] + along[:, :, 1:])


def refine(control_points: np.ndarray, periodic: bool = True) -> np.ndarray:
    """Split every element in two by knot insertion; the surface is exactly the same."""
    along = _split(control_points[:, :-1], control_points[:, 1:], axis=1)
    if periodic:
        return _split(along, np.roll(along, -1, axis=2), axis=2)
    return _split(along[:, :, :-1], along[:, :, 1:], axis=2)


def _split(lower: np.ndarray, upper: np.ndarray, axis: int) -> np.ndarray:
    """Each pair of neighbouring control points p, q gives 3/4 p + 1/4 q and 1/4 p + 3/4 q."""
    pairs = np.stack([0.75 * lower + 0.25 * upper, 0.25 * lower + 0.75 * upper], axis=axis + 1)
    shape = list(lower.shape)
    shape[axis] *= 2
    return pairs.reshape(shape)
