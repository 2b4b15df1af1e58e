"""An element that fails: one strain point and nothing that holds the checkerboard.

Control points that move in plane by turns strain the middle of no element, so that a foil crumples
into hourglasses; kept to show what the control of the others prevents.
"""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.model.shell.elements.one_point import OnePoint


@dataclass(frozen=True)
class Uncontrolled(OnePoint):
    """The one-point element with a factor of zero on what controls it."""

    stabilisation: float = 0.0
    name: str = "uncontrolled"
