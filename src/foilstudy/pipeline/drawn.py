"""Axisymmetric shapes drawn by hand, of a foil between its rings: pleats and concertinas."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.optimize import brentq

from foilstudy.model.foil import Foil
from foilstudy.model.patch import Patch, cylinder_control_points, fitted_control_points
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.pipeline.crumpled import Crumpled

__all__ = ["Concertina", "Meridian", "Pleats", "drawn"]

_POINTS = 20_000
"""Of a meridian, by which it is measured."""


class Meridian(Protocol):
    """A line from ring to ring whose length is that of the foil."""

    def line(self, foil: Foil) -> tuple[np.ndarray, np.ndarray]:
        """Radius and height along it, m; straight up where it meets the rings."""
        ...


@dataclass(frozen=True)
class Pleats:
    """Flat pleats to the inside, as deep as the overlength makes them; the rest is straight.

    Attributes
    ----------
    number : int
        Evenly over the height.
    opening : float
        Height that one takes between its lips, m; a wave of a cosine.
    """

    number: int = 1
    opening: float = 6e-3

    def line(self, foil: Foil) -> tuple[np.ndarray, np.ndarray]:
        """See `Meridian`."""
        height = np.linspace(0, foil.gap_height, _POINTS)
        middles = foil.gap_height * (np.arange(self.number) + 0.5) / self.number
        from_middle = np.abs(height[:, None] - middles).min(axis=1)
        within = from_middle < 0.5 * self.opening
        wave = 0.5 * (1 + np.cos(2 * np.pi * from_middle / self.opening)) * within
        return _deep_enough(foil, wave, height)


@dataclass(frozen=True)
class Concertina:
    """Waves to the inside, all over the height.

    Attributes
    ----------
    waves : int
    """

    waves: int = 6

    def line(self, foil: Foil) -> tuple[np.ndarray, np.ndarray]:
        """See `Meridian`."""
        height = np.linspace(0, foil.gap_height, _POINTS)
        wave = 0.5 * (1 - np.cos(2 * np.pi * self.waves * height / foil.gap_height))

        return _deep_enough(foil, wave, height)


def _deep_enough(foil: Foil, wave: np.ndarray, height: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Radius and height of a meridian that goes in by a multiple of a wave of height one."""

    def surplus(depth: float) -> float:
        return np.hypot(np.diff(depth * wave), np.diff(height)).sum() - foil.reference_height

    depth = brentq(surplus, 0.0, foil.reference_height)
    return 0.5 * foil.diameter - depth * wave, height


def drawn(foil: Foil, patch: Patch, meridian: Meridian) -> Crumpled:
    """A foil in a drawn shape, which came about in no way and is in no equilibrium.

    Parameters
    ----------
    foil : Foil
    patch : Patch
        Of its cylinder.
    meridian : Meridian
    """
    radius, height = meridian.line(foil)
    way = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(radius), np.diff(height)))])

    def surface(around: np.ndarray, along: np.ndarray) -> np.ndarray:
        angle, at = 2 * around / foil.diameter, np.clip(along, 0, way[-1])
        r = np.interp(at, way, radius)
        z = np.interp(at, way, height) + along - at
        return np.stack([r * np.cos(angle), r * np.sin(angle), z])

    points = fitted_control_points(patch, surface)
    reference = cylinder_control_points(patch, foil.diameter)
    return Crumpled(foil, patch, points, reference, Corner())
