"""The published foil and its crumples, of which the side studies are made; cheap to import."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.model.foil import Foil
from foilstudy.model.materials import material

FEP = material("FEP")
RADIUS, HEIGHT, GAP_HEIGHT = 0.1, 0.17, 0.13
"""Of the cylinder that is crumpled and of the gap, m."""
HEIGHT_MM = 170
THICKNESSES_UM = (500, 50)
"""On which most comparisons are made."""


def foil(thickness_um: float, height_mm: float = HEIGHT_MM) -> Foil:
    """A foil of the published study."""
    return Foil(2 * RADIUS, height_mm * 1e-3, GAP_HEIGHT, thickness_um * 1e-6, FEP)


@dataclass(frozen=True)
class CrumpleCase:
    """One crumple of the published foil.

    Attributes
    ----------
    element : str
        Key of `foilstudy.model.shell.elements.ELEMENTS`.
    thickness_um, height_mm : int
        Of the foil and of the uncrumpled cylinder.
    size_mm : float
        Element size asked for.
    seed : int
        Of the imperfection.
    """

    element: str
    thickness_um: int
    height_mm: int
    size_mm: float
    seed: int
