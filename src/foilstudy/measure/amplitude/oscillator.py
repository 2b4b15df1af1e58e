"""One degree of freedom with a force that is a polynomial of its displacement."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

_QUADRATURE = 64


@dataclass(frozen=True)
class Oscillator:
    """a'' + force(a) = 0 at unit mass.

    Attributes
    ----------
    coefficients : tuple of float
        Of a, a2, a3, ... in the force; the first is positive.
    """

    coefficients: tuple[float, ...]

    def force(self, a: np.ndarray) -> np.ndarray:
        """Of the spring."""
        return np.polyval((*self.coefficients[::-1], 0.0), a)

    def slope(self, a: np.ndarray) -> np.ndarray:
        """Derivative of the force."""
        return np.polyval(np.polyder(np.array((*self.coefficients[::-1], 0.0))), a)

    def energy(self, a: np.ndarray) -> np.ndarray:
        """Of the spring, zero at rest."""
        return np.polyval(np.polyint(np.array((*self.coefficients[::-1], 0.0))), a)

    @property
    def frequency(self) -> float:
        """Of small vibrations, rad/s."""
        return float(np.sqrt(self.coefficients[0]))

    def turning_point(self, amplitude: float) -> float:
        """Where a vibration that turns at an amplitude turns on the other side; NaN if nowhere."""
        level = float(self.energy(amplitude))
        energy = np.polyint(np.array((*self.coefficients[::-1], 0.0)))
        energy[-1] -= level
        roots = np.roots(energy)
        real = roots[np.abs(roots.imag) < 1e-7 * np.abs(roots)].real
        behind = real[np.sign(real) == -np.sign(amplitude)]
        if not behind.size or (self.energy(np.linspace(0, amplitude, 99)[:-1]) >= level).any():
            return np.nan  # it has left the well
        return float(behind[np.abs(behind).argmin()])

    def period_frequency(self, amplitude: float) -> float:
        """Frequency of the free vibration that turns at an amplitude, rad/s; NaN if none does.

        From conservation of energy: the quarter periods are integrals over the displacement, which
        Gauss and Chebyshev's rule takes with its singular ends.
        """
        other = self.turning_point(amplitude)
        if not np.isfinite(other):
            return np.nan
        nodes = np.cos(np.pi * (np.arange(_QUADRATURE) + 0.5) / _QUADRATURE)
        middle, half = (amplitude + other) / 2, (amplitude - other) / 2
        gap = self.energy(amplitude) - self.energy(middle + half * nodes)
        # sqrt(1 - x2) over the speed is smooth, and its mean over the nodes the integral over pi
        slowness = half**2 * (1 - nodes**2) / (2 * gap)
        return float(1 / np.sqrt(slowness).mean())

    def driven(
        self, frequency: float, force: float, damping: float, periods: int, start=(0.0, 0.0)
    ) -> np.ndarray:
        """Displacement over the last period of a time integration, 200 instants.

        Parameters
        ----------
        frequency : float
            Of the force, rad/s.
        force : float
            Amplitude of a cosine.
        damping : float
            Of the speed, 1/s.
        periods : int
        start : tuple of float
            Displacement and speed.
        """

        def rate(time, state):
            load = force * np.cos(frequency * time)
            return state[1], load - damping * state[1] - self.force(state[0])

        end = 2 * np.pi * periods / frequency
        instants = end - 2 * np.pi / frequency * (1 - np.arange(200) / 200)
        found = solve_ivp(
            rate,
            (0, end),
            start,
            "DOP853",
            instants,
            rtol=1e-9,
            atol=1e-12 * abs(self._size(force)),
        )
        return found.y[0]

    def _size(self, force: float) -> float:
        return force / self.coefficients[0] or 1.0
