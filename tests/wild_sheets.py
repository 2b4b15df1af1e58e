"""Sheets without any symmetry and tools to differentiate their energy; lengths in m."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from conftest import DIAMETER, FEP, rotation

from foilstudy.model.materials import Material
from foilstudy.model.patch import Patch, cylinder_control_points, fitted_control_points
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.model.shell.elements.protocol import Element
from foilstudy.model.shell.shell import Shell

RADIUS = DIAMETER / 2


@dataclass(frozen=True)
class Foil:
    """What a wild sheet is made of."""

    element: Element = Corner()
    material: Material = FEP
    thickness: float = 2e-3


def wild_sheet(around, along=3, foil=None):
    """A skewed, wrinkled, closed stress-free shape, so that no coefficient of the law is zero."""
    patch = Patch(around, along, np.pi * DIAMETER / around, 1.3 * np.pi * DIAMETER / around)
    points = cylinder_control_points(patch, DIAMETER)
    twist = rotation([0, 0, 1], 0.5 / RADIUS * patch.size_along)
    for row in range(1, patch.rows):
        points[:2, row:] = np.einsum("ij,jrc->irc", twist[:2, :2], points[:2, row:])
    return _wrinkled(patch, points, foil)


def wild_open_sheet(around, along=3, foil=None):
    """The same on an open patch: part of a cylinder in oblique coordinates."""
    patch = Patch(around, along, 0.02, 0.026, periodic=False)
    points = fitted_control_points(
        patch,
        lambda s, z: np.stack(
            [
                RADIUS * np.cos((s + 0.5 * z) / RADIUS),
                RADIUS * np.sin((s + 0.5 * z) / RADIUS),
                z,
            ]
        ),
    )
    return _wrinkled(patch, points, foil)


def _wrinkled(patch, points, foil):
    rng = np.random.default_rng(patch.elements_around)
    points = points + 0.1 * patch.size_around * rng.standard_normal(patch.shape)
    foil = foil or Foil()
    return Shell.elastic(patch, points, foil.material, foil.thickness, foil.element)


def wild_shape(sheet, seed=7):
    """A random deformation with strains of order one."""
    rng = np.random.default_rng(seed)
    stretch = np.eye(3) + 0.2 * rng.standard_normal((3, 3))
    points = np.einsum("ij,jrc->irc", stretch, sheet.reference)
    return points + 0.1 * sheet.patch.size_around * rng.standard_normal(points.shape)


def force_of(sheet, points):
    """Internal force, N."""
    out = np.empty_like(points)
    sheet.force(np.ascontiguousarray(points), out)
    return out


def flat(field):
    """Vector in the order of the matrices: row, column, component."""
    return np.moveaxis(field, 0, -1).ravel()


def unflat(vector, patch):
    """Field (3, rows, columns) of a vector in the order of the matrices."""
    return np.moveaxis(vector.reshape(patch.rows, patch.columns, 3), -1, 0)


def extrapolated(difference, step):
    """Derivative from central differences at a step, half and a quarter of it, to order six.

    Parameters
    ----------
    difference : callable
        Central difference, a function of the step.
    step : float
    """
    coarse, fine, finest = (difference(step / divisor) for divisor in (1, 2, 4))
    once = (4 * fine - coarse) / 3, (4 * finest - fine) / 3
    return (16 * once[1] - once[0]) / 15
