"""Free vibration of a whole structure that is let go from a shape: the truth for reduced models."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.linalg import factorise, largest_eigenvalue
from foilstudy.measure.amplitude.normal_form import Vibrating

_STABLE = 0.6
"""Time step over that at which central differences of the linear structure become unstable."""


@dataclass(frozen=True, eq=False)
class Release:
    """How the amplitude of a mode goes on.

    Attributes
    ----------
    time : ndarray, shape (steps,)
        s.
    amplitude : ndarray, shape (steps,)
        Of the mode, sqrt(kg) m.
    """

    time: np.ndarray
    amplitude: np.ndarray

    @property
    def frequency(self) -> float:
        """From the first to the last passage upwards through zero, Hz; NaN with fewer than two."""
        before, after = self.amplitude[:-1], self.amplitude[1:]
        up = np.flatnonzero((before < 0) & (after >= 0))
        if up.size < 2:
            return np.nan
        share = before[up] / (before[up] - after[up])
        passed = self.time[up] + share * (self.time[1] - self.time[0])
        return float((up.size - 1) / (passed[-1] - passed[0]))


def released(
    system: Vibrating, shape: np.ndarray, displacement: np.ndarray, duration: float
) -> Release:
    """Let a structure go, and integrate its motion by central differences, without damping.

    Parameters
    ----------
    system : Vibrating
    shape : ndarray, shape (n,)
        Mass-normalised, of the mode that is looked at.
    displacement : ndarray, shape (n,)
        From which it is let go, m.
    duration : float
        s.

    Raises
    ------
    SolveError
        If the mass cannot be factored or the highest eigenfrequency not be found.
    FloatingPointError
        If the motion leaves all bounds: it has become too stiff for the step on the way.
    """
    mass = factorise(system.mass)
    step = _STABLE * 2 / np.sqrt(largest_eigenvalue(system.stiffness, system.mass))
    steps = int(np.ceil(duration / step))
    probe = system.mass @ shape
    u = np.array(displacement, dtype=float)
    before = u - 0.5 * step**2 * mass.solve(system.force(u))  # it starts at rest
    bound = 1e3 * np.abs(u).max()
    amplitude = np.empty(steps)
    for k in range(steps):
        amplitude[k] = probe @ u
        u, before = 2 * u - before - step**2 * mass.solve(system.force(u)), u
        if not np.abs(u).max() < bound:
            raise FloatingPointError(f"the motion left all bounds after {k + 1} steps")
    return Release(step * np.arange(steps), amplitude)
