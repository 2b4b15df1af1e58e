"""Sensors combined into motions of rigid frames, forces and moments."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.bench.recording import ACCELERATION, FORCE, Channel

__all__ = ["Combination", "across", "along", "force_sum", "frame_motion"]

MOTION, REACTION = 0, 1
"""Signals of `along`, in their order."""

_SINGULAR = 1e-6
"""Smallest singular value over the largest below which an array leaves a motion open."""


@dataclass(frozen=True, eq=False)
class Combination:
    """Signals as weighted sums of channels, some of them integrated.

    Attributes
    ----------
    weights : ndarray, shape (signals, channels)
    integrations : ndarray of int, shape (signals,)
        How often a sum is integrated over time: 0, or 2 from an acceleration to a displacement.
    """

    weights: np.ndarray
    integrations: np.ndarray

    def at(self, frequencies: np.ndarray) -> np.ndarray:
        """Weights at frequencies (Hz, positive), shape (f, signals, channels)."""
        omega = 2j * np.pi * np.asarray(frequencies)[:, None, None]
        return self.weights * omega ** -self.integrations[:, None].astype(float)

    def along(self, rows: np.ndarray) -> Self:
        """Sums of these signals, which must have been integrated alike where they are mixed."""
        used = rows != 0
        integrations = np.array([self.integrations[u].max(initial=0) for u in used])
        if any((self.integrations[u] != n).any() for u, n in zip(used, integrations)):
            raise ValueError("signals integrated differently cannot be added")
        return type(self)(rows @ self.weights, integrations)

    def stacked(self, other: Self) -> Self:
        """Both, one after the other."""
        return type(self)(
            np.concatenate([self.weights, other.weights]),
            np.concatenate([self.integrations, other.integrations]),
        )


def frame_motion(
    channels: Sequence[Channel], body: str, point: tuple[float, float, float]
) -> Combination:
    """Displacement and rotation of a rigid frame at a point, from its accelerometers.

    Least squares over all accelerometers on it: n_s . (a + alpha x r_s) = signal.

    Returns
    -------
    Combination
        Six signals, m and rad.

    Raises
    ------
    Refusal
        If the array leaves one of the six motions open.
    """
    places, map_ = _array(channels, body, point, ACCELERATION)
    values = np.linalg.svd(map_, compute_uv=False) if len(places) >= 6 else np.zeros(1)
    if values[-1] <= _SINGULAR * values[0]:
        raise Refusal(
            f"{len(places)} accelerometers on the {body} frame do not tell its six motions apart; "
            "use at least six, not all on a line or along one direction."
        )
    weights = np.zeros((6, len(channels)))
    weights[:, places] = np.linalg.pinv(map_)
    return Combination(weights, np.full(6, 2))


def force_sum(
    channels: Sequence[Channel], body: str, point: tuple[float, float, float]
) -> Combination:
    """Force and moment about a point, the sum over all force channels.

    Returns
    -------
    Combination
        Six signals, N and N m.

    Raises
    ------
    Refusal
        If there is no force channel.
    """
    places, map_ = _array(channels, body, point, FORCE)
    if not places:
        raise Refusal(
            f"there is no force channel on the {body} frame; name its force cells in the recording."
        )
    weights = np.zeros((6, len(channels)))
    weights[:, places] = map_.T
    return Combination(weights, np.zeros(6, dtype=int))


def along(channels: Sequence[Channel], motion: int, gap_m: float) -> Combination:
    """Motion of the lower ring against the upper one, and the force on the metrology frame.

    Parameters
    ----------
    channels : sequence of Channel
    motion : int
        0 to 2, along x, y, z.
    gap_m : float
        Height of the upper ring's centre above the lower one's.

    Returns
    -------
    Combination
        Two signals: m (lower minus upper) and N.
    """
    rows = np.zeros((1, 6))
    rows[0, motion] = 1.0
    upper = (0.0, 0.0, gap_m)
    lower = frame_motion(channels, "base", (0.0, 0.0, 0.0))
    above = frame_motion(channels, "metrology", upper)
    relative = lower.stacked(above).along(np.concatenate([rows, -rows], axis=1))
    return relative.stacked(force_sum(channels, "metrology", upper).along(rows))


def across(channels: Sequence[Channel], gap_m: float) -> Combination:
    """All six motions of the lower ring as the upper frame sees them, and all that it bears.

    Lower minus upper, both about the centre of the lower ring, so that a common rigid motion is
    none.

    Returns
    -------
    Combination
        Twelve signals: m and rad; N and N m about the centre of the upper ring.
    """
    lower, above = (frame_motion(channels, body, (0.0, 0.0, 0.0)) for body in ("base", "metrology"))
    relative = lower.stacked(above).along(np.hstack([np.eye(6), -np.eye(6)]))
    return relative.stacked(force_sum(channels, "metrology", (0.0, 0.0, gap_m)))


def _array(
    channels: Sequence[Channel], body: str, point: tuple[float, float, float], unit: str
) -> tuple[list[int], np.ndarray]:
    """Channels of a kind on a body, and what each shows per rigid motion about a point."""
    from foilstudy.measure.stiffness.rings import rigid_motion

    places = [k for k, each in enumerate(channels) if each.body == body and each.unit == unit]
    arms = np.array([channels[k].position for k in places]).reshape(-1, 3) - point
    directions = np.array([channels[k].direction for k in places]).reshape(-1, 1, 3)
    return places, (directions @ rigid_motion(arms).reshape(-1, 3, 6))[:, 0]
