"""Bounds of a contact: how far a barrier reaches on a mesh, and whether the mesh can carry it."""

from __future__ import annotations

from foilstudy.base.errors import Refusal
from foilstudy.model.patch import Patch

__all__ = ["FRICTION_MAX", "REACH_MOST", "reach_on", "skin_on"]

REACH_MOST = 1e-3
"""Of a reach that is left out, m."""
FRICTION_MAX = 2.0
"""Coefficient beyond which sheets interlock or are glued, and do not slide."""
_REACH_SHARE = 0.25
"""The same relative to the smaller side of an element."""
_FOLLOWED, _NEAR_MOST, _REACH_MOST = 0.6, 0.55, 0.4
"""Relative to the smaller side of an element: distance within which pairs are followed, largest sum
of thickness and reach, and largest reach. From 0.7 on points of a smooth surface are pairs with
their own neighbours' triangles, which multiplies the pairs by twenty."""


def reach_on(patch: Patch, thickness: float, wanted: float | None = None) -> float:
    """Gap between the faces of two sheets at which the barrier begins, m.

    Parameters
    ----------
    patch : Patch
    thickness : float
        m.
    wanted : float, optional
        m; left out, `REACH_MOST` and a quarter of an element at most.

    Raises
    ------
    Refusal
        If thickness and reach are too large for the elements.
    """
    side = min(patch.size_around, patch.size_along)
    reach = min(REACH_MOST, _REACH_SHARE * side) if wanted is None else wanted
    most = min(_REACH_MOST * side, _NEAR_MOST * side - thickness)
    if reach > most:
        cure = "take a coarser mesh"
        if most > 0:
            cure = f"reduce the reach to {1e3 * most:.2g} mm or {cure}"
        raise Refusal(
            f"contact of a foil of {1e6 * thickness:g} µm with a reach of {1e3 * reach:.3g} mm "
            f"needs larger elements than {1e3 * side:.3g} mm; {cure}."
        )
    return reach


def skin_on(patch: Patch, thickness: float, reach: float) -> float:
    """Gap beyond the reach within which pairs are followed, m, to be sought less often."""
    return _FOLLOWED * min(patch.size_around, patch.size_along) - thickness - reach
