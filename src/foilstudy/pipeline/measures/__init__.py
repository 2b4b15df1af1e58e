"""Ways to measure the stiffness of a crumple: one file each, protocol `StiffnessMeasure`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from foilstudy.base.registry import Choice, Registry
from foilstudy.pipeline.crumpled import Crumpled

__all__ = ["STIFFNESS_MEASURES", "MeasuredStiffness", "StiffnessMeasure"]


@dataclass(frozen=True, eq=False)
class MeasuredStiffness:
    """What a measure says of a crumple.

    Attributes
    ----------
    stiffness : ndarray, shape (2,)
        Axial and radial, N/m; NaN where the measure has none.
    message : str
        Why it has none, or what speaks against those that it has; else empty.
    levels : tuple of ndarray
        By the sizes of a probe in turn, the last of which is the stiffness; empty for others.
    """

    stiffness: np.ndarray
    message: str = ""
    levels: tuple[np.ndarray, ...] = ()

    def __repr__(self) -> str:
        axial, radial = self.stiffness
        why = f"; {self.message}" if self.message else ""
        return f"<MeasuredStiffness: axial, radial {axial:.4g}, {radial:.4g} N/m{why}>"


class StiffnessMeasure(Protocol):
    """A way to an axial and a radial stiffness; a frozen specification."""

    def of(self, crumpled: Crumpled) -> MeasuredStiffness:
        """The stiffness of a crumple; never raises where there is none, the message says why."""
        ...


STIFFNESS_MEASURES = Registry(
    "stiffness measure",
    {
        "tangent": Choice(
            "pipeline.measures.tangent:Tangent",
            "from the derivative of the forces, free of stress or with it",
        ),
        "displacement_probe": Choice(
            "pipeline.measures.displacement_probe:DisplacementProbe",
            "from the forces on a ring that is moved there and back; depends on how far",
        ),
        "force_probe": Choice(
            "pipeline.measures.force_probe:ForceProbe",
            "from the way of a ring that is pulled, as published; depends on the force, which may "
            "take soft foil far from its shape",
        ),
        "reaction_slope": Choice(
            "pipeline.measures.reaction_slope:ReactionSlope",
            "from the force on the ring while the foil is crumpled: spurious, it depends on the "
            "loading rate, may be negative, and has no radial part",
        ),
    },
)
