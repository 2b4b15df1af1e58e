"""Dynamic stiffness between the rings: damping, response, full-order truth; `reductions` apart."""

from foilstudy.measure.dynamics.accuracy import Wanted, eigenfrequency_errors, residual_estimate
from foilstudy.measure.dynamics.completion import completed_modes
from foilstudy.measure.dynamics.damping import (
    Damping,
    ModalDamping,
    RayleighDamping,
    StructuralDamping,
)
from foilstudy.measure.dynamics.options import DynamicsOptions
from foilstudy.measure.dynamics.receptance import (
    CONDITIONS,
    EvenGrid,
    accelerance,
    receptance,
    resonances,
)
from foilstudy.measure.dynamics.reduction import ReducedModel, Reduction
from foilstudy.measure.dynamics.response import (
    DEFINITIONS,
    directional_stiffness,
    dynamic_stiffness,
    frequency_grid,
    interface_dynamic_stiffness,
    interface_receptance,
    relative_error,
)
from foilstudy.measure.dynamics.structure import Structure
from foilstudy.measure.dynamics.truth import full_order

__all__ = [
    "CONDITIONS",
    "DEFINITIONS",
    "Damping",
    "DynamicsOptions",
    "EvenGrid",
    "ModalDamping",
    "RayleighDamping",
    "ReducedModel",
    "Reduction",
    "Structure",
    "StructuralDamping",
    "Wanted",
    "accelerance",
    "completed_modes",
    "directional_stiffness",
    "eigenfrequency_errors",
    "dynamic_stiffness",
    "frequency_grid",
    "full_order",
    "interface_dynamic_stiffness",
    "interface_receptance",
    "receptance",
    "relative_error",
    "residual_estimate",
    "resonances",
]
