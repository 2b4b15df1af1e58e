"""Dynamic relaxation of a sheet: explicit steps with scaled mass and viscous damping."""

from foilstudy.solve.relaxation.loop import History, Ramp, RelaxationResult, StoppingRule, relax
from foilstudy.solve.relaxation.scheme import Motion, Scheme

__all__ = ["History", "Motion", "Ramp", "RelaxationResult", "Scheme", "StoppingRule", "relax"]
