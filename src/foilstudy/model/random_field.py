"""Smooth random fields on a cylinder that do not know of any mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_CUT = 5.0
"""Wave number times length beyond which a mode is left out: its amplitude is below 4e-6."""


@dataclass(frozen=True, eq=False)
class SmoothField:
    """Stationary Gaussian vector field of unit variance per component, periodic around.

    Its correlation is exp(-r^2 / (4 length^2)) at the distance r, that of white noise filtered with
    a Gaussian of standard deviation `length`. The field is a Fourier series with random
    coefficients, of twice the height along, lest the two ends be correlated; so the same
    coefficients give the same field on every mesh.

    Attributes
    ----------
    around, along : ndarray
        Wave numbers of the cosines (the sines follow), 1/m.
    coefficients : ndarray, shape (3, 2 len(along), 2 len(around))
    """

    around: np.ndarray
    along: np.ndarray
    coefficients: np.ndarray

    @classmethod
    def drawn(
        cls, rng: np.random.Generator, circumference: float, height: float, length: float
    ) -> SmoothField:
        """Draw a field; lengths in m.

        The number of random numbers depends on the three lengths alone.
        """
        period = np.array([circumference, 2 * height])
        counts = np.ceil(_CUT / length * period / (2 * np.pi)).astype(int) + 1
        around, along = (2 * np.pi * np.arange(n) / p for n, p in zip(counts, period))
        power = np.exp(-(length**2) * (along[:, None] ** 2 + around**2))
        # a cosine and a sine each stand for the wave number and its negative
        power[1:] *= 2
        power[:, 1:] *= 2
        amplitude = np.sqrt(power / power.sum())
        coefficients = np.tile(amplitude, (2, 2)) * rng.standard_normal(
            (3, 2 * along.size, 2 * around.size)
        )
        return cls(around, along, coefficients)

    def __call__(self, around: np.ndarray, along: np.ndarray) -> np.ndarray:
        """Values on the grid of two coordinate axes, m, shape (3, len(along), len(around))."""
        return _waves(self.along, along) @ self.coefficients @ _waves(self.around, around).T


def _waves(numbers: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Cosines and sines, shape (len(x), 2 len(numbers))."""
    phase = np.multiply.outer(x, numbers)
    return np.concatenate([np.cos(phase), np.sin(phase)], axis=1)
