"""Random imperfections of the stress-free cylinder: one file each, protocol `Deviation`."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from foilstudy.base.registry import Choice, Registry
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.patch import Patch

__all__ = ["IMPERFECTIONS", "Deviation"]


class Deviation(Protocol):
    """A kind of deviation."""

    def __call__(
        self, patch: Patch, foil: Foil, imperfection: Imperfection, rng: np.random.Generator
    ) -> np.ndarray:
        """Deviation of the control points of unit amplitude, shape (3, rows, columns)."""
        ...


IMPERFECTIONS = Registry(
    "imperfection",
    {
        "gaussian": Choice("model.imperfections.gaussian:deviation", "independent normal offsets"),
        "smoothed": Choice(
            "model.imperfections.smoothed:deviation", "the same with a correlation length"
        ),
        "buckling_modes": Choice(
            "model.imperfections.buckling_modes:deviation",
            "random combination of classical buckling modes",
        ),
    },
)
