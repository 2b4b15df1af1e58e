"""Polynomials on an interval whose ends are held, for Ritz solutions to many digits."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import legendre


class LineBasis:
    """Legendre polynomials on (0, length) times a factor that vanishes at both ends.

    Parameters
    ----------
    size : int
        Number of functions.
    zero : int
        Order of the zero at the ends: 0 free, 1 value held, 2 value and slope held.
    points : int, optional
        Gauss points of the integrals; by default enough for products of the functions.
    """

    def __init__(self, size: int, zero: int, length: float = 1.0, points: int | None = None):
        self._length = length
        self._points, self._weights = legendre.leggauss(points or size + 2 * zero + 1)
        edge = np.array([1.0])
        for _ in range(zero):
            edge = legendre.legmul(edge, [2 / 3, 0.0, -2 / 3])  # 1 - x^2
        self._series = [
            np.sqrt(2 * k + 1) * legendre.legmul(edge, np.eye(k + 1)[k]) for k in range(size)
        ]

    def derivative(self, order: int) -> np.ndarray:
        """Derivative of every function at the Gauss points, shape (size, points)."""
        return (2 / self._length) ** order * np.array(
            [legendre.legval(self._points, legendre.legder(s, order)) for s in self._series]
        )

    def weighted(self, order: int) -> np.ndarray:
        """Derivatives times the roots of the Gauss weights: products sum up to integrals."""
        return self.derivative(order) * self.root_weights

    def gram(self, order: int, other: int) -> np.ndarray:
        """Integrals of products of derivatives of these orders, shape (size, size)."""
        return self.weighted(order) @ self.weighted(other).T

    def integrals(self) -> np.ndarray:
        """Integrals of the functions, shape (size,)."""
        return self.derivative(0) @ self.root_weights**2

    @property
    def points(self) -> np.ndarray:
        """Gauss points on (0, length)."""
        return 0.5 * self._length * (1 + self._points)

    @property
    def root_weights(self) -> np.ndarray:
        """Roots of the Gauss weights."""
        return np.sqrt(0.5 * self._length * self._weights)

    def end(self) -> np.ndarray:
        """Values at the end of the interval, shape (size,)."""
        return np.array([legendre.legval(1.0, series) for series in self._series])

    def middle(self) -> np.ndarray:
        """Values half-way, shape (size,)."""
        return np.array([legendre.legval(0.0, series) for series in self._series])
