"""What is chosen about contact."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_number
from foilstudy.model.patch import Patch

_FOLLOWED, _NEAR_MOST, _REACH_MOST = 0.6, 0.55, 0.4
"""Relative to the smaller side of an element: distance within which pairs are followed, largest sum
of thickness and reach, and largest reach. From 0.7 on points of a smooth surface are pairs with
their own neighbours' triangles, which multiplies the pairs by twenty."""


@dataclass(frozen=True)
class Contact:
    """A barrier between parts of a sheet that come nearer than thickness and reach.

    Attributes
    ----------
    reach : float
        Gap between the faces of two sheets at which the barrier begins, m.
    stiffness : float
        Energy of the barrier relative to membrane stiffness E t/(1 - nu^2) times reach squared. A
        softer one is entered more deeply, where it is stiffer.
    """

    reach: float = 1e-3
    stiffness: float = 3e-3

    def __post_init__(self):
        require_number("reach of a contact", self.reach, "m", above=0)
        require_number("stiffness of a contact", self.stiffness, "", above=0)

    def skin_on(self, patch: Patch, thickness: float) -> float:
        """Gap beyond the reach within which pairs are followed, m, to be sought less often.

        Raises
        ------
        Refusal
            If thickness and reach are too large for the elements.
        """
        side = min(patch.size_around, patch.size_along)
        most = min(_REACH_MOST * side, _NEAR_MOST * side - thickness)
        if self.reach > most:
            cure = "take a coarser mesh"
            if most > 0:
                cure = f"reduce the reach to {1e3 * most:.2g} mm or {cure}"
            raise Refusal(
                f"contact of a foil of {1e6 * thickness:g} µm with a reach of "
                f"{1e3 * self.reach:g} mm needs larger elements than {1e3 * side:.3g} mm; {cure}."
            )
        return _FOLLOWED * side - thickness - self.reach
