"""Random imperfections of the stress-free cylinder, one independent stream per realisation."""

from __future__ import annotations

import numpy as np

from foilstudy.model.foil import SMOOTH_LENGTH_MIN, Foil, Imperfection
from foilstudy.model.patch import RING_ROWS, Patch, fitted_control_points
from foilstudy.model.random_field import SmoothField

_MODES = 40
"""Buckling modes superposed: enough for the sum to be close to Gaussian."""


def imperfect_cylinder(
    patch: Patch, perfect: np.ndarray, foil: Foil, imperfection: Imperfection
) -> np.ndarray:
    """Control points of the imperfect, stress-free cylinder; the two ring rows stay perfect.

    Parameters
    ----------
    patch : Patch
    perfect : ndarray, shape (3, rows, columns)
        Control points of the perfect cylinder, m.
    foil : Foil
    imperfection : Imperfection

    Returns
    -------
    ndarray, shape (3, rows, columns)
    """
    rng = np.random.Generator(np.random.PCG64(np.random.SeedSequence(list(imperfection.stream))))
    deviation = np.zeros(patch.shape)
    if imperfection.kind == "gaussian":
        deviation[:] = rng.standard_normal(patch.shape)
    elif imperfection.kind == "smoothed":
        deviation[:] = _smoothed(patch, rng, foil, imperfection.correlation_length)
    elif imperfection.kind == "buckling_modes":
        angle = np.arctan2(perfect[1], perfect[0])
        radial = _buckling_modes(patch, rng, foil)
        deviation[0], deviation[1] = radial * np.cos(angle), radial * np.sin(angle)
    else:
        raise ValueError(f"unknown imperfection kind {imperfection.kind!r}")
    deviation[:, :RING_ROWS] = 0.0
    deviation[:, -RING_ROWS:] = 0.0
    return perfect + imperfection.amplitude * deviation


def _smoothed(patch: Patch, rng: np.random.Generator, foil: Foil, length: float) -> np.ndarray:
    """Control points of the same smooth unit-variance field on every mesh that resolves it.

    Within about one length of a ring it falls to zero with its slope, as the ring rows stay
    perfect: cut off there, it would have a step whose slope depends on the mesh.

    Raises
    ------
    ValueError
        If the mesh is too coarse for the length.
    """
    coarsest = max(patch.size_around, patch.size_along)
    if length < SMOOTH_LENGTH_MIN * coarsest:
        raise ValueError(
            f"a correlation length of {1e3 * length:g} mm needs elements of at most "
            f"{1e3 * length / SMOOTH_LENGTH_MIN:.3g} mm, not {1e3 * coarsest:.3g} mm; take a finer "
            "mesh or kind gaussian"
        )
    field = SmoothField.drawn(rng, np.pi * foil.diameter, foil.reference_height, length)
    height = foil.reference_height

    def surface(around: np.ndarray, along: np.ndarray) -> np.ndarray:
        z = along[:, 0]
        window = (1 - np.exp(-((z / length) ** 2))) * (1 - np.exp(-(((height - z) / length) ** 2)))
        return window[:, None] * field(around[0], z)

    return fitted_control_points(patch, surface)


def _buckling_modes(patch: Patch, rng: np.random.Generator, foil: Foil) -> np.ndarray:
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
