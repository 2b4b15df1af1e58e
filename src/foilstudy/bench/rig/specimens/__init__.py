"""Specimens between the two frames."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from foilstudy.base.registry import Choice, Registry

__all__ = ["SPECIMENS", "Specimen"]


class Specimen(Protocol):
    """Anything between the two rings that is linear; `NonlinearAxial` adds a force to one."""

    def dynamic_stiffness(self, frequencies: np.ndarray) -> np.ndarray:
        """On the twelve ring motions, in the order of `foilstudy.measure.stiffness.DOF_NAMES`.

        Parameters
        ----------
        frequencies : ndarray, shape (f,)
            Hz.

        Returns
        -------
        ndarray of complex, shape (f, 12, 12)
        """
        ...


SPECIMENS = Registry(
    "specimen",
    {
        "absent": Choice("bench.rig.specimens.absent:Absent", "nothing between the frames"),
        "spring": Choice(
            "bench.rig.specimens.spring:Spring", "six uncoupled springs with losses, no mass"
        ),
        "foil": Choice(
            "bench.rig.specimens.foil:ReducedFoil", "a crumpled foil as its reduced model"
        ),
        "nonlinear": Choice(
            "bench.rig.specimens.nonlinear:NonlinearAxial",
            "a specimen with a static axial force that is no straight line",
        ),
    },
)
