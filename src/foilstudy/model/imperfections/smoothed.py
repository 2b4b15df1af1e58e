"""A smooth random field, the same on every mesh that resolves it."""

from __future__ import annotations

import numpy as np

from foilstudy.model.foil import SMOOTH_LENGTH_MIN, Foil, Imperfection
from foilstudy.model.patch import Patch, fitted_control_points
from foilstudy.model.random_field import SmoothField


def deviation(
    patch: Patch, foil: Foil, imperfection: Imperfection, rng: np.random.Generator
) -> np.ndarray:
    """See `Deviation`; the control points follow the same unit-variance field on every mesh.

    Within about one length of a ring it falls to zero with its slope, as the ring rows stay
    perfect: cut off there, it would have a step whose slope depends on the mesh.

    Raises
    ------
    ValueError
        If the mesh is too coarse for the length.
    """
    length = imperfection.correlation_length
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
