"""The foil's own mass and stiffness between the rings, for masses that begin from the physical one.

In pseudo-time a step is 1 long, so that a mass matrix is the physical one over the square of the
time step. Scaling all masses by f^2 and taking steps f times as long therefore leaves every step of
the motion as it is: to a sheet that knows no rates it is the same as closing the gap f times as
fast.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg import largest_eigenvalue
from foilstudy.model.patch import RING_ROWS
from foilstudy.model.shell.tangent import mass_matrix
from foilstudy.solve.problem import Problem

__all__ = ["LumpedMass", "PhysicalSheet"]

_FREE = slice(RING_ROWS, -RING_ROWS)


class PhysicalSheet:
    """Mass and stiffness of the free control points of a problem's shell in its stress-free shape.

    Parameters
    ----------
    problem : Problem

    Attributes
    ----------
    element_mass : float
        Mean mass of an element, kg.
    """

    def __init__(self, problem: Problem):
        self._shell = problem.whole
        self._element_masses = problem.whole.section.masses
        self.element_mass = float(self._element_masses.mean())

    @cached_property
    def masses(self) -> np.ndarray:
        """Lumped masses: row sums of the consistent mass, shape (free rows, columns), kg."""
        patch = self._shell.patch
        lumped = mass_matrix(patch, self._element_masses).sum(axis=1)
        return np.asarray(lumped).reshape(patch.rows, patch.columns, 3)[_FREE, :, 0].copy()

    @cached_property
    def stiffness(self) -> sparse.csr_matrix:
        """Tangent of the free control points, ordered row, column, component, N/m."""
        owned = RING_ROWS * 3 * self._shell.patch.columns
        return self._shell.tangent()[owned:-owned, owned:-owned].tocsr()

    @cached_property
    def courant_step(self) -> float:
        """Largest stable time step with the lumped mass, 2 over the largest frequency, s."""
        return self.stable_step(sparse.diags(np.repeat(self.masses, 3)))

    def stable_step(self, mass: sparse.spmatrix) -> float:
        """The same with another mass matrix, kg."""
        return 2.0 / np.sqrt(largest_eigenvalue(self.stiffness, mass.tocsr()))


@dataclass(eq=False)
class LumpedMass:
    """A mass of each free control point by itself, at work.

    Attributes
    ----------
    masses : ndarray, shape (free rows, columns)
        In kg.
    time_step : float
        Physical length of a pseudo-time step, s.
    added : float
        What was added to the physical mass of all free control points, over that mass: dM/M.
    """

    masses: np.ndarray
    time_step: float
    added: float = 0.0

    def __post_init__(self):
        self._inverse = self.time_step**2 / self.masses
        self._velocity = np.empty((3, *self.masses.shape))

    def velocity(self, momentum: np.ndarray) -> np.ndarray:
        """See `Mass`; good until the next call."""
        return np.multiply(self._inverse, momentum, out=self._velocity)
