"""Mass scalings of the relaxation: one file each, all of the protocol `MassScaling`."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from foilstudy.solve.problem import Problem

__all__ = ["MassScaling", "Mass"]


class Mass(Protocol):
    """A fictitious mass matrix of the free control points, for a pseudo-time step of 1."""

    def velocity(self, momentum: np.ndarray) -> np.ndarray:
        """Solve M v = momentum; arrays of shape (3, free rows, columns).

        The result is good until the next call.
        """
        ...


class MassScaling(Protocol):
    """Chooses the fictitious mass of a sheet."""

    def start(self, problem: Problem) -> Mass:
        """The mass for a problem."""
        ...
