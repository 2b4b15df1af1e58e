"""The rig as a linear system of thirteen motions in the frequency domain."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np

from foilstudy.base.ranges import require_number
from foilstudy.bench.recording import ACCELERATION, GRAVITY, Channel
from foilstudy.bench.rig.frames import BASE, METROLOGY, Frame
from foilstudy.bench.rig.sensors import Sensors, shown
from foilstudy.bench.rig.shaker import Shaker
from foilstudy.bench.rig.specimens import Specimen
from foilstudy.bench.rig.specimens.absent import Absent

__all__ = ["Rig"]

_BASE, _METROLOGY, _REACTION = slice(0, 6), slice(6, 12), 12


@dataclass(frozen=True, eq=False)
class Rig:
    """Base frame, specimen, force cells and metrology frame, and the shaker.

    The force cells are stiff: the upper ring moves with the metrology frame.

    Attributes
    ----------
    specimen : Specimen
    gap_m : float
        Height of the upper ring's centre above the lower one's.
    base, metrology : Frame
    shaker : Shaker
    sensors : Sensors
    """

    specimen: Specimen
    gap_m: float
    base: Frame = BASE
    metrology: Frame = METROLOGY
    shaker: Shaker = field(default_factory=Shaker)
    sensors: Sensors = field(default_factory=Sensors)

    def __post_init__(self) -> None:
        require_number("gap", self.gap_m, "m", above=0)

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Of all sensors."""
        return self.sensors.channels(self.gap_m)

    def emptied(self) -> Self:
        """The same rig without specimen."""
        return replace(self, specimen=Absent())

    def truth(self, frequencies: np.ndarray) -> np.ndarray:
        """Transfer stiffness of the specimen along the shaker's motion, shape (f,), N/m."""
        motion = self.shaker.motion
        return -self.specimen.dynamic_stiffness(frequencies)[:, 6 + motion, motion]

    def response(self, frequencies: np.ndarray) -> LinearResponse:
        """All channels per unit force of the shaker, and per unit axial force of the specimen."""
        rings = np.zeros((12, 13))
        rings[:6, _BASE] = self.base.motion_at((0.0, 0.0, 0.0))
        rings[6:, _METROLOGY] = self.metrology.motion_at((0.0, 0.0, self.gap_m))
        foil = self.specimen.dynamic_stiffness(frequencies) @ rings
        along = 6 + self.shaker.motion
        bypass = -rings[along].copy()  # stretch of the bypass per motion
        bypass[_REACTION] = 1.0
        path = self.shaker.path
        stiffness = rings.T @ foil + path * np.outer(bypass, bypass)
        k = np.arange(13)
        stiffness[:, k[_BASE], k[_BASE]] += self.base.dynamic_stiffness(frequencies)
        stiffness[:, k[_METROLOGY], k[_METROLOGY]] += self.metrology.dynamic_stiffness(frequencies)
        stiffness[:, _REACTION, _REACTION] += self.shaker.dynamic_stiffness(frequencies)
        drive = np.zeros((13, 2))
        drive[_BASE, 0] = self.base.motion_at(self.shaker.point)[self.shaker.motion]
        drive[_REACTION, 0] = -1.0
        axial = rings[2] - rings[8]  # motion of the lower ring against the upper one
        drive[:, 1] = -axial
        motions = np.linalg.solve(stiffness, np.broadcast_to(drive, (len(frequencies), 13, 2)))
        wrench = -foil[:, 6:] @ motions  # of the foil on the upper ring
        wrench[:, 2, 1] += 1.0
        wrench[:, self.shaker.motion] += path * (bypass @ motions)
        wrench -= self._plate(frequencies) @ rings[6:] @ motions
        return LinearResponse(
            self._shown(motions, wrench, frequencies), (axial @ motions), frequencies
        )

    def _plate(self, frequencies: np.ndarray) -> np.ndarray:
        """Force that the plate takes per motion of the upper ring's centre, shape (f, 6, 6).

        Its inertia, and its weight when the frame turns.
        """
        mass = self.sensors.plate
        out = np.zeros((len(frequencies), 6, 6))
        out[:, [0, 1, 2], [0, 1, 2]] = -mass * (2 * np.pi * frequencies[:, None]) ** 2
        out[:, 0, 4], out[:, 1, 3] = -mass * GRAVITY, mass * GRAVITY
        return out

    def _shown(
        self, motions: np.ndarray, wrench: np.ndarray, frequencies: np.ndarray
    ) -> np.ndarray:
        """What the channels show, shape (f, channels, 2)."""
        from foilstudy.measure.stiffness.rings import rigid_motion

        channels = self.channels
        frames = {"base": (self.base, _BASE), "metrology": (self.metrology, _METROLOGY)}
        out = np.empty((len(frequencies), len(channels), 2), dtype=complex)
        cells = [k for k, each in enumerate(channels) if each.unit != ACCELERATION]
        for k, channel in enumerate(channels):
            if k not in cells:
                frame, place = frames[channel.body]
                there = frame.motion_at(channel.position) @ motions[:, place]
                out[:, k] = np.einsum(
                    "fm,fmd->fd", shown(channel, self.sensors.tilt, frequencies), there
                )
        arms = np.array([channels[k].position for k in cells[::3]]) - (0.0, 0.0, self.gap_m)
        map_ = rigid_motion(arms)  # a stiff plate on equal cells: the least forces that add up
        out[:, cells] = map_ @ np.linalg.solve(map_.T @ map_, wrench)
        return out


@dataclass(frozen=True, eq=False)
class LinearResponse:
    """Per newton of the shaker and per newton of an axial pair on the two rings.

    Attributes
    ----------
    channels : ndarray of complex, shape (f, channels, 2)
        In the units of the channels.
    axial : ndarray of complex, shape (f, 2)
        Motion of the lower ring against the upper one along the axis, m.
    frequencies : ndarray
        Hz.
    """

    channels: np.ndarray
    axial: np.ndarray
    frequencies: np.ndarray
