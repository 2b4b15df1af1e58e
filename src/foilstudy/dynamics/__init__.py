"""Dynamic stiffness between the rings: reductions, damping, response, full-order truth."""

from foilstudy.dynamics.accuracy import Wanted, eigenfrequency_errors, residual_estimate
from foilstudy.dynamics.damping import (
    Damping,
    ModalDamping,
    RayleighDamping,
    StructuralDamping,
)
from foilstudy.dynamics.reduction import ReducedModel, Reduction
from foilstudy.dynamics.reductions import CraigBampton, Guyan, HintzHerting, RationalKrylov
from foilstudy.dynamics.response import (
    DEFINITIONS,
    directional_stiffness,
    dynamic_stiffness,
    frequency_grid,
    interface_dynamic_stiffness,
    relative_error,
)
from foilstudy.dynamics.structure import Structure
from foilstudy.dynamics.truth import full_order

__all__ = [
    "CraigBampton",
    "DEFINITIONS",
    "Damping",
    "Guyan",
    "HintzHerting",
    "ModalDamping",
    "RationalKrylov",
    "RayleighDamping",
    "ReducedModel",
    "Reduction",
    "Structure",
    "StructuralDamping",
    "Wanted",
    "directional_stiffness",
    "eigenfrequency_errors",
    "dynamic_stiffness",
    "frequency_grid",
    "full_order",
    "interface_dynamic_stiffness",
    "relative_error",
    "residual_estimate",
]
