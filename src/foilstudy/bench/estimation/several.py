"""All six motions told apart by runs that drive the rig in different ways.

One shaker at one place moves a base in more than the wanted motion: the specimen itself pushes it
aside, and frames turn. What these motions add to the force is no noise, so that no average over a
single run takes it off. Six runs leave no motion open.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.bench.estimation.best_linear import excited_lines, sound_means
from foilstudy.bench.estimation.channels import across
from foilstudy.bench.estimation.estimate import Estimate
from foilstudy.bench.estimation.periods import PeriodMeans, Periods
from foilstudy.bench.recording import Recording

__all__ = ["TransferMatrix", "interface_lines", "transfer_matrix"]

_MOTIONS = 6
_SINGULAR = 1e-8
"""Smallest singular value over the largest, each motion over its own size, below which the runs do
not tell the motions apart."""


@dataclass(frozen=True, eq=False)
class TransferMatrix:
    """Wrench on the upper ring per motion of the lower one, five motions held while one moves.

    Attributes
    ----------
    frequencies : ndarray, shape (f,)
        Hz, those that were excited.
    values : ndarray of complex, shape (f, 6, 6)
        N/m, N, N m; against the motion, as a spring.
    deviation : ndarray, shape (f, 6, 6)
        Standard deviation of the complex values.
    averages : float
        Periods per motion, over all runs.
    """

    frequencies: np.ndarray
    values: np.ndarray
    deviation: np.ndarray
    averages: float

    def along(self, motion: int) -> Estimate:
        """Transfer stiffness of one motion, 0 to 5."""
        values, deviation = (each[:, motion, motion] for each in (self.values, self.deviation))
        share = self.averages * deviation**2 / np.abs(values) ** 2
        return Estimate(self.frequencies, values, deviation, 1 / (1 + share))


def interface_lines(
    recording: Recording, periods: Periods, gap_m: float, highest_hz: float
) -> PeriodMeans:
    """Lines of the twelve signals of `across` in one run.

    Raises
    ------
    Refusal
        If a channel is unsound, or the record does not repeat with the period.
    """
    return sound_means(recording, periods, highest_hz).combined(across(recording.channels, gap_m))


def transfer_matrix(runs: Sequence[PeriodMeans], lines: np.ndarray) -> TransferMatrix:
    """Least squares W = T R over the runs, wrenches W and motions R, shape (6, runs).

    An error E of a run, of wrench less T times motion, makes errors E R^+ of T. With more than six
    runs their misfit is the other measure of E, and the larger one counts: the foil's own inertia
    where the upper frame moves, and distortion.

    Parameters
    ----------
    runs : sequence of PeriodMeans
        As `interface_lines` gives them, six or more, all of the same periods.
    lines : ndarray of int
        Those that were excited, alike in all runs.

    Raises
    ------
    Refusal
        If there are fewer than six, they do not share their frequencies, or they leave a motion
        open.
    """
    if len(runs) < _MOTIONS:
        raise Refusal(
            f"{len(runs)} runs do not tell six motions apart; drive the base along three axes and "
            "at three places off them."
        )
    first = runs[0]
    if any(not np.array_equal(first.frequencies, each.frequencies) for each in runs):
        raise Refusal("the runs have other frequencies; cut them into the same periods.")
    kept = [each.at(excited_lines(each, lines)) for each in runs]
    if not kept[0].frequencies.size:
        raise Refusal("none of the excited lines was measured; give those of this period.")
    both = np.stack([each.means for each in kept], axis=-1)
    motions, wrenches = both[:, :_MOTIONS], both[:, _MOTIONS:]
    sizes = np.linalg.norm(motions, axis=2, keepdims=True)
    spread = np.linalg.svd(motions / sizes, compute_uv=False)
    if (spread[:, -1] < _SINGULAR * spread[:, 0]).any():
        raise Refusal(
            "the runs do not move the lower ring in six independent ways; drive the base along "
            "other axes or at other places."
        )
    inverse = np.linalg.pinv(motions / sizes) / sizes.swapaxes(1, 2)
    values = wrenches @ inverse
    noise = _error(kept, values)
    if len(runs) > _MOTIONS:
        misfit = np.abs(wrenches - values @ motions) ** 2
        free = len(runs) - _MOTIONS
        noise = np.maximum(noise, misfit.sum(axis=2, keepdims=True) / free)
    deviation = np.sqrt(noise @ np.abs(inverse) ** 2)
    averages = first.periods * len(runs) / _MOTIONS
    return TransferMatrix(kept[0].frequencies, values, deviation, averages)


def _error(runs: Sequence[PeriodMeans], values: np.ndarray) -> np.ndarray:
    """E|wrench less stiffness times motion|^2 of each run's means by noise, shape (f, 6, runs)."""
    rows = np.concatenate([-values, np.broadcast_to(np.eye(_MOTIONS), values.shape)], axis=2)
    covariances = (each.covariance / each.periods for each in runs)
    each = [np.einsum("fwi,fij,fwj->fw", rows.conj(), c, rows).real for c in covariances]
    return np.maximum(np.stack(each, axis=-1), 0.0)
