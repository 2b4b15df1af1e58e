"""Self-contact as a term of the potential energy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from foilstudy.base.errors import Refusal
from foilstudy.model.contact.barrier import PARALLEL
from foilstudy.model.contact.options import Contact
from foilstudy.model.contact.pairs import (
    FollowedPairs,
    exert,
    hessians,
    spring_forces,
    springs,
)
from foilstudy.model.contact.surface import triangulation
from foilstudy.model.patch import RING_ROWS
from foilstudy.model.shell.intersection import self_crossing_share
from foilstudy.model.shell.section import Section

_CLOSING = 0.95
"""Share of its gap by which a pair may close between two shapes that are evaluated."""
_FAR = 0.5
"""Motion relative to the side of an element beyond which a shape is judged by itself, not by the
way to it."""


@dataclass(frozen=True, eq=False)
class Closed:
    """Pairs within the reach.

    Attributes
    ----------
    pairs : ndarray of int, shape (active, 4)
        Knots: a point and a triangle, or two edges.
    edges : ndarray of bool, shape (active,)
        Which of the two.
    full : ndarray, shape (active,)
        See `barrier.pair_energy`.
    """

    pairs: np.ndarray
    edges: np.ndarray
    full: np.ndarray

    def __len__(self) -> int:
        return len(self.pairs)


class SelfContact:
    """Barrier between parts of a sheet that come near each other; without memory.

    A shape that crosses itself, or to which the straight way from the last shape with a finite
    energy would close a gap almost or altogether, has infinite energy. So a search or a motion that
    only goes on from finite energies never crosses.

    Parameters
    ----------
    section : Section
        Of the sheet, on a closed patch.
    contact : Contact, optional

    Attributes
    ----------
    thickness, reach : float
        m.
    membrane_stiffness : float
        E t/(1 - nu^2), N/m.

    Raises
    ------
    Refusal
        If thickness and reach are too large for the elements.
    """

    energy_names = ("contact",)

    def __init__(self, section: Section, contact: Contact | None = None):
        contact = contact or Contact()
        material = section.law.material
        membrane = material.youngs_modulus * section.thickness / (1 - material.poisson_ratio**2)
        patch = section.patch
        self._surface = triangulation(patch)
        self._skin = contact.skin_on(patch, section.thickness)
        self._far = _FAR * min(patch.size_around, patch.size_along)
        self.thickness, self.reach = section.thickness, contact.reach
        self._span = (section.thickness + contact.reach) ** 2 - section.thickness**2
        self.membrane_stiffness = membrane
        self._size = contact.stiffness * membrane * contact.reach**2
        self._rest = self._surface.knots(section.reference)
        self._followed: FollowedPairs | None = None
        self._closed: tuple[np.ndarray | None, Closed | None] = None, None

    def __repr__(self) -> str:
        return f"<SelfContact: {1e6 * self.thickness:g} µm, reach {1e3 * self.reach:g} mm>"

    def start(self) -> None:
        """There is no memory."""

    def evolved(self, points: np.ndarray, state: None) -> None:
        """There is no memory."""

    def force(self, points: np.ndarray, out: np.ndarray, state: None = None) -> np.ndarray:
        """See `solve.problem.Term`.

        Raises
        ------
        Refusal
            If the first shape that is asked for crosses itself.
        """
        out[:] = 0.0
        if not self._reached(points):
            return np.array([np.inf])
        closed = self.closed()
        if not len(closed):
            return np.zeros(1)
        forces = np.zeros_like(self._followed.knots)
        energy = exert(
            self._followed.knots, closed.pairs, closed.edges, closed.full, self.thickness,
            self._span, self._size, forces,
        )  # fmt: skip
        self._surface.gathered(forces, out)
        return np.array([energy])

    def tangent(self, points: np.ndarray, state: None = None) -> sparse.csr_matrix:
        """See `solve.problem.Term`.

        Raises
        ------
        ValueError
            If the energy is infinite there.
        """
        if not self._reached(points):
            raise ValueError("a sheet has no tangent in a shape that crosses itself")
        closed = self.closed()
        blocks = hessians(
            self._followed.knots, closed.pairs, closed.edges, closed.full, self.thickness,
            self._span, self._size,
        )  # fmt: skip
        return self._on_points(closed, blocks)

    def _on_points(self, closed: Closed, blocks: np.ndarray) -> sparse.csr_matrix:
        """Matrix on the control points, from one on the four points of every closed pair."""
        spread = self._surface.spread()
        if not len(closed):
            return sparse.csr_matrix((spread.shape[1], spread.shape[1]))
        index = (3 * closed.pairs[:, :, None] + np.arange(3)).reshape(-1, 12)
        row, column = np.repeat(index, 12, axis=1), np.tile(index, (1, 12))
        entries = blocks.ravel(), (row.ravel(), column.ravel())
        matrix = sparse.coo_matrix(entries, (spread.shape[0], spread.shape[0])).tocsr()
        return (spread.T @ matrix @ spread).tocsr()

    def _reached(self, points: np.ndarray) -> bool:
        """Go to a shape, unless it or the way to it crosses."""
        knots = self._surface.knots(points)
        if not np.isfinite(knots).all():
            return False
        if self._followed is None:
            if not (begun := self._begun(knots)):
                raise Refusal(
                    "the foil crosses itself, or lies nearer than its thickness, in the shape from "
                    "which it would be moved with contact; start from one that does not."
                )
            self._followed = begun
            return True
        followed = self._followed
        if np.array_equal(knots, followed.knots):
            return True
        shift = followed.shift(knots)
        if shift > self._far:
            if not (begun := self._begun(knots)):
                return False
            self._followed = begun
            return True
        if followed.share(knots - followed.knots, shift, _CLOSING) < 1.0:
            return False
        followed.move(knots, shift)
        return True

    def _begun(self, knots: np.ndarray) -> FollowedPairs | None:
        """The pairs of a shape by itself; None where it crosses."""
        patch = self._surface.patch
        grid = knots.T.reshape(3, patch.rows - 1, patch.columns)
        if self_crossing_share(grid) > 0:
            return None
        begun = FollowedPairs(self._surface, knots, self.thickness, self.reach, self._skin)
        return begun if begun.least_distance() > self.thickness else None

    def closed(self) -> Closed:
        """The pairs within the reach in the last shape with a finite energy."""
        followed = self._followed
        active = followed.active()
        if self._closed[0] is active:
            return self._closed[1]
        pairs, edges = followed.pairs[active], active >= followed.touching
        lengths = self._rest[pairs[:, 1:4:2]] - self._rest[pairs[:, 0:3:2]]
        full = PARALLEL * np.prod(np.sum(lengths**2, axis=2), axis=1)
        self._closed = active, Closed(pairs, edges, full)
        return self._closed[1]

    @property
    def knots(self) -> np.ndarray:
        """The last shape with a finite energy, shape (count, 3), m."""
        return self._followed.knots

    def knot_motion(self, free: np.ndarray) -> np.ndarray:
        """Motion of the knots with one of the control points between the rings, those standing."""
        return self._surface.knots(self._between_rings(free))

    def passable_share(self, motion: np.ndarray, closing: float) -> float:
        """Part of a motion of the knots in which no gap closes by more than a share of it.

        Parameters
        ----------
        motion : ndarray, shape (count, 3)
            From the last shape with a finite energy, m.
        closing : float
        """
        followed = self._followed
        return followed.share(motion, followed.shift(followed.knots + motion), closing)

    def spring_forces(self, free: np.ndarray) -> np.ndarray:
        """Forces of the closed pairs as springs along their gaps, in a small motion.

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
        spring_forces(self.closed().pairs, *self.springs(), motion, forces)
        out = np.empty(self._surface.patch.shape)
        self._surface.gathered(forces, out)
        return np.ascontiguousarray(out[:, RING_ROWS:-RING_ROWS])

    def springs(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Stiffness, weights and direction of the closed pairs, see `pairs.springs`."""
        closed = self.closed()
        return springs(
            self._followed.knots, closed.pairs, closed.edges, self.thickness, self._span, self._size
        )

    def spring_tangent(
        self, points: np.ndarray, stiffness: float | None = None, stuck: bool = False
    ) -> sparse.csr_matrix:
        """Stiffness of the closed pairs as springs between their closest points, without stress.

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
            On all control points, as `tangent`; positive semi-definite.
        """
        if not self._reached(points):
            raise ValueError("a sheet has no contacts in a shape that crosses itself")
        own, weights, direction = self.springs()
        size = np.maximum(own, 0.0) if stiffness is None else np.full(len(own), stiffness)
        across = np.eye(3) if stuck else direction[:, :, None] * direction[:, None, :]
        pair = size[:, None, None] * weights[:, :, None] * weights[:, None, :]
        blocks = np.einsum("pij,kl->pikjl" if stuck else "pij,pkl->pikjl", pair, across)
        return self._on_points(self.closed(), blocks.reshape(-1, 12, 12))

    def _between_rings(self, free: np.ndarray) -> np.ndarray:
        field = np.zeros(self._surface.patch.shape)
        field[:, RING_ROWS:-RING_ROWS] = free
        return field
