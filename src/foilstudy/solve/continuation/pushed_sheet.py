"""A sheet whose rings are moved together, as equations of its unknowns and the share of the way."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.model.patch import RING_ROWS
from foilstudy.model.supports.interpolation import as_field, as_vector
from foilstudy.solve.problem import Problem
from foilstudy.solve.residual import least_scale


class PushedSheet:
    """Equilibria of a problem as its top ring comes down; terms with memory keep their state.

    The factor is the share of the shortening. The unknowns are what the free control points
    move besides their share of the ring's motion, which is spread over the height: a factor that
    grows by itself compresses the sheet uniformly.

    Parameters
    ----------
    problem : Problem
    shortening : float
        m.
    residual_tolerance : float
        To which the equilibria will be asked for, see `least_scale`.

    Attributes
    ----------
    motion : ndarray, shape (3, rows, columns)
        Of all control points at a factor of one, m.
    size : int
        Number of unknowns.
    """

    def __init__(self, problem: Problem, shortening: float, residual_tolerance: float = 1e-8):
        self._problem = problem
        self._floor = least_scale(problem.shell, residual_tolerance)
        rows = problem.patch.rows
        share = np.clip((np.arange(rows) - 0.5) / (rows - 2), 0.0, 1.0)
        share[:RING_ROWS], share[-RING_ROWS:] = 0.0, 1.0
        self.motion = np.zeros_like(problem.reference)
        self.motion[2] = -shortening * share[:, None]
        owned = RING_ROWS * 3 * problem.patch.columns
        self._free = slice(owned, -owned)
        self.size = self.motion.size - 2 * owned

    def points(self, q: np.ndarray, factor: float) -> np.ndarray:
        """Control points, shape (3, rows, columns), m."""
        moved = np.zeros(self.motion.size)
        moved[self._free] = q
        base = self._problem.reference + factor * self.motion
        return base + as_field(moved, self._problem.patch)

    def residual(self, q: np.ndarray, factor: float) -> np.ndarray:
        """See `Equations`."""
        return as_vector(self._all_forces(q, factor))[self._free]

    def linearised(self, q: np.ndarray, factor: float) -> tuple[sparse.csr_matrix, np.ndarray]:
        """See `Equations`."""
        rows = self._problem.tangent(self.points(q, factor))[self._free]
        return rows[:, self._free].tocsr(), rows @ as_vector(self.motion)

    def scale(self, q: np.ndarray, factor: float) -> float:
        """Norm of the force on the rings, N, or of what lets rounding pass."""
        force = self._all_forces(q, factor)
        rings = np.stack([force[:, :RING_ROWS], force[:, -RING_ROWS:]])
        return max(float(np.linalg.norm(rings)), self._floor)

    def force(self, q: np.ndarray, factor: float) -> float:
        """Reaction on the top ring, N, positive where the sheet pushes it up."""
        return -float(self._all_forces(q, factor)[2, -RING_ROWS:].sum())

    def _all_forces(self, q: np.ndarray, factor: float) -> np.ndarray:
        points = self.points(q, factor)
        force = np.empty_like(points)
        self._problem.force(points, force)
        return force
