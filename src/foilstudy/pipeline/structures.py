"""The linear system of a crumple between its rings, free of stress or stressed."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.measure.air.protocols import Air
from foilstudy.measure.air.surface import WettedSurface
from foilstudy.measure.dynamics.structure import Structure
from foilstudy.measure.stiffness import InterfaceSystem, Rings
from foilstudy.measure.stiffness.rings import interface_rigid_modes
from foilstudy.measure.stiffness.stress_removal import Relieved, Residual
from foilstudy.model.patch import RING_ROWS
from foilstudy.model.shell.tangent import mass_matrix
from foilstudy.pipeline.shape import Shape


def stress_free_structure(shape: Shape, added: sparse.csr_matrix | None = None) -> Structure:
    """The crumpled shape without its stresses, but for those that their removal has left.

    Parameters
    ----------
    shape : Shape
    added : csr_matrix, optional
        Stiffness of what else holds the foil, such as springs for its contacts, on all control
        points, N/m; a rigid motion costs it nothing.

    Raises
    ------
    SolveError
        If the stiffness with held rings is singular.
    """
    relieved = shape.relieved()
    left = isinstance(relieved, Residual)  # what has stress resists its own turning
    motions = _rigid_motions(shape)[:, : 3 if left else 6]
    stiffness = _relieved_stiffness(shape, relieved)
    if added is not None:
        stiffness += InterfaceSystem.split(added, Rings.of(shape.patch, shape.points))
    return Structure.assembled(stiffness, mass(shape), motions)


def prestressed_structure(shape: Shape) -> Structure:
    """The crumpled shape with the stresses that hold it there.

    Raises
    ------
    SolveError
        If the tangent with held rings is singular.
    """
    translations = _rigid_motions(shape)[:, :3]
    return Structure.assembled(prestressed_stiffness(shape), mass(shape), translations)


def in_air(shape: Shape, structure: Structure, air: Air) -> Structure:
    """A structure of the shape with what the air adds to it.

    Raises
    ------
    SolveError
        If the stiffness with the enclosed air is singular.
    """
    surface = WettedSurface(shape.patch, shape.points)
    return air.about(structure, surface, Rings.of(shape.patch, shape.points))


def stress_free_stiffness(shape: Shape) -> InterfaceSystem:
    """Stiffness of the shape without its stresses, split by the rings."""
    return _relieved_stiffness(shape, shape.relieved())


def _relieved_stiffness(shape: Shape, relieved: Relieved) -> InterfaceSystem:
    if isinstance(relieved, Residual):
        return _stressed_stiffness(shape, relieved.tangent(), relieved.residual_force())
    return InterfaceSystem.split(relieved.tangent(), Rings.of(shape.patch, shape.points))


def prestressed_stiffness(shape: Shape) -> InterfaceSystem:
    """The same with its stresses, those included that turn with a loaded ring."""
    problem, points = shape.problem(), shape.points
    force = np.empty_like(points)
    problem.force(points, force)
    return _stressed_stiffness(shape, problem.tangent(points), force)


def _stressed_stiffness(
    shape: Shape, tangent: sparse.csr_matrix, force: np.ndarray
) -> InterfaceSystem:
    """With the tangent and the forces on all control points."""
    points = shape.points
    stiffness = InterfaceSystem.split(tangent, Rings.of(shape.patch, points))
    for ring, rows in enumerate((slice(0, RING_ROWS), slice(-RING_ROWS, None))):
        turning = slice(6 * ring + 3, 6 * ring + 6)
        stiffness.interface[turning, turning] += _turning_stiffness(points[:, rows], force[:, rows])
    return stiffness


def _rigid_motions(shape: Shape) -> np.ndarray:
    """Of both rings together, about the centre of the lower one, shape (12, 6)."""
    heights = shape.points[2]
    return interface_rigid_modes(heights[-RING_ROWS:].mean() - heights[:RING_ROWS].mean())


def _turning_stiffness(points: np.ndarray, force: np.ndarray) -> np.ndarray:
    """Second derivative of the energy by the rotation of a loaded ring, N m, shape (3, 3).

    A rotation moves a point by theta x r + theta x (theta x r) / 2; the second part times the
    force g gives (theta.r)(theta.g) - (r.g) theta.theta, halved.
    """
    arms = points.reshape(3, -1) - np.array([[0.0], [0.0], [points[2].mean()]])
    moment = arms @ force.reshape(3, -1).T
    return 0.5 * (moment + moment.T) - np.trace(moment) * np.eye(3)


def mass(shape: Shape) -> InterfaceSystem:
    """Mass of the crumpled foil; the areal density is that of the undeformed foil."""
    patch = shape.patch
    matrix = mass_matrix(patch, shape.stressed.section.masses)
    return InterfaceSystem.split(matrix, Rings.of(patch, shape.points))
