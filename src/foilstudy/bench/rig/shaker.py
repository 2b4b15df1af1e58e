"""Shaker between the base frame and a reaction mass."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from foilstudy.base.ranges import require_number

__all__ = ["Shaker"]


@dataclass(frozen=True)
class Shaker:
    """Force on the base along one motion, its reaction on a mass on a mount of its own.

    A spring from that mass to the plate of the force cells is the path that bypasses the
    specimen: a hose, a cable, the floor. It moves with the excitation and so is coherent.

    Attributes
    ----------
    motion : int
        0 to 2, along x, y, z.
    point : tuple of float
        Where it drives the base, m.
    mass : float
        Of the reaction mass, kg.
    mount_hz : float
        Frequency of the reaction mass on its mount.
    loss_factor : float
        Of the mount and of the bypass.
    bypass : float
        N/m; 0 for none.
    """

    motion: int = 2
    point: tuple[float, float, float] = (0.0, 0.0, -0.05)
    mass: float = 400.0
    mount_hz: float = 2.5
    loss_factor: float = 0.1
    bypass: float = 0.0

    def __post_init__(self) -> None:
        require_number("reaction mass of a shaker", self.mass, "kg", above=0)
        require_number("frequency of a shaker's mount", self.mount_hz, "Hz", above=0)
        require_number("loss factor of a shaker's mount", self.loss_factor, least=0)
        require_number("bypass of a shaker", self.bypass, "N/m", least=0)

    def around(self, arm_m: float = 0.15) -> tuple[Self, ...]:
        """Six places that leave no motion of the base open.

        Along x, y and z where it stands; and so far off: upwards at two places, and across at one.
        """
        x, y, z = self.point
        places = [(motion, (x, y, z)) for motion in range(3)]
        places += [(2, (x + arm_m, y, z)), (2, (x, y + arm_m, z)), (0, (x, y + arm_m, z))]
        return tuple(replace(self, motion=motion, point=point) for motion, point in places)

    def dynamic_stiffness(self, frequencies: np.ndarray) -> np.ndarray:
        """Of the reaction mass on its mount, shape (f,)."""
        own = (2 * np.pi * self.mount_hz) ** 2 * (1 + 1j * self.loss_factor)
        return self.mass * (own - (2 * np.pi * frequencies) ** 2)

    @property
    def path(self) -> complex:
        """Complex stiffness of the bypass, N/m."""
        return self.bypass * (1 + 1j * self.loss_factor)
