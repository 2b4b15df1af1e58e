"""Dynamic relaxation of a sheet: explicit steps with scaled mass and viscous damping."""

from foilstudy.solve.relaxation.loop import (
    History,
    Ramp,
    RelaxationResult,
    Scheme,
    StoppingRule,
    relax,
)

__all__ = ["History", "Ramp", "RelaxationResult", "Scheme", "StoppingRule", "relax"]
