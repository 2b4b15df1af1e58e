"""The mounts of a study, from its configuration."""

from __future__ import annotations

from foilstudy.config import Isolation
from foilstudy.measure.isolation.mounts import IdealMount, Mount, ResonantMount, Spring

MOUNTS = ("ideal", "resonant")
"""Without mass, and with an internal resonance; both carry the payload at the same frequency."""


def static_spring(options: Isolation, direction: str) -> Spring:
    """Spring on which the payload has its suspension frequency in a direction.

    Parameters
    ----------
    direction : str
        ``axial`` or ``radial``.
    """
    frequency = {"axial": options.suspension_axial_hz, "radial": options.suspension_radial_hz}
    # A loss factor of 2 zeta dissipates at resonance what the share zeta of critical does.
    return Spring.suspending(
        options.payload_mass_kg, frequency[direction], loss_factor=options.damping_percent / 50
    )


def mounts(options: Isolation, direction: str) -> dict[str, Mount]:
    """Both mounts of a study in a direction, by the names in `MOUNTS`."""
    spring = static_spring(options, direction)
    mass = options.payload_mass_kg * options.internal_mass_percent / 100
    resonant = ResonantMount.with_resonance(spring, options.internal_resonance_hz, mass)
    return dict(zip(MOUNTS, (IdealMount(spring), resonant), strict=True))
