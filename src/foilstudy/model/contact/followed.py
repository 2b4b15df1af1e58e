"""Which pairs are within the reach, followed from shape to shape.

What belongs to elements that share a knot is judged in windows of two by two of them (`windows`),
all of which are looked at once in a while. Other elements are followed in blocks. How much nearer
two blocks may have come is bounded by the motion of their means against each other and by what
their knots deviate from these; when that has used up most of their distance it is measured anew, of
these two alone. Only where a window or two blocks may be near, pairs of points and triangles and of
edges are sought, with a skin beyond the reach. In the shapes that follow, lists are complete until
knots have moved by what the least of these distances leaves, and only the pairs are looked at whose
gap beyond the reach the motion may have used up.
"""

from __future__ import annotations

import numpy as np

from foilstudy.model.contact.blocks import Distances, blocks_of, kept_pairs
from foilstudy.model.contact.candidates import Balls, candidates
from foilstudy.model.contact.pairs import distances
from foilstudy.model.contact.passing import passable_share
from foilstudy.model.contact.surface import Triangulation, largest_deviation
from foilstudy.model.contact.windows import Windows

_MET = 1.5
"""Gap within which blocks are followed, relative to the larger side of an element."""
_MET_LEFT = 0.3
"""Share of that gap from which on blocks are met anew."""
_WINDOW, _BLOCKS, _KNOWN = 0.7, 1.2, 0.6
"""Share of a skin that has to be left of a window, and of two blocks, lest they are seen to anew;
and which distance of two blocks is enough for their pairs not to be listed."""
_DUE = 0.4
"""Share of a skin from which on blocks are looked at."""


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
        self._windows = Windows(surface)
        self._distances = Distances(self._blocks, self._cutoff + self._met)
        self._active: np.ndarray | None = None
        self._measured_at = self._blocks_at = knots
        # by which two blocks may have come nearer, and until when they are known or listed
        self._near = np.empty((0, 2), dtype=np.int64)
        self._travel = self._until = np.empty(0)
        # windows that are listed, and what is left of their skins
        self._listed, self._window_left = np.empty(0, dtype=np.int64), np.empty(self._windows.count)
        self.pairs, self.edges = np.empty((0, 4), dtype=np.int64), np.empty(0, dtype=bool)
        # of pairs: a window, or the number of all knots and that of two blocks
        self._owner = np.empty(0, dtype=np.int64)
        self._meet()
        self._see_to_blocks(self._until < 0.0, self._skin)
        self._see_to_windows(_WINDOW * skin, skin)
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
            self.renew()
            used = 2.0 * largest_deviation(there, self._measured_at)
            if used >= self._rest:
                self._list_for(there)
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
                self.renew()
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

    def renew(self) -> None:
        """Measure all pairs in the shape reached last, and list what has to be."""
        used = 2.0 * largest_deviation(self.knots, self._blocks_at)
        if min(self._blocks_rest, self._met_rest) - used < _DUE * self._skin:
            self._travel += self._blocks.closings(self.knots, self._blocks_at, self._near)
            self._blocks_at = self.knots
            left = self._met - 2.0 * largest_deviation(self.knots, self._met_at)
            if left < _MET_LEFT * self._met:
                self._meet()
            self._see_to_blocks(self._until - self._travel < _BLOCKS * self._skin, self._skin)
        if len(self._listed):
            motion = self.knots - self._measured_at
            self._window_left[self._listed] -= self._windows.motions(motion, self._listed)
        self._see_to_windows(_WINDOW * self._skin, self._skin)
        self._measure()

    def _meet(self) -> None:
        """Find the blocks that are near in the shape reached last; what is known of them is kept.

        Of others nothing is within their gap, which holds until they are met again.
        """
        before, left, self._met_at = self._near, self._until - self._travel, self.knots
        self._near = self._blocks.near(self.knots, self._cutoff + self._met)
        starts = np.searchsorted(before[:, 0], np.arange(len(self._blocks) + 1))
        where = np.empty(len(self._near), dtype=np.int64)
        kept_pairs(self._near, before, starts, where)
        met = np.flatnonzero(where >= 0)
        self._until, self._travel = np.full(len(where), -1.0), np.zeros(len(where))
        self._until[met] = left[where[met]]
        of_blocks = self._owner >= self._surface.count
        if of_blocks.any():
            renumbered = np.full(len(before), -1)
            renumbered[where[met]] = met + self._surface.count
            owner = self._owner
            owner[of_blocks] = renumbered[owner[of_blocks] - self._surface.count]
            self._keep(owner >= 0)

    def _keep(self, kept: np.ndarray) -> None:
        self.pairs, self.edges, self._owner = self.pairs[kept], self.edges[kept], self._owner[kept]

    def _list_for(self, there: np.ndarray) -> None:
        """List what a motion may bring near that is longer than the skins."""
        self._travel += self._blocks.closings(self.knots, self._blocks_at, self._near)
        self._blocks_at = self.knots
        bounds = self._blocks.closings(there, self.knots, self._near)
        stale = self._travel + bounds >= self._until
        if stale.any():
            self._see_to_blocks(stale, max(self._skin, 1.001 * float(bounds[stale].max())))
        bounds = self._windows.motions(there - self.knots, np.arange(self._windows.count))
        skin = max(self._skin, 1.001 * float(bounds.max()))
        self._see_to_windows(1.001 * bounds, skin)
        self._measure()

    def _see_to_blocks(self, stale: np.ndarray, skin: float) -> None:
        """Know anew how far some blocks are apart in the shape reached last, or list their pairs.

        Parameters
        ----------
        stale : ndarray of bool, shape (block pairs,)
        skin : float
            m.
        """
        which = np.flatnonzero(stale)
        if len(which):
            enough = self._cutoff + (_KNOWN * skin if skin == self._skin else skin)
            known = self._distances.known(self.knots, self._near, which, enough)
            far = known >= enough
            self._until[which] = self._travel[which] + np.where(far, known - self._cutoff, skin)
            first = self._surface.count
            of_blocks = np.flatnonzero(self._owner >= first)
            if len(of_blocks):
                kept = np.ones(len(self._owner), dtype=bool)
                kept[of_blocks] = ~stale[self._owner[of_blocks] - first]
                self._keep(kept)
            if not far.all():
                which = which[~far]
                near = self._near[which]
                self._balls.renew(self.knots, self._blocks.elements_of(near))
                found = self._blocks.near_elements(
                    self.knots, near, self._balls.elements, self._cutoff + skin
                )
                self._list(found[:, :2], first + which[found[:, 2]], skin)
        self._blocks_rest = float(np.min(self._until - self._travel))
        self._met_rest = self._met - 2.0 * largest_deviation(self.knots, self._met_at)

    def _see_to_windows(self, needed: float | np.ndarray, skin: float) -> None:
        """Look at all windows in the shape reached last, and list the pairs of some.

        Parameters
        ----------
        needed : float or ndarray, shape (windows,)
            By how much what belongs to a window may come nearer from here on, m.
        skin : float
            m.
        """
        near, least = self._windows.near(self.knots, self._cutoff + needed)
        self._windows_rest = least - self._cutoff
        listed = self._listed
        if len(listed):
            wanted = needed if np.isscalar(needed) else needed[listed]
            kept = near[listed] & (self._window_left[listed] >= wanted)
            if not kept.all():
                gone = np.zeros(self._surface.count + 1, dtype=bool)
                gone[listed[~kept]] = True
                self._keep(~gone[np.minimum(self._owner, self._surface.count)])
                self._listed = listed = listed[kept]
            near[listed] = False
        new = np.flatnonzero(near)
        if len(new):
            elements, place = self._windows.element_pairs(new)
            self._balls.renew(self.knots, np.unique(elements))
            self._list(elements, new[place], skin)
            self._listed = listed = np.concatenate([listed, new])
            self._window_left[new] = skin
        if len(listed):
            self._windows_rest = min(self._windows_rest, self._window_left[listed].min())

    def _list(self, elements: np.ndarray, owner: np.ndarray, skin: float) -> None:
        """List the pairs of some elements, two each, in the shape reached last."""
        pairs, edges, source = candidates(
            self._surface, self.knots, self._cutoff + skin, self._balls, elements
        )
        self.pairs = np.concatenate([self.pairs, pairs])
        self.edges = np.concatenate([self.edges, edges])
        self._owner = np.concatenate([self._owner, owner[source]])

    def _measure(self) -> None:
        """Sort all pairs by what is left of their gap beyond the reach."""
        self._measured_at, self._active = self.knots, None
        used = 2.0 * largest_deviation(self.knots, self._blocks_at)
        self._rest = min(self._windows_rest, self._blocks_rest - used, self._met_rest - used)
        slack = distances(self.knots, self.pairs, self.edges) - self._cutoff
        order = np.argsort(slack, kind="stable")
        self._slack = slack[order]
        self.pairs, self.edges = self.pairs[order], self.edges[order]
        self._owner = self._owner[order]
