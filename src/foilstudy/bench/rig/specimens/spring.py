"""Six springs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.ranges import require_number

__all__ = ["Spring"]


@dataclass(frozen=True)
class Spring:
    """A massless link whose upper end is loaded by relative motions alone.

    Attributes
    ----------
    axial, radial, rocking, torsion : float
        N/m, N/m, N m/rad, N m/rad, about the middle between the rings.
    gap_m : float
        Height of the upper ring's centre above the lower one's.
    loss_factor : float
    """

    kind = "spring"
    axial: float
    radial: float
    rocking: float
    torsion: float
    gap_m: float
    loss_factor: float = 0.0

    def __post_init__(self) -> None:
        for name in ("axial", "radial", "rocking", "torsion"):
            require_number(f"{name} stiffness of a spring", getattr(self, name), least=0)
        require_number("gap", self.gap_m, "m", above=0)
        require_number("loss factor", self.loss_factor, least=0)

    def dynamic_stiffness(self, frequencies: np.ndarray) -> np.ndarray:
        """See `Specimen`."""
        from foilstudy.measure.stiffness.rings import rigid_motion

        half = np.array([[0.0, 0.0, self.gap_m / 2]])
        turned = np.eye(6)[3:]
        lower = np.concatenate([rigid_motion(half), turned])  # motion of the middle, from below
        upper = np.concatenate([rigid_motion(-half), turned])
        relative = np.concatenate([lower, -upper], axis=1)
        springs = np.array(
            [self.radial, self.radial, self.axial, self.rocking, self.rocking, self.torsion]
        )
        static = relative.T @ (springs[:, None] * relative)
        return np.tile(static * (1 + 1j * self.loss_factor), (len(frequencies), 1, 1))
