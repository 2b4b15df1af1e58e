"""Stiffness of one shape at element size zero, and how far off that may be."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

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
    limit = levels[-1].copy()
    if len(levels) > 2:
        shrinks = np.abs(step) < 0.5 * np.abs(levels[-2] - levels[-3])
        limit = np.where(shrinks, limit + correction, limit)
    return limit, _SAFETY * np.maximum(np.abs(correction), gap)
