"""Dynamic stiffness between the rings: reductions, damping, response."""

from foilstudy.dynamics.hintz_herting import HintzHerting
from foilstudy.dynamics.reduction import ReducedModel, Reduction, Structure
from foilstudy.dynamics.response import DEFINITIONS, dynamic_stiffness, frequency_grid

__all__ = [
    "DEFINITIONS",
    "HintzHerting",
    "ReducedModel",
    "Reduction",
    "Structure",
    "dynamic_stiffness",
    "frequency_grid",
]
