"""Rigid frames on elastic mounts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.ranges import require_number

__all__ = ["BASE", "METROLOGY", "Frame"]

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Frame:
    """A rigid body on a mount at its centre of mass.

    Attributes
    ----------
    mass : float
        kg.
    gyration : tuple of float
        Radii of gyration about x, y, z, m.
    centre : tuple of float
        Centre of mass, m; the lower ring's centre is the origin.
    mount_hz : tuple of float
        Frequencies of the free frame on its mount along x, y, z and about x, y, z.
    loss_factor : float
        Of the mount.
    """

    mass: float
    gyration: Vector
    centre: Vector
    mount_hz: tuple[float, float, float, float, float, float]
    loss_factor: float = 0.1

    def __post_init__(self) -> None:
        require_number("mass of a frame", self.mass, "kg", above=0)
        require_number("loss factor of a mount", self.loss_factor, least=0)
        for value in self.gyration:
            require_number("radius of gyration of a frame", value, "m", above=0)
        for value in self.mount_hz:
            require_number("frequency of a mount", value, "Hz", least=0)

    def dynamic_stiffness(self, frequencies: np.ndarray) -> np.ndarray:
        """On its six motions about the centre of mass, diagonal, shape (f, 6)."""
        inertia = self.mass * np.array([1.0, 1.0, 1.0, *np.square(self.gyration)])
        own = (2 * np.pi * np.array(self.mount_hz)) ** 2 * (1 + 1j * self.loss_factor)
        return inertia * (own - (2 * np.pi * frequencies[:, None]) ** 2)

    def motion_at(self, point: Vector) -> np.ndarray:
        """Displacement and rotation at a point per motion about the centre of mass, (6, 6)."""
        from foilstudy.measure.stiffness.rings import rigid_motion

        arm = np.subtract(point, self.centre)
        return np.concatenate([rigid_motion(arm[None]), np.eye(6)[3:]])


BASE = Frame(60.0, (0.2, 0.2, 0.25), (0.0, 0.0, -0.05), (2.5, 2.5, 2.5, 50.0, 50.0, 50.0))
"""Frame that is shaken; a design value, as the published one is not known."""
METROLOGY = Frame(500.0, (0.35, 0.35, 0.4), (0.0, 0.0, 0.45), (1.0, 1.0, 1.5, 25.0, 25.0, 25.0))
"""The frame of 500 kg on its bellow; all but the mass is a design value. Both frames are guided, so
that they hardly turn."""
