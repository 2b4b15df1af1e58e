"""A crumpled foil as its reduced model."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from foilstudy.measure.dynamics import Damping, ReducedModel

__all__ = ["ReducedFoil"]


@dataclass(frozen=True, eq=False)
class ReducedFoil:
    """The interface dynamic stiffness of `foilstudy.measure.dynamics`.

    Attributes
    ----------
    model : ReducedModel
    damping : Damping
    """

    kind = "foil"
    model: ReducedModel
    damping: Damping
    _last: dict = field(default_factory=dict, init=False, repr=False)
    """Answer by frequencies of the last call, as all runs on a rig ask for the same."""

    def dynamic_stiffness(self, frequencies: np.ndarray) -> np.ndarray:
        """See `Specimen`; up to where the model is valid."""
        from foilstudy.measure.dynamics import interface_dynamic_stiffness

        key = np.asarray(frequencies).tobytes()
        if key not in self._last:
            self._last.clear()
            self._last[key] = interface_dynamic_stiffness(self.model, frequencies, self.damping)
        return self._last[key]
