"""What closed contacts are as springs between their closest points."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse
from numba import njit

from foilstudy.model.contact.stencils import Pressing
from foilstudy.model.contact.surface import Triangulation
from foilstudy.model.patch import RING_ROWS

STIFFNESS = 3e-3
"""Energy of a barrier relative to membrane stiffness times reach squared."""


class Springs:
    """Part of a term of contact: what is closed, taken as springs.

    A term says which sets of four knots are closed (`_closed_knots`), and of each the stiffness,
    N/m, the weights of the four, which add up to zero, and the direction (`springs`), all in the
    last shape with a finite energy.

    Parameters
    ----------
    surface : Triangulation
    membrane_stiffness : float
        E t/(1 - nu^2), N/m.
    """

    def __init__(self, surface: Triangulation, membrane_stiffness: float):
        self._surface, self.membrane_stiffness = surface, membrane_stiffness
        self._standing: np.ndarray | None = None

    @property
    def surface(self) -> Triangulation:
        """That touches."""
        return self._surface

    def knots(self) -> np.ndarray:
        """The last shape with a finite energy, shape (count, 3), m."""
        raise NotImplementedError

    def springs(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Stiffness, weights and direction of what is closed in that shape."""
        raise NotImplementedError

    def pressing(self) -> Pressing:
        """What is closed in that shape, and how hard it is pressed."""
        raise NotImplementedError

    def _closed_knots(self) -> np.ndarray:
        raise NotImplementedError

    def _reached(self, points: np.ndarray) -> bool:
        raise NotImplementedError

    def stand_at(self, points: np.ndarray) -> None:
        """Note the shape that what is asked for before any force is of."""
        self._standing = points

    def _arrive(self) -> None:
        """Go to that shape, if none has been reached."""
        if not self._has_begun():
            if self._standing is None:
                raise ValueError("nothing is known of contacts before a force has been asked for")
            self._reached(self._standing)

    def _has_begun(self) -> bool:
        raise NotImplementedError

    def touches(self) -> bool:
        """Whether anything is closed in that shape."""
        return len(self._closed_knots()) > 0

    def closed_at(self, points: np.ndarray) -> int:
        """Contacts that are closed in a shape.

        Raises
        ------
        ValueError
            If the energy is infinite there.
        """
        if not self._reached(points):
            raise ValueError("a sheet has no contacts in a shape that passes through something")
        return len(self._closed_knots())

    def pressing_at(self, points: np.ndarray) -> Pressing | None:
        """What is closed in a shape; None where the energy is infinite."""
        return self.pressing() if self._reached(points) else None

    def free_way(self, free: np.ndarray) -> bool:
        """Whether a motion of the control points between the rings meets nothing, for sure."""
        return False

    def knot_motion(self, free: np.ndarray) -> np.ndarray:
        """Motion of the knots with one of the control points between the rings, those standing."""
        field = np.zeros(self._surface.patch.shape)
        field[:, RING_ROWS:-RING_ROWS] = free
        return self._surface.knots(field)

    def spring_forces(self, free: np.ndarray) -> np.ndarray:
        """Forces of the springs along their gaps in a small motion.

        Parameters
        ----------
        free : ndarray, shape (3, free rows, columns)
            Motion of the control points between the rings, m.

        Returns
        -------
        ndarray, same shape
            On these, N.
        """
        motion = self.knot_motion(free)
        forces = np.zeros_like(motion)
        spring_forces(self._closed_knots(), *self.springs(), motion, forces)
        out = np.empty(self._surface.patch.shape)
        self._surface.gathered(forces, out)
        return np.ascontiguousarray(out[:, RING_ROWS:-RING_ROWS])

    def spring_tangent(
        self, points: np.ndarray, stiffness: float | None = None, stuck: bool = False
    ) -> sparse.csr_matrix:
        """Stiffness of the springs, without stress; a rigid motion costs nothing.

        Parameters
        ----------
        points : ndarray, shape (3, rows, columns)
            m.
        stiffness : float, optional
            Of every spring, N/m; that of the barrier by default.
        stuck : bool
            Whether they resist sliding as well as approach.

        Returns
        -------
        csr_matrix
            On all control points; positive semi-definite.
        """
        self.closed_at(points)
        closed = self._closed_knots()
        own, weights, direction = self.springs()
        size = np.maximum(own, 0.0) if stiffness is None else np.full(len(own), stiffness)
        stretch = spring_stretches(self.knots()[closed], weights, direction, stuck)
        return self.on_points(closed, np.einsum("p,pki,pkj->pij", size, stretch, stretch))

    def on_points(self, knots: np.ndarray, blocks: np.ndarray) -> sparse.csr_matrix:
        """Matrix on the control points, from one on each set of knots."""
        spread = self._surface.spread()
        if not len(knots):
            return sparse.csr_matrix((spread.shape[1], spread.shape[1]))
        size = 3 * knots.shape[1]
        index = (3 * knots[:, :, None] + np.arange(3)).reshape(-1, size)
        row, column = np.repeat(index, size, axis=1), np.tile(index, (1, size))
        entries = blocks.ravel(), (row.ravel(), column.ravel())
        matrix = sparse.coo_matrix(entries, (spread.shape[0], spread.shape[0])).tocsr()
        return (spread.T @ matrix @ spread).tocsr()


