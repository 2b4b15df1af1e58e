"""Potential energy of a sheet that is held at edges and loaded, for `newton.minimise`."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.model.shell.shell import Shell
from foilstudy.model.supports.edges import Constraints
from foilstudy.model.supports.loads import Load, Loading
from foilstudy.solve.problem import Problem

_FREE = 1e-9
"""Share of a rigid motion that supports may take before they hold it."""


class LoadedSheet:
    """Strain energy minus the work of a load, as a function of the free unknowns.

    Parameters
    ----------
    sheet : Shell
    constraints : Constraints
    load : Load
    factor : float
        Multiplies the load.
    base : ndarray, shape (3, rows, columns), optional
        Control points at which the unknowns are zero, m: the stress-free shape unless supports
        have been moved.

    Attributes
    ----------
    sheet, constraints, load, factor
        As given.
    """

    def __init__(
        self,
        sheet: Shell,
        constraints: Constraints,
        load: Load,
        factor: float = 1.0,
        base: np.ndarray | None = None,
    ):
        self.sheet = sheet
        self.constraints = constraints
        self.load = load
        self.factor = factor
        self._problem = Problem(sheet, Loading(load, factor))
        self._base = sheet.reference if base is None else base

    def at(self, factor: float) -> LoadedSheet:
        """The same sheet under another multiple of the load."""
        return LoadedSheet(self.sheet, self.constraints, self.load, factor, self._base)

    def points(self, unknowns: np.ndarray) -> np.ndarray:
        """Control points, shape (3, rows, columns), m."""
        return self._base + self.constraints.displacement(unknowns)

    def unknowns(self, points: np.ndarray) -> np.ndarray:
        """The unknowns of a shape that keeps to the supports."""
        return self.constraints.reduced(points - self._base)

    def value_and_gradient(self, q: np.ndarray) -> tuple[float, np.ndarray]:
        """Potential (J) and its gradient; see `newton.Potential`."""
        points = self.points(q)
        gradient = np.empty_like(points)
        energies = self._problem.force(points, gradient)
        return float(energies.sum()), self.constraints.reduced(gradient)

    def hessian(self, q: np.ndarray) -> sparse.csr_matrix:
        """Tangent on the unknowns, load stiffness included; see `newton.Potential`."""
        return self.constraints.reduced_matrix(self._problem.tangent(self.points(q)))

    def rigid_freedoms(self) -> int:
        """Small rigid motions of the base shape that the supports do not hold, 0 to 6.

        A motion is free where it keeps to the supports, that is, where they take nothing of it.
        """
        centred = self._base - self._base.mean(axis=(1, 2), keepdims=True)
        x, y, z = centred
        zero, one = np.zeros_like(x), np.ones_like(x)
        turns = [(zero, -z, y), (z, zero, -x), (-y, x, zero)]
        shifts = [(one, zero, zero), (zero, one, zero), (zero, zero, one)]
        motions = np.array([np.array(motion).ravel() for motion in (*shifts, *turns)]).T
        motions, _ = np.linalg.qr(motions)
        shape = self._base.shape
        kept = np.array([self.constraints.reduced(motion.reshape(shape)) for motion in motions.T])
        return int((np.linalg.eigvalsh(kept @ kept.T) > 1 - _FREE).sum())

    def internal_force_size(self, q: np.ndarray) -> float:
        """Norm of the internal force on all control points, N: the scale of residuals.

        In equilibrium it is that of the loads and the reactions together.
        """
        points = self.points(q)
        internal = np.empty_like(points)
        self.sheet.force(points, internal)
        return float(np.linalg.norm(internal))
