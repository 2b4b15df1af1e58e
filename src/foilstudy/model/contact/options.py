"""What is chosen about contact."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_number
from foilstudy.model.patch import Patch

_NEAR_MOST, _REACH_MOST = 0.7, 0.4
"""Thickness, reach and skin, and the reach alone, relative to the smaller side of an element:
beyond, points of a smooth surface count as each other's neighbours in contact."""


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
    skin : float
        Gap beyond the reach at which pairs are followed, m, so that they need not be sought at
        every step; less where the mesh wants it.
    """

    reach: float = 1e-3
    stiffness: float = 3e-3
    skin: float = 2e-3

    def __post_init__(self):
        require_number("reach of a contact", self.reach, "m", above=0)
        require_number("stiffness of a contact", self.stiffness, "", above=0)
        require_number("skin of a contact", self.skin, "m", above=0)

    def skin_on(self, patch: Patch, thickness: float) -> float:
        """The skin that a mesh allows, m.

        Raises
        ------
        Refusal
            If thickness and reach are too large for the elements.
        """
        side = min(patch.size_around, patch.size_along)
        most = _NEAR_MOST * side - thickness - self.reach
        if self.reach > _REACH_MOST * side or most <= 0:
            raise Refusal(
                f"contact of a foil of {1e6 * thickness:g} µm with a reach of "
                f"{1e3 * self.reach:g} mm needs larger elements than {1e3 * side:.3g} mm; reduce "
                f"the reach below {1e3 * min(_REACH_MOST * side, self.reach + most):.2g} mm or "
                "take a coarser mesh."
            )
        return min(self.skin, most)