@njit(cache=True, error_model="numpy")
def spring_forces(pairs, stiffness, weights, direction, motion, forces):
    """Add the forces of such springs in a motion, both on the knots, to `forces`."""
    for p in range(len(pairs)):
        stretch = 0.0
        for i in range(4):
            for c in range(3):
                stretch += weights[p, i] * direction[p, c] * motion[pairs[p, i], c]
        pull = stiffness[p] * stretch
        for i in range(4):
            for c in range(3):
                forces[pairs[p, i], c] += pull * weights[p, i] * direction[p, c]


def spring_stretches(
    x: np.ndarray, weights: np.ndarray, direction: np.ndarray, stuck: bool
) -> np.ndarray:
    """How springs between closest points stretch with the motion of the four points of a pair.

    Those that resist sliding leave out what the pair turns as a whole, by least squares over its
    points, so that a rigid motion costs nothing.

    Parameters
    ----------
    x : ndarray, shape (pairs, 4, 3)
        m.
    weights, direction : ndarray, shapes (pairs, 4), (pairs, 3)
        See `springs`.
    stuck : bool
        Whether they resist sliding as well as approach.

    Returns
    -------
    ndarray, shape (pairs, 1 or 3, 12)
    """
    if not stuck:
        along = weights[:, :, None] * direction[:, None, :]
        return along.reshape(-1, 1, 12)
    arms = x - x.mean(axis=1, keepdims=True)
    inertia = np.sum(arms**2, axis=(1, 2))[:, None, None] * np.eye(3) - np.einsum(
        "pik,pil->pkl", arms, arms
    )
    vector = np.einsum("pi,pik->pk", weights, x)
    # slip = sum a_i u_i - turn x w, turn = J^-1 sum r_i x u_i
    turn = np.linalg.solve(inertia[:, None], _crossing(arms))
    slip = weights[:, :, None, None] * np.eye(3) + _crossing(vector)[:, None] @ turn
    return np.ascontiguousarray(slip.transpose(0, 2, 1, 3)).reshape(-1, 3, 12)


def _crossing(vectors: np.ndarray) -> np.ndarray:
    """Matrices of v x ."""
    out = np.zeros((*vectors.shape, 3))
    x, y, z = np.moveaxis(vectors, -1, 0)
    out[..., 0, 1], out[..., 0, 2], out[..., 1, 2] = -z, y, -x
    out[..., 1, 0], out[..., 2, 0], out[..., 2, 1] = z, -y, x
    return out
