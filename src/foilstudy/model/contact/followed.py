"""Which pairs are within the reach, followed from shape to shape.

The surface is cut into blocks. How much nearer two blocks may have come is bounded by the motion of
their means against each other and by what their knots deviate from these; the pairs of two blocks
are sought anew when that bound has used up half of their skin. All that is done once in a while, in
a shape of which every pair is measured. In those that follow, lists are complete until knots have
moved by what the last of the skins leaves, and only the pairs are looked at whose gap beyond the
reach the motion may have used up.
"""

from __future__ import annotations

import numpy as np

from foilstudy.model.contact.blocks import blocks_of, closing_bounds, spread
from foilstudy.model.contact.candidates import Balls, candidates
from foilstudy.model.contact.pairs import distances
from foilstudy.model.contact.passing import passable_share
from foilstudy.model.contact.surface import Triangulation, largest_deviation

_MET = 1.5
"""Gap within which blocks are followed, relative to the larger side of an element."""
_MET_LEFT, _SKIN_LEFT = 0.3, 0.5
"""Share of that gap, and of a skin, from which on either is made anew."""


class FollowedPairs:
    """Pairs that are near in the shape that was reached last.

    Parameters
    ----------
    surface : Triangulation
    knots : ndarray, shape (count, 3)
        The first shape, m.
    thickness, reach, skin : float
        m.

    Attributes
    ----------
    knots : ndarray, shape (count, 3)
        The shape that was reached last, m.
    pairs : ndarray of int, shape (pairs, 4)
    edges : ndarray of bool, shape (pairs,)
        Two edges, rather than a point and a triangle.
    """

    def __init__(
        self,
        surface: Triangulation,
        knots: np.ndarray,
        thickness: float,
        reach: float,
        skin: float,
    ):
        self._surface, self.knots = surface, knots
        self._thickness, self._cutoff, self._skin = thickness, thickness + reach, skin
        self._met = _MET * max(surface.patch.size_around, surface.patch.size_along)
        self._blocks, self._balls = blocks_of(surface), Balls(surface)
        self._active: np.ndarray | None = None
        self._measured_at, self._near = knots, np.empty((0, 2), dtype=np.int64)
        # by which two blocks may have come nearer, and until when their pairs are listed
        self._travel = self._until = np.empty(0)
        self.pairs, self.edges = np.empty((0, 4), dtype=np.int64), np.empty(0, dtype=bool)
        self._owner = np.empty(0, dtype=np.int64)
        self._meet()
        self._list(self._until < 0.0, self._skin)
        self._measure()

    def shift(self, knots: np.ndarray) -> float:
        """Largest motion of a knot from the shape reached last, beside that of all, m."""
        return largest_deviation(knots, self.knots)

    def share(self, motion: np.ndarray, closing: float) -> float:
        """Part of a motion from the shape reached last in which no gap closes by a larger share.

        Parameters
        ----------
        motion : ndarray, shape (count, 3)
            m.
        closing : float
        """
        there = self.knots + motion
        used = 2.0 * largest_deviation(there, self._measured_at)
        if used >= self._rest:
            self._renew()
            used = 2.0 * largest_deviation(there, self._measured_at)
            if used >= self._rest:
                self._list_for(motion)
        looked_at = np.searchsorted(self._slack, used)
        return passable_share(
            self.knots, motion, self.pairs[:looked_at], self.edges[:looked_at],
            self._thickness, closing,
        )  # fmt: skip

    def move(self, knots: np.ndarray) -> None:
        """Take note of the shape reached by a motion of which `share` has been asked."""
        self.knots, self._active = knots, None

    def active(self) -> np.ndarray:
        """Pairs within the reach, in an order that follows from the shape alone."""
        if self._active is None:
            used = 2.0 * largest_deviation(self.knots, self._measured_at)
            if used >= self._rest:
                self._renew()
                used = 0.0
            looked_at = np.searchsorted(self._slack, used)
            pairs, edges = self.pairs[:looked_at], self.edges[:looked_at]
            found = np.flatnonzero(distances(self.knots, pairs, edges) < self._cutoff)
            if len(found) > 1:
                found = found[np.lexsort((*pairs[found].T[::-1], edges[found]))]
            self._active = found
        return self._active

    def least_distance(self) -> float:
        """Smallest distance of a pair, m; infinite where none is within the reach."""
        active = self.active()
        return distances(self.knots, self.pairs[active], self.edges[active]).min(initial=np.inf)

    def rest(self) -> float:
        """By how much any two knots may come nearer until something may be within the reach, m."""
        if len(self.active()):
            return 0.0
        used = 2.0 * largest_deviation(self.knots, self._measured_at)
        return min(self._rest, float(self._slack[:1].min(initial=np.inf))) - used

    def _meet(self) -> None:
        """Find the blocks that are near in the shape reached last; what is known of them is kept.

        Of others nothing is within their gap, which holds until they are met again.
        """
        before, self._met_at = self._near, self.knots
        self._near, gaps = self._blocks.near(self.knots, self._cutoff + self._met)
        count = len(self._blocks.knot_starts)
        old, new = (pairs[:, 0] * count + pairs[:, 1] for pairs in (before, self._near))
        _, here, there = np.intersect1d(new, old, assume_unique=True, return_indices=True)
        rest = np.where(gaps > self._cutoff + self._skin, gaps - self._cutoff, -1.0)
        rest[here] = (self._until - self._travel)[there]
        self._until, self._travel = rest, np.zeros(len(new))
        renumbered = np.full(len(old), -1)
        renumbered[there] = here
        owner = renumbered[self._owner]
        self.pairs, self.edges = self.pairs[owner >= 0], self.edges[owner >= 0]
        self._owner = owner[owner >= 0]

    def _renew(self) -> None:
        """List what has to be, and measure all pairs, in the shape reached last."""
        self._travel += self._bounds(self.knots - self._measured_at)
        left = self._met - 2.0 * largest_deviation(self.knots, self._met_at)
        if left < _MET_LEFT * self._met:
            self._meet()
        self._list(self._until - self._travel < _SKIN_LEFT * self._skin, self._skin)
        self._measure()

    def _list_for(self, motion: np.ndarray) -> None:
        """List what a motion may bring near that is longer than the skins."""
        bounds = self._bounds(motion)
        stale = self._travel + bounds >= self._until
        if stale.any():
            self._list(stale, max(self._skin, 1.001 * float(bounds[stale].max())))
            self._measure()

    def _bounds(self, motion: np.ndarray) -> np.ndarray:
        """Of how much nearer the blocks of every pair come."""
        blocks = self._blocks
        count = len(blocks.knot_starts) - 1
        means, most, bounds = np.empty((count, 3)), np.empty(count), np.empty(len(self._near))
        spread(motion, blocks.knots, blocks.knot_starts, means, most)
        closing_bounds(means, most, self._near, bounds)
        return bounds

    def _list(self, stale: np.ndarray, skin: float) -> None:
        """List the pairs of some blocks anew, in the shape reached last.

        Parameters
        ----------
        stale : ndarray of bool, shape (block pairs,)
        skin : float
            m.
        """
        which = np.flatnonzero(stale)
        gaps = self._blocks.gaps(self.knots, self._near[which])
        far = gaps > self._cutoff + skin
        self._until[which] = self._travel[which] + np.where(far, gaps - self._cutoff, skin)
        kept, which = ~stale[self._owner], which[~far]
        distance, near = self._cutoff + skin, self._near[which]
        self._balls.renew(self.knots, self._blocks.elements_of(near))
        elements = self._blocks.near_elements(near, self._balls.elements, distance)
        pairs, edges, source = candidates(
            self._surface, self.knots, distance, self._balls, elements[:, :2]
        )
        self.pairs = np.concatenate([self.pairs[kept], pairs])
        self.edges = np.concatenate([self.edges[kept], edges])
        self._owner = np.concatenate([self._owner[kept], which[elements[source, 2]]])

    def _measure(self) -> None:
        """Sort all pairs by what is left of their gap beyond the reach."""
        slack = distances(self.knots, self.pairs, self.edges) - self._cutoff
        order = np.argsort(slack, kind="stable")
        self._slack = slack[order]
        self.pairs, self.edges = self.pairs[order], self.edges[order]
        self._owner, self._measured_at, self._active = self._owner[order], self.knots, None
        self._rest = min(
            self._met - 2.0 * largest_deviation(self.knots, self._met_at),
            float(np.min(self._until - self._travel)),
        )
