"""Accelerometers on the frames and three-axis force cells under the upper ring."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.ranges import require_count, require_number
from foilstudy.bench.recording import ACCELERATION, FORCE, GRAVITY, Channel

__all__ = ["Sensors"]


@dataclass(frozen=True)
class Sensors:
    """What is measured, and how badly.

    Attributes
    ----------
    accelerometers : int
        Places on each frame, evenly around the axis; each has a vertical and a tangential one.
    arm : float
        Their distance from the axis, m.
    cells : int
        Three-axis force cells, evenly around the axis on a radius of half the arm.
    acceleration_noise, force_noise : float
        Density of white noise, m/s^2 and N per root Hz.
    tilt : float
        Share of gravity that the accelerometers see when they tilt: 1 where they respond down to
        rest, 0 for ideal ones.
    plate : float
        Mass between force cells and upper ring, kg: its inertia is measured as a force, and its
        weight when the frame turns.
    full_scale_acceleration, full_scale_force : float
        m/s^2 and N.
    """

    accelerometers: int = 3
    arm: float = 0.2
    cells: int = 3
    acceleration_noise: float = 1e-6
    force_noise: float = 1e-5
    tilt: float = 0.0
    plate: float = 0.0
    full_scale_acceleration: float = float("inf")
    full_scale_force: float = float("inf")

    def __post_init__(self) -> None:
        require_count("number of places with accelerometers on a frame", self.accelerometers, 3)
        require_count("number of force cells", self.cells, 3)
        require_number("distance of the accelerometers from the axis", self.arm, "m", above=0)
        for name in ("acceleration_noise", "force_noise", "plate"):
            require_number(name.replace("_", " "), getattr(self, name), least=0)
        require_number("tilt", self.tilt, least=0, most=1)

    def channels(self, gap_m: float) -> tuple[Channel, ...]:
        """All channels: base, metrology frame, force cells."""
        full = self.full_scale_acceleration
        found = []
        for body, height in (("base", 0.0), ("metrology", gap_m)):
            for k, (x, y) in enumerate(_around(self.accelerometers)):
                place = (self.arm * x, self.arm * y, height)
                for axis, direction in (("z", (0.0, 0.0, 1.0)), ("t", (-y, x, 0.0))):
                    name = f"{body}_{k + 1}{axis}"
                    found.append(Channel(name, ACCELERATION, body, place, direction, full))
        for k, (x, y) in enumerate(_around(self.cells)):
            place = (0.5 * self.arm * x, 0.5 * self.arm * y, gap_m)
            for axis, direction in zip("xyz", np.eye(3).tolist()):
                name = f"cell_{k + 1}{axis}"
                found.append(
                    Channel(
                        name, FORCE, "metrology", place, tuple(direction), self.full_scale_force
                    )
                )
        return tuple(found)

    def noise(self, channel: Channel) -> float:
        """Density of the noise of a channel, per root Hz."""
        return self.acceleration_noise if channel.unit == ACCELERATION else self.force_noise


def _around(count: int) -> list[tuple[float, float]]:
    angles = 2 * np.pi * np.arange(count) / count
    return [(float(np.cos(a)), float(np.sin(a))) for a in angles]


def shown(channel: Channel, tilt: float, frequencies: np.ndarray) -> np.ndarray:
    """What an accelerometer shows per motion of its frame at its place, shape (f, 6).

    n . (a + tilt g z x theta): in a frame turned by theta gravity has the components
    g z - theta x g z.
    """
    n = np.array(channel.direction)
    omega2 = (2 * np.pi * frequencies[:, None]) ** 2
    by_rotation = tilt * GRAVITY * np.cross(n, [0.0, 0.0, 1.0])
    return np.concatenate([-omega2 * n, by_rotation + 0 * omega2], axis=1)
