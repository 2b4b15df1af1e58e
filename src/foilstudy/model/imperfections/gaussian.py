"""Independent normal offsets of every control point."""

from __future__ import annotations

import numpy as np

from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.patch import Patch


def deviation(
    patch: Patch, foil: Foil, imperfection: Imperfection, rng: np.random.Generator
) -> np.ndarray:
    """See `Deviation`."""
    return rng.standard_normal(patch.shape)
