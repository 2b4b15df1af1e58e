"""Which pairs are within the reach, followed from shape to shape, and what they exert."""

from __future__ import annotations

import numpy as np
from numba import njit

from foilstudy.model.contact.barrier import barrier, pair_energy, pair_hessian
from foilstudy.model.contact.candidates import candidates
from foilstudy.model.contact.distance import closest
from foilstudy.model.contact.passing import passable_share
from foilstudy.model.contact.surface import Triangulation, largest_deviation


class FollowedPairs:
    """Pairs that are near in the shape that was reached last, and how far all knots have moved.

    A pair is looked at again only when the knots may have used up its gap beyond the reach.

    Parameters
    ----------
    surface : Triangulation
    knots : ndarray, shape (count, 3)
        The first shape, m.
    thickness, reach, skin : float
        m.
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
        self._travel, self._reach_of_list = 0.0, -1.0
        self._listed_at, self._active = knots, None
        self._list(self._skin)

    def _list(self, skin: float) -> None:
        """List all pairs that the skin lets in, in the shape reached last."""
        self.pairs, self.touching = candidates(self._surface, self.knots, self._cutoff + skin)
        self._due = np.full(len(self.pairs), -1.0)
        self._reach_of_list, self._listed_at, self._active = 0.5 * skin, self.knots, None

    def shift(self, knots: np.ndarray) -> float:
        """Largest motion of a knot from the shape reached last, beside the mean of all, m."""
        return largest_deviation(knots, self.knots)

    def share(self, motion: np.ndarray, shift: float, closing: float) -> float:
        """Part of a motion from the shape reached last in which no gap closes by a larger share.

        Parameters
        ----------
        motion : ndarray, shape (count, 3)
            m.
        shift : float
            Its size, see `shift`.
        closing : float
        """
        if largest_deviation(self.knots + motion, self._listed_at) > self._reach_of_list:
            self._list(max(self._skin, 2.0 * shift))
        return passable_share(
            self.knots, motion, self.pairs, self.touching, self._due, self._travel + shift,
            self._thickness, closing,
        )  # fmt: skip

    def move(self, knots: np.ndarray, shift: float) -> None:
        """Take note of the shape reached by a motion of which `share` has been asked."""
        self._travel += shift
        self.knots, self._active = knots, None

    def least_distance(self) -> float:
        """Smallest distance of a pair, m; infinite where none is within the reach."""
        active = self.active()
        if not len(active):
            return np.inf
        return least_distance(self.knots, self.pairs[active], active >= self.touching)

    def active(self) -> np.ndarray:
        """Pairs within the reach, in an order that follows from the shape alone."""
        if self._active is None:
            found = _within(
                self.knots, self.pairs, self.touching, self._due, self._travel, self._cutoff
            )
            if len(found) > 1:
                kind = found >= self.touching
                found = found[np.lexsort((*self.pairs[found].T[::-1], kind))]
            self._active = found
        return self._active


@njit(cache=True, error_model="numpy")
def _within(knots, pairs, touching, due, travel, cutoff):
    x, a = np.empty((4, 3)), np.empty(4)
    change, w = np.empty((2, 4)), np.empty(3)
    found = np.empty(len(pairs), dtype=np.int64)
    number = 0
    for p in range(len(pairs)):
        if travel < due[p]:
            continue
        for i in range(4):
            for c in range(3):
                x[i, c] = knots[pairs[p, i], c]
        square, _ = closest(x, p >= touching, a, change, w)
        if square < cutoff * cutoff:
            found[number] = p
            number += 1
        else:
            due[p] = travel + 0.5 * (np.sqrt(square) - cutoff)
    return found[:number].copy()


@njit(cache=True, error_model="numpy")
def least_distance(knots, pairs, edges):
    """Smallest distance of some pairs, m."""
    x, a = np.empty((4, 3)), np.empty(4)
    change, w = np.empty((2, 4)), np.empty(3)
    least = np.inf
    for p in range(len(pairs)):
        for i in range(4):
            for c in range(3):
                x[i, c] = knots[pairs[p, i], c]
        square, _ = closest(x, edges[p], a, change, w)
        least = min(least, square)
    return np.sqrt(least)


@njit(cache=True, error_model="numpy")
def exert(knots, pairs, edges, full, thickness, span, size, forces):
    """Add what pairs exert to the forces on the knots, N; return their energy, J.

    Parameters
    ----------
    knots : ndarray, shape (count, 3)
    pairs : ndarray of int, shape (active, 4)
    edges : ndarray of bool, shape (active,)
    full : ndarray, shape (active,)
        See `barrier.pair_energy`.
    thickness, span, size : float
        t, m; s, m2; E0, J.
    forces : ndarray, shape (count, 3)
    """
    x, gradient = np.empty((4, 3)), np.empty((4, 3))
    a, change, w = np.empty(4), np.empty((2, 4)), np.empty(3)
    total = 0.0
    for p in range(len(pairs)):
        for i in range(4):
            for c in range(3):
                x[i, c] = knots[pairs[p, i], c]
        total += size * pair_energy(x, edges[p], full[p], thickness, span, a, change, w, gradient)
        for i in range(4):
            for c in range(3):
                forces[pairs[p, i], c] += size * gradient[i, c]
    return total


@njit(cache=True, error_model="numpy")
def hessians(knots, pairs, edges, full, thickness, span, size):
    """Second derivatives of the energies of pairs, shape (active, 12, 12), N/m."""
    x, a = np.empty((4, 3)), np.empty(4)
    change, w = np.empty((2, 4)), np.empty(3)
    out = np.empty((len(pairs), 12, 12))
    for p in range(len(pairs)):
        for i in range(4):
            for c in range(3):
                x[i, c] = knots[pairs[p, i], c]
        pair_hessian(x, edges[p], full[p], thickness, span, a, change, w, out[p])
        out[p] *= size
    return out


@njit(cache=True, error_model="numpy")
def springs(knots, pairs, edges, thickness, span, size):
    """Pairs as springs between their closest points.

    Returns
    -------
    stiffness : ndarray, shape (active,)
        Second derivative of the energy by the distance, N/m; the factor of edges is left at 1.
    weights : ndarray, shape (active, 4)
    direction : ndarray, shape (active, 3)
        From one side to the other.
    """
    x, a = np.empty((4, 3)), np.empty(4)
    change, w = np.empty((2, 4)), np.empty(3)
    stiffness, weights = np.empty(len(pairs)), np.empty((len(pairs), 4))
    direction = np.empty((len(pairs), 3))
    for p in range(len(pairs)):
        for i in range(4):
            for c in range(3):
                x[i, c] = knots[pairs[p, i], c]
        square, _ = closest(x, edges[p], a, change, w)
        _, slope, bend = barrier((square - thickness * thickness) / span)
        stiffness[p] = size * (4.0 * square * bend / (span * span) + 2.0 * slope / span)
        weights[p] = a
        direction[p] = w / np.sqrt(square)
    return stiffness, weights, direction


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
