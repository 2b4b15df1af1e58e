"""Random superposition of classical axial buckling modes."""

from __future__ import annotations

import numpy as np

from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.patch import Patch, cylinder_control_points

_MODES = 40
"""Buckling modes superposed: enough for the sum to be close to Gaussian."""


def deviation(
    patch: Patch, foil: Foil, imperfection: Imperfection, rng: np.random.Generator
) -> np.ndarray:
    """See `Deviation`; radial."""
    perfect = cylinder_control_points(patch, foil.diameter)
    angle = np.arctan2(perfect[1], perfect[0])
    radial = _radial(patch, rng, foil)
    return np.stack([radial * np.cos(angle), radial * np.sin(angle), np.zeros_like(radial)])


def _radial(patch: Patch, rng: np.random.Generator, foil: Foil) -> np.ndarray:
    """Random unit-variance sum of modes near the Koiter circle, radial, shape (rows, columns).

    Classical axial buckling of a cylinder (Timoshenko and Gere, Theory of Elastic Stability): the
    mode sin(p z) cos(q R theta + phase) has the critical stress sigma/sigma_cl = (s + 1/s)/2 with
    s = (p^2 + q^2)^2 R t / (p^2 sqrt(12 (1 - nu^2))); s = 1 is the Koiter circle, on which all
    modes share the classical stress. The modes nearest to it are superposed.
    """
    radius, nu = 0.5 * foil.diameter, foil.material.poisson_ratio
    koiter = np.sqrt(12 * (1 - nu**2)) / (radius * foil.thickness)
    m, n = np.meshgrid(
        np.arange(1, patch.elements_along // 2), np.arange(2, patch.elements_around // 2)
    )
    p, q = m * np.pi / foil.reference_height, n / radius
    s = (p**2 + q**2) ** 2 / (p**2 * koiter)
    ratio = (0.5 * (s + 1 / s)).ravel()
    chosen = np.argsort(ratio, kind="stable")[:_MODES]
    z = patch.size_along * (np.arange(patch.rows) - 0.5)
    theta = 2 * np.pi * np.arange(patch.columns) / patch.columns
    radial = np.zeros((patch.rows, patch.columns))
    for k in chosen:
        amplitude, phase = rng.standard_normal(), rng.uniform(0, 2 * np.pi)
        along = np.sin(m.ravel()[k] * np.pi * z / foil.reference_height)
        radial += amplitude * along[:, None] * np.cos(n.ravel()[k] * theta + phase)
    return radial * 2.0 / np.sqrt(_MODES)
