"""The imperfect cylinder, stress-free, from an independent random stream per realisation."""

from __future__ import annotations

import numpy as np

from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.imperfections import IMPERFECTIONS
from foilstudy.model.patch import RING_ROWS, Patch, cylinder_control_points


def imperfect_cylinder(patch: Patch, foil: Foil, imperfection: Imperfection) -> np.ndarray:
    """Control points of the imperfect, stress-free cylinder; the two ring rows stay perfect.

    Parameters
    ----------
    patch : Patch
    foil : Foil
    imperfection : Imperfection

    Returns
    -------
    ndarray, shape (3, rows, columns)
        m.

    Raises
    ------
    ValueError
        If there is no such imperfection, or the mesh cannot follow it.
    """
    return cylinder_control_points(patch, foil.diameter) + deviation(patch, foil, imperfection)


def deviation(patch: Patch, foil: Foil, imperfection: Imperfection) -> np.ndarray:
    """What an imperfection adds to the perfect cylinder, shape (3, rows, columns), m."""
    key = np.random.SeedSequence(list(imperfection.stream(foil)))
    rng = np.random.Generator(np.random.PCG64(key))
    unit = np.zeros(patch.shape)
    unit[:] = IMPERFECTIONS[imperfection.kind](patch, foil, imperfection, rng)
    unit[:, :RING_ROWS] = 0.0
    unit[:, -RING_ROWS:] = 0.0
    return imperfection.amplitude * unit
