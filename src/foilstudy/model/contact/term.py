"""Self-contact as a term of the potential energy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from foilstudy.base.errors import Refusal
from foilstudy.model.contact.barrier import PARALLEL
from foilstudy.model.contact.followed import FollowedPairs
from foilstudy.model.contact.pairs import (
    exert,
    hessians,
    normal_forces,
    springs,
)
from foilstudy.model.contact.sizes import reach_on, skin_on
from foilstudy.model.contact.springs import STIFFNESS, Springs
from foilstudy.model.contact.stencils import Pressing, with_edges
from foilstudy.model.contact.surface import (
    largest_control_deviation,
    largest_motion,
    triangulation,
)
from foilstudy.model.shell.intersection import self_crossing_share
from foilstudy.model.shell.section import Section

_CLOSING = 0.95
"""Share of its gap by which a pair may close between two shapes that are evaluated."""
_RINGS = 4.0
"""Motion of the rings that is reckoned with, relative to that in the last step."""
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


class SelfContact(Springs):
    """Barrier between parts of a sheet that come near each other; without memory.

    A shape that crosses itself, or to which the straight way from the last shape with a finite
    energy would close a gap almost or altogether, has infinite energy. So a search or a motion that
    only goes on from finite energies never crosses.

    Parameters
    ----------
    section : Section
        Of the sheet, on a closed patch.
    reach : float, optional
        m; see `sizes.reach_on`.
    stiffness : float
        See `options.BarrierContact`.

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

    energy_names, name = ("contact",), "contact"

    def __init__(self, section: Section, reach: float | None = None, stiffness: float = STIFFNESS):
        material = section.law.material
        membrane = material.youngs_modulus * section.thickness / (1 - material.poisson_ratio**2)
        patch = section.patch
        super().__init__(triangulation(patch), membrane)
        self.thickness = section.thickness
        self.reach = reach_on(patch, section.thickness, reach)
        self._skin = skin_on(patch, section.thickness, self.reach)
        self._far = _FAR * min(patch.size_around, patch.size_along)
        self._span = (self.thickness + self.reach) ** 2 - self.thickness**2
        self._size = stiffness * membrane * self.reach**2
        self._rest = self._surface.knots(section.reference)
        self._followed: FollowedPairs | None = None
        # a shape where nothing was within the reach and how much nearer knots may come from it on,
        # the last shape, whether the pairs have not seen it, and what is left there
        self._calm: tuple[np.ndarray, float] | None = None
        self._unseen, self._is_behind, self._left = np.empty(0), False, 0.0
        self._ring_motion = 0.0  # in the last step, about
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
        if not self.touches():
            return np.zeros(1)
        closed = self.closed()
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
        return self.on_points(closed.pairs, blocks)

    def _has_begun(self) -> bool:
        return self._followed is not None

    def _reached(self, points: np.ndarray) -> bool:
        """Go to a shape, unless it or the way to it crosses."""
        if self._still(points):
            return True
        knots = self._surface.knots(points)
        if not np.isfinite(knots).all() or not self._gone_to(knots):
            return False
        self._settle_down(points)
        return True

    def _gone_to(self, knots: np.ndarray) -> bool:
        followed = self._followed
        if followed is None:
            if not (begun := self._begun(knots)):
                raise Refusal(
                    "the foil crosses itself, or lies nearer than its thickness, in the shape from "
                    "which it would be moved with contact; start from one that does not."
                )
            self._followed = begun
            return True
        if np.array_equal(knots, followed.knots):
            return True
        if followed.shift(knots) > self._far:
            if not (begun := self._begun(knots)):
                return False
            self._followed = begun
            return True
        if followed.share(knots - followed.knots, _CLOSING) < 1.0:
            return False
        followed.move(knots)
        return True

    def rests(self, points: np.ndarray) -> bool:
        """See `solve.problem.Resting`."""
        return self._still(points)

    def _still(self, points: np.ndarray) -> bool:
        """Whether for sure nothing has come within the reach since a shape where nothing was."""
        if self._calm is None:
            return False
        calm, rest = self._calm
        self._left = rest - 2.0 * largest_control_deviation(points, calm)
        if self._left > 0.0:
            way = points[:, -1, 0] - self._unseen[:, -1, 0]
            self._ring_motion = float(np.sqrt(way @ way))
            np.copyto(self._unseen, points)
            self._is_behind = True
            return True
        self._catch_up()
        self._calm = None
        return False

    def _settle_down(self, points: np.ndarray) -> None:
        """Note a shape where nothing is within the reach, and how far it may be left unseen."""
        self._left = self._followed.rest()
        self._calm = None
        if self._left > 0.0:
            self._calm, self._unseen = (points.copy(), self._left), points.copy()

    def _catch_up(self) -> FollowedPairs:
        """The pairs, in the last shape with a finite energy."""
        if self._is_behind:
            self._followed.move(self._surface.knots(self._unseen))
            self._is_behind = False
        return self._followed

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
        pairs, edges = followed.pairs[active], followed.edges[active]
        lengths = self._rest[pairs[:, 1:4:2]] - self._rest[pairs[:, 0:3:2]]
        full = PARALLEL * np.prod(np.sum(lengths**2, axis=2), axis=1)
        self._closed = active, Closed(pairs, edges, full)
        return self._closed[1]

    def _closed_knots(self) -> np.ndarray:
        return self.closed().pairs

    def numbers(self, state: None = None) -> dict[str, float]:
        """Of the last shape with a finite energy, by the names of quantities."""
        self._arrive()
        self._catch_up()
        closed = self.closed()
        gap = self._followed.least_distance() - self.thickness
        return {
            "contact_pairs": float(len(closed)),
            "contact_gap_min": gap if len(closed) else np.nan,
            "contact_share": len(np.unique(closed.pairs)) / self._surface.count,
        }

    def knots(self) -> np.ndarray:
        """See `Springs`."""
        return self._catch_up().knots

    def free_way(self, free: np.ndarray) -> bool:
        """Whether a motion of the control points between the rings meets nothing, for sure.

        The rings are taken to move hardly more than in the last step; if they do, the way is
        judged when it has been gone.
        """
        if self._calm is None:
            return False
        needed = 2.0 * largest_motion(free) + _RINGS * self._ring_motion
        if needed < self._left:
            return True
        if not 2.0 * needed < self._calm[1]:
            return False
        self._catch_up().renew()
        self._settle_down(self._unseen)
        return needed < self._left

    def touches(self) -> bool:
        """See `Springs`."""
        return self._calm is None and super().touches()

    def passable_share(self, motion: np.ndarray, closing: float) -> float:
        """Part of a motion of the knots in which no gap closes by more than a share of it.

        Parameters
        ----------
        motion : ndarray, shape (count, 3)
            From the last shape with a finite energy, m.
        closing : float
        """
        return self._catch_up().share(motion, closing)

    def springs(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Stiffness, weights and direction of the closed pairs, see `pairs.springs`."""
        closed = self.closed()
        return springs(
            self._followed.knots, closed.pairs, closed.edges, self.thickness, self._span, self._size
        )

    def pressing(self) -> Pressing:
        """See `Springs`."""
        closed, knots = self.closed(), self._followed.knots
        force = normal_forces(
            knots, closed.pairs, closed.edges, closed.full, self.thickness, self._span, self._size
        )
        _, weights, direction = self.springs()
        return with_edges(self._surface, closed.pairs, closed.edges, weights, direction, force)
