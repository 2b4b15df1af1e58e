"""How far the stiffness of a crumple holds: sweeps of its rings, normal forms of its modes."""

from foilstudy.pipeline.amplitude.modes import ClampedModes, clamped_modes
from foilstudy.pipeline.amplitude.sweep import MOTIONS, SweepPlan, linear_amplitude, ring_sweep

__all__ = [
    "MOTIONS",
    "ClampedModes",
    "SweepPlan",
    "clamped_modes",
    "linear_amplitude",
    "ring_sweep",
]
