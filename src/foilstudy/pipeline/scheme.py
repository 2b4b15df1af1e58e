"""The fictitious dynamics with which studies crumple and relax."""

from __future__ import annotations

from foilstudy.model.shell.shell import Shell
from foilstudy.solve.relaxation import Scheme
from foilstudy.solve.relaxation.damping import AdaptiveViscousDamping
from foilstudy.solve.relaxation.spectral_mass import SpectralMass

RAMP_DAMPING, RELAXATION_DAMPING = 0.5, 0.06
"""Share of the critical damping of the current motion, while the ring moves and after. The Rayleigh
quotient overestimates the slowest mode, so that less damping settles sooner (docs/method.md)."""


def crumpling_scheme(sheet: Shell) -> Scheme:
    """Spectral mass scaling with adaptive viscous damping."""
    return Scheme(
        mass=SpectralMass(sheet),
        ramp_damping=AdaptiveViscousDamping(RAMP_DAMPING),
        relaxation_damping=AdaptiveViscousDamping(RELAXATION_DAMPING),
    )
