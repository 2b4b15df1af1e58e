"""Clamps that hold the edge of a sheet by friction, and let it slip when it is pulled too hard.

A clamp grips the foil with a line force along the generators that it can bear at most. Where the
foil pulls or pushes harder, it slips along itself, out of the clamp or into it, until the force has
come down to that or it has slipped as far as it can: a perfectly plastic slider with a stop, one
for each column of control points of a ring, and with a direction of its own. Around the ring and
out of it the clamp holds, as it holds the slope: what has come out of it stands as straight as in
it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sparse

from foilstudy.model.patch import RING_ROWS, refine
from foilstudy.model.shell.shell import Shell
from foilstudy.model.shell.tangent import REACH

_SLOWNESS, _AT_REST = 20.0, 2.0
"""On the bound of the stiffness by which an overload makes slip, in each pseudo-time step: while a
ring moves, and after. From 1 on nothing overshoots. With 2 the shaking of a ramp of 2 000 steps
makes 500 um foil slip four times as far as 8 000 do, with 20 twice as far at most; but a clamp
that bears hardly more than the ring's force would not come to its end so."""


@dataclass(frozen=True, eq=False)
class Slipped:
    """What two clamps have let go.

    Attributes
    ----------
    out : ndarray, shape (2, columns)
        How far each column of control points has come out of the bottom and of the top clamp, m;
        negative where it has gone in.
    work : float
        Used up by friction, J.
    """

    out: np.ndarray
    work: float = 0.0

    def __repr__(self) -> str:
        return f"<Slipped: {1e3 * np.abs(self.out).max():.3g} mm at most>"


class Grip:
    """A term of a problem that has no energy, and moves the rings' control points.

    Parameters
    ----------
    shell : Shell
        On a closed patch.
    slip : float
        As far as the foil may slip to either side, m.
    line_force : float
        That each clamp bears at most, N/m.
    """

    energy_names = ()

    def __init__(self, shell: Shell, slip: float, line_force: float):
        self._shell, self._slip = shell, slip
        self._limit = line_force * shell.patch.size_around

    def __repr__(self) -> str:
        line_force = self._limit / self._shell.patch.size_around
        return f"<Grip: {line_force:g} N/m, {1e3 * self._slip:g} mm>"

    def start(self) -> Slipped:
        """Nothing has slipped."""
        return Slipped(np.zeros((2, self._shell.patch.columns)))

    def evolved(self, points: np.ndarray, state: Slipped) -> Slipped:
        """The same: it slips in `given_way` alone."""
        return state

    def force(self, points: np.ndarray, out: np.ndarray, state: Slipped) -> np.ndarray:
        """See `solve.problem.Term`: none between the rings."""
        out[:] = 0.0
        return np.empty(0)

    def tangent(self, points: np.ndarray, state: Slipped) -> sparse.csr_matrix:
        """See `solve.problem.Term`: in small motions the clamps hold."""
        return sparse.csr_matrix((points.size, points.size))

    def given_way(
        self, points: np.ndarray, force: np.ndarray, state: Slipped, at_rest: bool
    ) -> Slipped:
        """See `solve.problem.GivingWay`."""
        directions = [_outward(points, ring) for ring in _RINGS]
        excess = self._excess(directions, force, state)
        if not excess.any():
            return state
        slowness = _AT_REST if at_rest else _SLOWNESS
        way = excess / (slowness * self._stiffness)
        out = np.clip(state.out + way, -self._slip, self._slip)
        slipped = out - state.out
        for ring, direction, more in zip(_RINGS, directions, slipped, strict=True):
            points[:, ring] += (more * direction)[:, None]
        return Slipped(out, state.work + self._limit * float(np.abs(slipped).sum()))

    def unheld(self, points: np.ndarray, force: np.ndarray, state: Slipped) -> float:
        """See `solve.problem.GivingWay`."""
        directions = [_outward(points, ring) for ring in _RINGS]
        return float(np.linalg.norm(self._excess(directions, force, state)))

    def used_up(self, state: Slipped) -> float:
        """See `solve.problem.GivingWay`."""
        return state.work

    def raised(self, points: np.ndarray, state: Slipped) -> float:
        """See `solve.problem.GivingWay`."""
        top = 1
        return float(np.mean(state.out[top] * _outward(points, _RINGS[top])[2]))

    def numbers(self, state: Slipped) -> dict[str, float]:
        """See `solve.problem.Telling`."""
        return {
            "clamp_slip_max": float(np.abs(state.out).max()),
            "clamp_slip_mean": float(state.out.mean()),
            "clamp_slipped_share": float(np.mean(state.out != 0)),
            "clamp_work": state.work,
        }

    def recorded(self, state: Slipped) -> dict[str, np.ndarray]:
        """See `solve.problem.Lasting`."""
        return {"clamp_slip": state.out, "clamp_work": np.asarray(state.work)}

    def split(self, state: Slipped) -> dict[str, np.ndarray]:
        """See `solve.problem.Lasting`: the rings are the same curves on the finer mesh."""
        finer = refine(np.stack([state.out, state.out], axis=1))[:, 0]
        return self.recorded(Slipped(finer, state.work))

    def restored(self, values: Mapping[str, np.ndarray]) -> Slipped:
        """See `solve.problem.Lasting`."""
        return Slipped(np.array(values["clamp_slip"]), float(values["clamp_work"]))

    def _excess(
        self, directions: list[np.ndarray], force: np.ndarray, state: Slipped
    ) -> np.ndarray:
        """Pull of the foil out of the clamps that these do not bear, shape (2, columns), N.

        What has come to its stop is borne.
        """
        pull = np.stack(
            [
                -np.sum(force[:, ring].sum(axis=1) * direction, axis=0)
                for ring, direction in zip(_RINGS, directions, strict=True)
            ]
        )
        excess = np.sign(pull) * np.maximum(np.abs(pull) - self._limit, 0.0)
        stopped = np.sign(excess) * state.out >= self._slip
        return np.where(stopped, 0.0, excess)

    @cached_property
    def _stiffness(self) -> np.ndarray:
        """Bound of the stiffness against the slipping of neighbours, shape (2, columns), N/m."""
        blocks = self._shell.tangent_blocks()[..., 2, 2]
        rows = np.arange(RING_ROWS)
        among = [
            sum(blocks[ring][p, :, q - p + REACH] for p in rows for q in rows) for ring in _RINGS
        ]
        return np.abs(np.stack(among)).sum(axis=2)


_RINGS = slice(0, RING_ROWS), slice(-RING_ROWS, None)


def _outward(points: np.ndarray, ring: slice) -> np.ndarray:
    """Unit vectors along the generators in a clamp, out of it, shape (3, columns)."""
    rows = points[:, ring]
    across = rows[:, -1] - rows[:, 0]
    if ring.start:  # the foil is below the top ring
        across = -across
    return across / np.linalg.norm(across, axis=0)
