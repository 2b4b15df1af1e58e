"""Equilibria of a sheet whose top ring is moved or pulled as one rigid body; the bottom one stands.

The rotation of the ring is that of the quaternion (1, theta / 2), a rational function whose
derivatives are exact at any size; to first order theta is the rotation vector.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg import SymmetricBlocks, factorise
from foilstudy.model.patch import RING_ROWS
from foilstudy.solve.equilibrium.newton import NewtonOptions, minimise
from foilstudy.solve.problem import Problem

_FREE, _TOP = slice(RING_ROWS, -RING_ROWS), slice(-RING_ROWS, None)
_RESIDUAL, _HESSIANS = 1e-8, 20


@dataclass(frozen=True, eq=False)
class Guide:
    """What the top ring is made to do.

    Attributes
    ----------
    motion : ndarray, shape (6,)
        Translation, m, and rotation about the centre of the ring, rad; of free motions not read.
    free : tuple of int
        Which of the six the ring finds by itself.
    force : ndarray, shape (6,)
        Dead force on the centre of the ring, N, and moment that works on the rotation, N m.
    """

    motion: np.ndarray = field(default_factory=lambda: np.zeros(6))
    free: tuple[int, ...] = ()
    force: np.ndarray = field(default_factory=lambda: np.zeros(6))


@dataclass(frozen=True, eq=False)
class GuidedEquilibrium:
    """Where a guided sheet came to rest.

    Attributes
    ----------
    status, message : str
        As of `newton.NewtonResult`: ``converged`` at a minimum alone.
    points : ndarray, shape (3, rows, columns)
        m.
    motion : ndarray, shape (6,)
        Of the top ring, m and rad.
    energy : float
        Potential energy of the problem, without the work of the guide, J.
    pull : ndarray, shape (2, 6)
        Forces and moments that hold the bottom and the top ring, each about its own centre and as
        it stands now, N and N m.
    """

    status: str
    message: str
    points: np.ndarray
    motion: np.ndarray
    energy: float
    pull: np.ndarray


class GuidedSheet:
    """Potential energy of a sheet and the force on its top ring, for `minimise`.

    Unknowns are the control points between the rings and the free motions of the top ring, where a
    rotation counts as its path on the rim, so that all of them are in m.

    Parameters
    ----------
    problem : Problem
        The state of terms with memory stays the one that was last committed.
    points : ndarray, shape (3, rows, columns)
        Control points from which the motion is counted, m.
    guide : Guide
    """

    def __init__(self, problem: Problem, points: np.ndarray, guide: Guide):
        self._problem, self._points, self._guide = problem, points.copy(), guide
        ring = points[:, _TOP].reshape(3, -1)
        self._centre = np.array([[0.0], [0.0], [ring[2].mean()]])
        self._arms = ring - self._centre
        rim = float(np.linalg.norm(self._arms[:2], axis=0).mean())
        self._lengths = np.array([1.0] * 3 + [rim] * 3)[list(guide.free)]
        self._force = np.empty_like(points)
        self._at: np.ndarray | None = None
        self._scale = np.nan

    def unknowns(self, points: np.ndarray, motion: np.ndarray) -> np.ndarray:
        """Those of a shape between the rings, and of a motion of the top one."""
        between = points[:, _FREE].transpose(1, 2, 0).ravel()
        return np.concatenate([between, motion[list(self._guide.free)] * self._lengths])

    def motion(self, q: np.ndarray) -> np.ndarray:
        """All six motions of the top ring, m and rad."""
        motion = np.array(self._guide.motion, dtype=float)
        if free := len(self._guide.free):
            motion[list(self._guide.free)] = q[-free:] / self._lengths
        return motion

    def points(self, q: np.ndarray) -> np.ndarray:
        """Control points, shape (3, rows, columns), m."""
        points = self._points.copy()
        between, top = points[:, _FREE], points[:, _TOP]
        size = between.size
        between[:] = q[:size].reshape(*between.shape[1:], 3).transpose(2, 0, 1)
        motion = self.motion(q)
        turned = _rotation(motion[3:])[0] @ self._arms
        top[:] = (self._centre + motion[:3, None] + turned).reshape(top.shape)
        return points

    def value_and_gradient(self, q: np.ndarray) -> tuple[float, np.ndarray]:
        """See `newton.Potential`; J and N."""
        motion, guide = self.motion(q), self._guide
        energies = self._problem.force(self.points(q), self._force)
        top = self._force[:, _TOP].reshape(3, -1)
        bottom, load = self._force[:, :RING_ROWS], guide.force[:3]
        above = max(np.linalg.norm(top), np.linalg.norm(load))
        self._scale = float(np.hypot(np.linalg.norm(bottom), above))
        self._at = q.copy()
        turning = np.einsum("kij,ij->k", _rotation(motion[3:])[1], top @ self._arms.T)
        on_ring = np.concatenate([top.sum(axis=1), turning]) - guide.force
        between = self._force[:, _FREE].transpose(1, 2, 0).ravel()
        gradient = np.concatenate([between, on_ring[list(guide.free)] / self._lengths])
        return float(energies.sum() - guide.force @ motion), gradient

    def hessian(self, q: np.ndarray) -> sparse.csr_matrix | SymmetricBlocks:
        """See `newton.Potential`; N/m."""
        points, free = self.points(q), list(self._guide.free)
        if not free:
            return self._problem.held_tangent(points)
        motion = self.motion(q)
        _, first, second = _rotation(motion[3:])
        arms = np.einsum("kij,jp->pik", first, self._arms).reshape(-1, 3)
        shifts = np.tile(np.eye(3), (self._arms.shape[1], 1))
        ring = np.hstack([shifts, arms])[:, free] / self._lengths
        owned, between = ring.shape[0], len(q) - len(free)
        spread = sparse.block_diag([sparse.identity(between), sparse.csr_matrix(ring)], "csr")
        tangent = self._problem.tangent(points)[owned:, owned:]
        reduced = (spread.T @ (tangent @ spread)).tolil()
        self._problem.force(points, self._force)
        moment = self._force[:, _TOP].reshape(3, -1) @ self._arms.T
        turning = np.zeros((6, 6))
        turning[3:, 3:] = np.einsum("klij,ij->kl", second, moment)
        turning = turning[np.ix_(free, free)] / np.outer(self._lengths, self._lengths)
        reduced[between:, between:] += turning
        return reduced.tocsr()

    def scale(self, q: np.ndarray) -> float:
        """Norm of the forces on the rings, or of the load, N: the scale of residuals."""
        if self._at is None or not np.array_equal(self._at, q):
            self.value_and_gradient(q)
        return self._scale

    def at_rest(self, q: np.ndarray, status: str, message: str) -> GuidedEquilibrium:
        """What is measured of the shape."""
        points, motion = self.points(q), self.motion(q)
        energies = self._problem.force(points, self._force)
        pull = np.array([_held(points, self._force, rows) for rows in (slice(RING_ROWS), _TOP)])
        return GuidedEquilibrium(status, message, points, motion, float(energies.sum()), pull)

    def predicted(self, before: GuidedEquilibrium) -> np.ndarray:
        """Unknowns once the sheet has followed what is prescribed linearly from a shape before.

        Raises
        ------
        SolveError
            If the tangent with held rings is singular or indefinite there.
        """
        problem, points = self._problem, before.points
        start = self.unknowns(points, before.motion)
        step = self.points(start) - points
        if not step.any():
            return start
        push = problem.tangent(points) @ np.moveaxis(step, 0, -1).ravel()
        owned = RING_ROWS * 3 * points.shape[2]
        between = start.size - len(self._guide.free)
        factor = factorise(problem.held_tangent(points))
        start[:between] -= factor.solve(push[owned:-owned])
        return start


def untouched(problem: Problem, points: np.ndarray) -> GuidedEquilibrium:
    """An equilibrium with held rings, from which motions are counted."""
    sheet = GuidedSheet(problem, points, Guide())
    no_motion = np.zeros(6)
    return sheet.at_rest(sheet.unknowns(points, no_motion), "converged", "not moved")


def guided(
    problem: Problem,
    points: np.ndarray,
    guide: Guide,
    before: GuidedEquilibrium | None = None,
) -> GuidedEquilibrium:
    """Stable equilibrium of a sheet under a guide.

    Parameters
    ----------
    problem : Problem
    points : ndarray, shape (3, rows, columns)
        Control points of the equilibrium from which motions are counted, m.
    guide : Guide
    before : GuidedEquilibrium, optional
        Where the search begins: that equilibrium itself by default.

    Returns
    -------
    GuidedEquilibrium
        Never raises for a sheet that does not come to rest: the status says so.

    Raises
    ------
    SolveError
        If the tangent at the start is singular or indefinite with held rings.
    """
    sheet = GuidedSheet(problem, points, guide)
    start = sheet.predicted(before or untouched(problem, points))
    found = minimise(sheet, start, NewtonOptions(_RESIDUAL, sheet.scale, _HESSIANS))
    return sheet.at_rest(found.q, found.status, found.message)


def _held(points: np.ndarray, force: np.ndarray, rows: slice) -> np.ndarray:
    """Force and moment about its centre of what acts on a ring, shape (6,)."""
    ring, forces = points[:, rows].reshape(3, -1), force[:, rows].reshape(3, -1)
    arms = ring - ring.mean(axis=1, keepdims=True)
    return np.concatenate([forces.sum(axis=1), np.cross(arms, forces, axis=0).sum(axis=1)])


def _rotation(theta: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rotation matrix with its first and second derivatives, (3, 3), (3, 3, 3), (3, 3, 3, 3)."""
    half, one = 0.5 * np.asarray(theta), np.eye(3)
    cross = np.cross(one[:, None], one[None])  # e_k x e_j, so that its [k, j] is a column
    turn = 2 * np.swapaxes(cross, 1, 2)
    outer = np.einsum("ka,b->kab", one, half)
    n = (1 - half @ half) * one + 2 * np.outer(half, half) + np.tensordot(half, turn, 1)
    dn = -2 * half[:, None, None] * one + 2 * (outer + np.swapaxes(outer, 1, 2)) + turn
    pair = np.einsum("ka,lb->klab", one, one)
    ddn = -2 * np.einsum("kl,ab->klab", one, one) + 2 * (pair + np.swapaxes(pair, 2, 3))
    d, dd, ddd = 1 + half @ half, 2 * half, 2 * one
    r = n / d
    dr = (dn - dd[:, None, None] * r) / d
    mixed = np.einsum("kab,l->klab", dr, dd)
    ddr = (ddn - mixed - np.swapaxes(mixed, 0, 1) - np.einsum("kl,ab->klab", ddd, r)) / d
    return r, dr / 2, ddr / 4
