"""Motion per force, as modal tests measure it, on evenly spaced frequencies that show resonances.

Receptance is displacement per force; accelerance, acceleration per force, is -omega2 times it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh

from foilstudy.measure.dynamics.damping import Damping
from foilstudy.measure.dynamics.reduction import ReducedModel
from foilstudy.measure.dynamics.response import interface_dynamic_stiffness, interface_receptance
from foilstudy.measure.dynamics.structure import INTERFACE

CONDITIONS = {"free": slice(0, INTERFACE), "bottom_held": slice(INTERFACE // 2, INTERFACE)}
"""The ring motions that move, in the order of all twelve: both rings free, as on soft strings; the
bottom ring held in all six of its motions, as on a heavy table."""

LINES_PER_BANDWIDTH = 3
"""Frequencies within the half-power bandwidth of the sharpest resonance, at least."""
LINES_MIN, LINES_MAX = 400, 4000
"""Of an even grid; the larger one bounds the size of files."""


def receptance(
    model: ReducedModel, frequencies: np.ndarray, damping: Damping, condition: str
) -> np.ndarray:
    """Receptance of the ring motions that a condition of `CONDITIONS` leaves free.

    Parameters
    ----------
    model : ReducedModel
    frequencies : ndarray
        Hz, positive and rising, up to where the model is valid.
    damping : Damping
    condition : str

    Returns
    -------
    ndarray of complex, shape (frequencies, 12, 12) or (frequencies, 6, 6)
        m/N, rad/N, m/(N m) and rad/(N m).
    """
    moving = CONDITIONS[condition]
    if moving == CONDITIONS["free"]:
        return interface_receptance(model, frequencies, damping)
    stiffness = interface_dynamic_stiffness(model, frequencies, damping)
    return np.linalg.inv(stiffness[:, moving, moving])


def accelerance(receptance: np.ndarray, frequencies: np.ndarray) -> np.ndarray:
    """Acceleration per force of the same motions and frequencies (Hz), 1/kg and the like."""
    return -((2 * np.pi * frequencies[:, None, None]) ** 2) * receptance


def resonances(
    model: ReducedModel, damping: Damping, condition: str
) -> tuple[np.ndarray, np.ndarray]:
    """Eigenfrequencies under a condition and their half-power bandwidths, Hz.

    The bandwidth is psi^T C psi over 2 pi of the mass-normalised mode psi, as 2 zeta f of a single
    one: damping is known in the modes of the free structure, and carried over from them.
    """
    free_values, free_shapes = model.free_modes()
    kept = slice(CONDITIONS[condition].start, None)  # held motions are the first coordinates
    values, shapes = eigh(model.stiffness[kept, kept], model.mass[kept, kept])
    if condition == "free":
        values, shapes = free_values, free_shapes
    shares = (shapes.T @ model.mass[kept] @ free_shapes) ** 2
    elastic = values > 0
    omega = np.sqrt(values[elastic])
    terms = damping.modal(free_values, omega[:, None]).imag
    widths = (shares[elastic] * terms).sum(axis=1) / omega
    return omega / (2 * np.pi), widths / (2 * np.pi)


@dataclass(frozen=True, eq=False)
class EvenGrid:
    """Evenly spaced frequencies, multiples of their spacing.

    Attributes
    ----------
    frequencies : ndarray
        Hz.
    spacing : float
        Hz; 1, 2 or 5 times a power of ten, so that six digits in a file hold it exactly.
    sharpest_hz, bandwidth_hz : float
        The resonance of least half-power bandwidth in the band; NaN where there is none.
    """

    frequencies: np.ndarray
    spacing: float
    sharpest_hz: float
    bandwidth_hz: float

    def __repr__(self) -> str:
        lowest, highest = self.frequencies[[0, -1]]
        return f"<EvenGrid: {lowest:g} to {highest:g} Hz, {self.words}>"

    @classmethod
    def of(
        cls, model: ReducedModel, damping: Damping, lowest_hz: float, highest_hz: float
    ) -> EvenGrid:
        """The widest spacing that shows every resonance in the band, free and bottom held.

        `LINES_PER_BANDWIDTH` frequencies within the least bandwidth and at least `LINES_MIN` in
        the band, but no more than `LINES_MAX`: `words` says where those do not show it.
        """
        found = [np.array(resonances(model, damping, condition)) for condition in CONDITIONS]
        hz, widths = np.concatenate(found, axis=1)
        inside = (hz >= lowest_hz) & (hz <= highest_hz)
        hz, widths = hz[inside], widths[inside]
        sharpest, bandwidth = math.nan, math.nan
        wanted, least = highest_hz / LINES_MIN, highest_hz / LINES_MAX
        if hz.size:
            at = int(np.argmin(widths))
            sharpest, bandwidth = float(hz[at]), float(widths[at])
            wanted = min(wanted, bandwidth / LINES_PER_BANDWIDTH)
        spacing = max(_round_numbers(max(wanted, least))[0], _round_numbers(least)[1])
        first = math.ceil(lowest_hz / spacing * (1 - 1e-12))
        last = math.floor(highest_hz / spacing * (1 + 1e-12))
        return cls(spacing * np.arange(max(first, 1), last + 1), spacing, sharpest, bandwidth)

    @property
    def words(self) -> str:
        """What the spacing shows of the sharpest resonance, in at most 80 characters."""
        if math.isnan(self.bandwidth_hz):
            return f"spacing {self.spacing:g} Hz; no resonance in the band"
        verdict = (
            ""
            if self.spacing * LINES_PER_BANDWIDTH <= self.bandwidth_hz * (1 + 1e-9)
            else "COARSE: "
        )
        return (
            f"{verdict}spacing {self.spacing:g} Hz; least half-power width "
            f"{self.bandwidth_hz:.3g} Hz at {self.sharpest_hz:.4g} Hz"
        )


def _round_numbers(value: float) -> tuple[float, float]:
    """The numbers 1, 2 and 5 times a power of ten just below (or at) a value, and just above."""
    steps = 10.0 ** math.floor(math.log10(value)) * np.array([1.0, 2.0, 5.0, 10.0])
    below, above = steps <= value * (1 + 1e-12), steps >= value * (1 - 1e-12)
    return float(steps[below].max()), float(steps[above].min())
