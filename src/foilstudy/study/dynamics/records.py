"""What the records of the dynamics study say."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.study.dynamics.plan import Model
from foilstudy.study.kernel.plan import Results

METHODS = {
    "guyan": "Guyan",
    "craig_bampton": "Craig-Bampton",
    "hintz_herting": "Hintz-Herting",
    "rational_krylov": "rational Krylov",
}


@dataclass(frozen=True)
class Row:
    """One reduction of one model.

    Attributes
    ----------
    method : str
        Key of `METHODS`.
    order : float
        Cut-off (Hz), or tolerance of the Krylov reduction.
    size : int
        Coordinates of the reduced model.
    seconds, peak_memory_mb : float
        Processor time and memory of the reduction.
    estimate : float
        Own estimate of the largest relative error.
    errors : ndarray, shape (3 definitions, frequencies)
        True relative errors, the worse of axial and radial.
    """

    method: str
    order: float
    size: int
    seconds: float
    peak_memory_mb: float
    estimate: float
    valid_to_hz: float
    errors: np.ndarray

    @property
    def error(self) -> float:
        """Largest error of all definitions and frequencies."""
        return float(self.errors.max())


def succeeded(study: Results, model: Model, method: str | None = None) -> list[Row]:
    """Reductions of a model that succeeded, all or of one method, by rising cost."""
    found = [
        Row(**(row | {"errors": np.array([list(e) for e in row["errors"]], float)}))
        for row in study["charts"][model]["rows"]
        if "failed" not in row and method in (None, row["method"])
    ]
    return sorted(found, key=lambda row: row.seconds)
