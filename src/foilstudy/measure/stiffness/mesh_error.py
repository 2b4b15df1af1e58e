"""Stiffness of one shape at element size zero, and how far off that may be."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from foilstudy.model.mesh_size import stiffness_error_at

_QUARTER = 4.0
"""By how much halving the elements lowers an error of second order."""
_SAFETY = 2.0
"""Stated error over estimated one."""


def mesh_limit(
    levels: Sequence[np.ndarray], staggered: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Limit and estimated error from the same shape on meshes halved each time.

    With three levels whose steps shrink, the last two are extrapolated at second order. Otherwise
    the finest value stands. The error is twice the larger of two independent estimates: the
    extrapolation itself, a third of the last step, and the distance to another discretisation
    (staggered strain samples), which shrinks at second order, too. Twice, because one level more
    moved 50 um foil by 1.4 and 1.7 times the estimate (docs/method.md, section 6).

    Parameters
    ----------
    levels : sequence of ndarray, shape (directions,)
        Two or more, from coarse to fine, N/m.
    staggered : ndarray, shape (directions,)
        With the other discretisation on the second level, N/m.

    Returns
    -------
    limit, error : ndarray, shape (directions,)
        N/m.

    Raises
    ------
    ValueError
        If there are fewer than two levels.
    """
    if len(levels) < 2:
        raise ValueError(f"a mesh error needs the stiffness on two meshes, not {len(levels)}")
    step = levels[-1] - levels[-2]
    correction = step / (_QUARTER - 1)
    gap = np.abs(staggered - levels[1]) / _QUARTER ** (len(levels) - 2)
    return _extrapolated(levels), _SAFETY * np.maximum(np.abs(correction), gap)


def limit_by_need(
    levels: Sequence[np.ndarray], staggered: np.ndarray | None, slenderness: float
) -> tuple[np.ndarray, float]:
    """The limit of `mesh_limit`, and an error of both directions that tells when to stop refining.

    The largest of three signs. Elements of size h on folded foil of radius R and thickness t miss
    up to 38 % h^2 / (R t), whatever the shape, and meshes that are all too coarse do not show it by
    their steps; on the mesh of the crumple it is up to 60 %, and nothing else tells. Where there
    are three meshes, what is left after the last step: a third of it, all of it where steps do not
    shrink. The distance to the staggered element on the second mesh, which
    shrinks at second order. The latter two count by the direction where they are larger, as either
    vanishes by chance in one. Measured in docs/method.md, section 6.

    Parameters
    ----------
    levels, staggered
        As in `mesh_limit`; of a single level without the other discretisation.
    slenderness : float
        Element size of the coarsest mesh over sqrt(R t).

    Returns
    -------
    limit : ndarray, shape (directions,)
        N/m.
    error : float
        A share of either value.
    """
    halvings = len(levels) - 1
    folded = stiffness_error_at(slenderness, halvings)
    if not halvings:
        return levels[0].copy(), folded
    gap = np.abs(staggered / levels[1] - 1) / _QUARTER ** (halvings - 1)
    signs = [folded, gap.max()]
    if halvings > 1:
        step = np.abs(levels[-1] - levels[-2]) / np.abs(levels[-1])
        left = np.where(_shrinking(levels), step / (_QUARTER - 1), step)
        signs.append(left.max())
    return _extrapolated(levels), float(max(signs))


def _extrapolated(levels: Sequence[np.ndarray]) -> np.ndarray:
    """The last value, or where three have steps that shrink its limit at second order."""
    step = levels[-1] - levels[-2]
    return np.where(_shrinking(levels), levels[-1] + step / (_QUARTER - 1), levels[-1])


def _shrinking(levels: Sequence[np.ndarray]) -> np.ndarray:
    """Whether the last step of three or more levels is less than half of the one before."""
    if len(levels) < 3:
        return np.zeros(levels[-1].shape, dtype=bool)
    steps = np.abs(np.diff(levels[-3:], axis=0))
    return steps[1] < 0.5 * steps[0]
