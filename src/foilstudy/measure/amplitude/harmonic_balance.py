"""Periodic vibrations of a driven oscillator by harmonic balance.

The displacement is a truncated Fourier series; its coefficients make the residual of the equation
of motion vanish in the same harmonics, the force of the spring being evaluated in time and
transformed. Along the response curve the frequency is an unknown, too, and steps are measured by
arc length, so that the curve may fold back.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.measure.amplitude.oscillator import Oscillator

_ITERATIONS, _TOLERANCE = 20, 1e-11
_OVERSAMPLING = 8
"""Instants of a period over harmonics: a cube of the highest one is not aliased into them."""


@dataclass(frozen=True, eq=False)
class Response:
    """Periodic vibrations along a curve.

    Attributes
    ----------
    frequency : ndarray, shape (points,)
        Of the force, rad/s.
    coefficients : ndarray, shape (points, 2 harmonics + 1)
        Mean, cosines, sines of the displacement.
    status : str
        ``converged``, or ``not_converged`` where the curve ends before its frequency.
    """

    frequency: np.ndarray
    coefficients: np.ndarray
    status: str

    def series(self, instants: int = 200) -> np.ndarray:
        """Displacement over a period from the crest of the force, shape (points, instants)."""
        return self.coefficients @ _basis(self.harmonics, instants)[0].T

    @property
    def harmonics(self) -> int:
        """In the series."""
        return (self.coefficients.shape[1] - 1) // 2

    @property
    def amplitude(self) -> np.ndarray:
        """Half of the way between the turning points."""
        series = self.series()
        return np.ptp(series, axis=1) / 2


@dataclass(frozen=True)
class HarmonicBalance:
    """An oscillator with damping under a force that is a cosine.

    Attributes
    ----------
    oscillator : Oscillator
    force : float
    damping : float
        Of the speed, 1/s: twice the share of the critical one times the natural frequency.
    harmonics : int
    """

    oscillator: Oscillator
    force: float
    damping: float
    harmonics: int = 7

    def response(
        self, first: float, last: float, step: float = 0.01, points_max: int = 2000
    ) -> Response:
        """Follow the curve of vibrations from one frequency to another.

        Parameters
        ----------
        first, last : float
            rad/s; the curve begins at the vibration next to the linear one.
        step : float
            Longest step, over the natural frequency.
        points_max : int
        """
        way = float(np.sign(last - first))
        size = self.oscillator.frequency
        x = self._corrected(np.append(self._linear(first), first / size), None, 0.0)
        if x is None:
            return Response(np.empty(0), np.empty((0, 2 * self.harmonics + 1)), "not_converged")
        ahead = np.append(np.zeros(x.size - 1), way)
        found, length = [x], step
        while way * (last / size - found[-1][-1]) > 0 and len(found) < points_max:
            ahead = self._ahead(found[-1], ahead)
            for _ in range(12):
                guess = found[-1] + length * ahead
                x = self._corrected(guess, ahead, ahead @ guess)
                if x is not None:
                    break
                length /= 2
            else:
                return self._of(found, "not_converged")
            length = min(1.5 * length, step)
            found.append(x)
        done = way * (last / size - found[-1][-1]) <= 0
        return self._of(found, "converged" if done else "not_converged")

    def _of(self, found: list[np.ndarray], status: str) -> Response:
        every = np.array(found)
        size = self.oscillator.frequency
        return Response(size * every[:, -1], self._scale * every[:, :-1], status)

    @property
    def _scale(self) -> float:
        """Of the displacement: that at resonance without a bend."""
        return self.force / (self.damping * self.oscillator.frequency)

    def _linear(self, frequency: float) -> np.ndarray:
        """Coefficients of the linear vibration, scaled."""
        start = np.zeros(2 * self.harmonics + 1)
        gap = self.oscillator.coefficients[0] - frequency**2
        answer = self.force / (gap + 1j * self.damping * frequency)
        start[1], start[1 + self.harmonics] = answer.real, -answer.imag
        return start / self._scale

    def _residual(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Of all harmonics, over the force, and its derivative by the scaled unknowns."""
        basis, back = _basis(self.harmonics, _OVERSAMPLING * (self.harmonics + 1))
        size, scale, n = self.oscillator.frequency, self._scale, self.harmonics
        c, omega, order = scale * x[:-1], size * x[-1], np.arange(1, n + 1)
        a = basis @ c
        residual = back @ self.oscillator.force(a)
        jacobian = np.zeros((c.size, x.size))
        jacobian[:, :-1] = scale * (back @ (self.oscillator.slope(a)[:, None] * basis))
        cosine, sine = 1 + np.arange(n), 1 + n + np.arange(n)
        inertia, drag = -((order * omega) ** 2), self.damping * order * omega
        for own, other, sign in ((cosine, sine, 1), (sine, cosine, -1)):
            residual[own] += inertia * c[own] + sign * drag * c[other]
            jacobian[own, own] += scale * inertia
            jacobian[own, other] += sign * scale * drag
            turn = -2 * order**2 * omega * c[own] + sign * self.damping * order * c[other]
            jacobian[own, -1] = size * turn
        residual[1] -= self.force
        return residual / self.force, jacobian / self.force

    def _corrected(self, x: np.ndarray, ahead: np.ndarray | None, place: float):
        """The point on the plane across a direction, or at that frequency; None if not found."""
        x = x.copy()
        row = np.append(np.zeros(x.size - 1), 1.0) if ahead is None else ahead
        place = x[-1] if ahead is None else place
        for _ in range(_ITERATIONS):
            residual, jacobian = self._residual(x)
            whole = np.append(residual, row @ x - place)
            if np.abs(whole).max() < _TOLERANCE:
                return x
            x -= np.linalg.solve(np.vstack([jacobian, row]), whole)
            if not np.isfinite(x).all():
                return None
        return None

    def _ahead(self, x: np.ndarray, last: np.ndarray) -> np.ndarray:
        """Unit tangent of the curve, onwards from the last one."""
        _, jacobian = self._residual(x)
        right = np.append(np.zeros(x.size - 1), 1.0)
        ahead = np.linalg.solve(np.vstack([jacobian, last]), right)
        return ahead / np.linalg.norm(ahead)


def _basis(harmonics: int, instants: int) -> tuple[np.ndarray, np.ndarray]:
    """Series at instants of a period per coefficient, and coefficients per values at instants."""
    phase = 2 * np.pi * np.outer(np.arange(instants) / instants, np.arange(1, harmonics + 1))
    basis = np.hstack([np.ones((instants, 1)), np.cos(phase), np.sin(phase)])
    back = 2 * basis.T / instants
    back[0] /= 2
    return basis, back
