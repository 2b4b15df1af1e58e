"""What presses on what, with how much force: closed contacts as those see them that slide."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from foilstudy.model.contact.sliding import POINTS
from foilstudy.model.contact.surface import Triangulation, triangulation
from foilstudy.model.patch import Patch

__all__ = ["Pressing", "of_points", "with_edges"]


@dataclass(frozen=True, eq=False)
class Pressing:
    """Closed contacts, in an order that follows from the shape alone.

    Attributes
    ----------
    stencils : ndarray of int, shape (n, POINTS)
        Knots; the first four are those of the contact.
    sides : ndarray of int, shape (n, POINTS)
        To whose patch they belong, see `sliding.centred`.
    weights : ndarray, shape (n, POINTS)
        Of the closest vector.
    direction : ndarray, shape (n, 3)
        Of the same, a unit vector.
    force : ndarray, shape (n,)
        With which the sides are pressed on each other, N.
    """

    stencils: np.ndarray
    sides: np.ndarray
    weights: np.ndarray
    direction: np.ndarray
    force: np.ndarray

    def __len__(self) -> int:
        return len(self.stencils)


def of_points(
    knots: np.ndarray, weights: np.ndarray, direction: np.ndarray, force: np.ndarray
) -> Pressing:
    """Points on triangles, knots (n, 4): the triangle alone is a patch."""
    stencils = np.repeat(knots[:, :1], POINTS, axis=1)
    stencils[:, :4] = knots
    sides = np.full(stencils.shape, -1)
    sides[:, 1:4] = 1
    return Pressing(stencils, sides, _wide(weights), direction, force)


def with_edges(
    surface: Triangulation,
    knots: np.ndarray,
    edges: np.ndarray,
    weights: np.ndarray,
    direction: np.ndarray,
    force: np.ndarray,
) -> Pressing:
    """Pairs of a surface, knots (n, 4), of which some are two edges."""
    of = of_points(knots, weights, direction, force)
    pairs = knots[edges]
    across = np.concatenate([_across(surface, pairs[:, :2]), _across(surface, pairs[:, 2:])], 1)
    has = across >= 0
    of.stencils[edges, 4:] = np.where(has, across, pairs[:, :1])
    of.sides[edges, :4] = [0, 0, 1, 1]
    of.sides[edges, 4:] = np.where(has, [0, 0, 1, 1], -1)
    return of


def _wide(weights: np.ndarray) -> np.ndarray:
    wide = np.zeros((len(weights), POINTS))
    wide[:, :4] = weights
    return wide


def _across(surface: Triangulation, edges: np.ndarray) -> np.ndarray:
    """The knots that the triangles of edges, shape (n, 2), have besides; -1 where there is none."""
    names, opposite = _edges_of(surface.patch)
    low, high = np.sort(edges, axis=1).T
    return opposite[np.searchsorted(names, low * surface.count + high)]


@lru_cache(maxsize=4)
def _edges_of(patch: Patch) -> tuple[np.ndarray, np.ndarray]:
    """All edges of a surface by number, sorted, and the knots across them, shape (edges, 2)."""
    surface = triangulation(patch)
    corners = surface.triangles
    ends = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    across = np.concatenate([corners[:, 2], corners[:, 0], corners[:, 1]])
    low, high = np.sort(ends, axis=1).T
    names, where = np.unique(low * surface.count + high, return_inverse=True)
    opposite = np.full((len(names), 2), -1)
    order = np.argsort(where, kind="stable")
    first = np.diff(where[order], prepend=-1) > 0
    opposite[where[order[first]], 0] = across[order[first]]
    opposite[where[order[~first]], 1] = across[order[~first]]
    return names, opposite
