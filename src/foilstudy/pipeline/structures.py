"""The linear system of a crumple between its rings, free of stress or stressed."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.measure.dynamics.structure import Structure
from foilstudy.measure.stiffness import InterfaceSystem, Rings
from foilstudy.measure.stiffness.rings import interface_rigid_modes
from foilstudy.measure.stiffness.stress_removal import Residual
from foilstudy.model.patch import RING_ROWS
from foilstudy.model.shell.tangent import mass_matrix
from foilstudy.pipeline.shape import Shape


def stress_free_structure(shape: Shape) -> Structure:
    """The crumpled shape without its stresses, but for those that their removal has left.

    Raises
    ------
    SolveError
        If the stiffness with held rings is singular.
    """
    relieved = shape.relieved()
    if isinstance(relieved, Residual):
        return _stressed_structure(shape, relieved.tangent(), relieved.residual_force())
    stiffness = InterfaceSystem.split(relieved.tangent(), Rings.of(shape.patch, shape.points))
    return Structure.assembled(stiffness, mass(shape), _rigid_motions(shape))


def prestressed_structure(shape: Shape) -> Structure:
    """The crumpled shape with its stresses: the consistent tangent at the equilibrium.

    Raises
    ------
    SolveError
        If the tangent with held rings is singular.
    """
    problem, points = shape.problem(), shape.points
    force = np.empty_like(points)
    problem.force(points, force)
    return _stressed_structure(shape, problem.tangent(points), force)


def _stressed_structure(shape: Shape, tangent: sparse.csr_matrix, force: np.ndarray) -> Structure:
    """With the tangent and the forces on all control points."""
    points = shape.points
    stiffness = InterfaceSystem.split(tangent, Rings.of(shape.patch, points))
    for ring, rows in enumerate((slice(0, RING_ROWS), slice(-RING_ROWS, None))):
        turning = slice(6 * ring + 3, 6 * ring + 6)
        stiffness.interface[turning, turning] += _turning_stiffness(points[:, rows], force[:, rows])
    translations = _rigid_motions(shape)[:, :3]
    return Structure.assembled(stiffness, mass(shape), translations)


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
    foil, patch = shape.foil, shape.patch
    areas = shape.stressed.section.areas
    matrix = mass_matrix(patch, foil.material.density * foil.thickness * areas)
    return InterfaceSystem.split(matrix, Rings.of(patch, shape.points))
