"""Selective mass scaling: mass against the motion of neighbours relative to each other.

After Olovsson, Simonsson and Unosson (2005). The mass beta m_e (3, -1, -1, -1)/12 between the four
corners of every cell of the control net does not act on a translation of the cell, so that long
waves keep the physical mass while short ones become slow. It couples all control points; as
published the momentum is solved for by conjugate gradients, which begin with the last velocity.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse
from numba import njit

from foilstudy.base.ranges import require_number
from foilstudy.linalg import SolveError
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.mass.physical import PhysicalSheet

# No fast mathematics here: a sum over arrays has one order, and what is no number is seen.


@njit(cache=True, error_model="numpy")
def _dot(a, b):
    total = 0.0
    for c in range(a.shape[0]):
        for j in range(a.shape[1]):
            for i in range(a.shape[2]):
                total += a[c, j, i] * b[c, j, i]
    return total


@njit(cache=True, error_model="numpy")
def _apply(lumped, added, v, out):
    """out <- M v; a corner is in four cells, with whose corners it shares sides or diagonals."""
    _, rows, columns = v.shape
    for c in range(3):
        for j in range(rows):
            for i in range(columns):
                left, right = (i - 1) % columns, (i + 1) % columns
                sides = v[c, j, left] + v[c, j, right]
                diagonals = 0.0
                if j > 0:
                    sides += v[c, j - 1, i]
                    diagonals += v[c, j - 1, left] + v[c, j - 1, right]
                if j < rows - 1:
                    sides += v[c, j + 1, i]
                    diagonals += v[c, j + 1, left] + v[c, j + 1, right]
                relative = v[c, j, i] - sides / 6.0 - diagonals / 12.0
                out[c, j, i] = lumped[j, i] * v[c, j, i] + added * relative


@njit(cache=True, error_model="numpy")
def _conjugate_gradients(lumped, added, momentum, velocity, tolerance, iterations_max):
    """Improve the velocity until |M v - p| <= tolerance |p|; iterations and the share left.

    Preconditioned by the diagonal.
    """
    shape = velocity.shape
    residual, image, search = np.empty(shape), np.empty(shape), np.zeros(shape)
    _apply(lumped, added, velocity, image)
    residual[:] = momentum - image
    size = np.sqrt(_dot(momentum, momentum))
    if size == 0.0:
        velocity[:] = 0.0
        return 0, 0.0
    before = 1.0
    for iteration in range(iterations_max + 1):
        left = np.sqrt(_dot(residual, residual)) / size
        if left <= tolerance or iteration == iterations_max or not np.isfinite(left):
            break
        image[:] = residual / (lumped + added)
        now = _dot(residual, image)
        share = now / before if iteration > 0 else 0.0
        search[:] = image + share * search
        _apply(lumped, added, search, image)
        length = now / _dot(search, image)
        velocity += length * search
        residual -= length * image
        before = now
    return iteration, left


@dataclass(frozen=True)
class SelectiveMassScaling:
    """Physical mass with off-diagonal terms, solved iteratively.

    M = (m + beta sum_e m_e (3, -1, -1, -1)/12)/(F dt)^2, m_e the mean mass of an element and dt the
    largest stable step of the undeformed sheet with this mass. The larger beta, the longer dt; the
    mass comes to resemble a Laplacian, as the membrane part of the spectral one is, and takes more
    iterations.

    Attributes
    ----------
    beta : float
        0 is no mass scaling.
    step_factor : float
        The factor F: 1 is the limit of the undeformed sheet, which folds lower.
    tolerance : float
        Largest norm of M v - p over that of p.
    iterations_max : int
        Of one solution; a relaxation ends as ``diverged`` where they are not enough.
    """

    kind = "selective"
    beta: float = 100.0
    step_factor: float = 0.8
    tolerance: float = 1e-6
    iterations_max: int = 500

    def __post_init__(self):
        require_number("beta of the selective mass", self.beta, least=0)
        require_number("step factor of the selective mass", self.step_factor, above=0)
        require_number("tolerance of the selective mass", self.tolerance, above=0)

    def start(self, problem: Problem) -> SelectiveMass:
        """See `MassScaling`; of the terms it knows the shell alone."""
        return SelectiveMass(PhysicalSheet(problem), self)


class SelectiveMass:
    """The selective mass of one sheet.

    Attributes
    ----------
    time_step : float
        Physical length of a pseudo-time step, s.
    step_gain : float
        Largest stable step over that with the lumped mass alone, of the undeformed sheet.
    iterations : int
        Of all solutions so far.
    """

    def __init__(self, sheet: PhysicalSheet, scaling: SelectiveMassScaling):
        self._lumped, self._added = sheet.masses, scaling.beta * sheet.element_mass
        stable = sheet.stable_step(self.matrix())
        self.time_step = scaling.step_factor * stable
        self.step_gain = stable / sheet.courant_step
        self._lumped = self._lumped / self.time_step**2
        self._added /= self.time_step**2
        self._scaling = scaling
        self._velocity = np.zeros((3, *self._lumped.shape))
        self.iterations = 0

    def matrix(self) -> sparse.csr_matrix:
        """The mass of all components, ordered row, column, component."""
        rows, columns = self._lumped.shape
        along = sparse.diags([1.0, 1.0], [-1, 1], shape=(rows, rows))
        around = sparse.diags([1.0, 1.0], [-1, 1], shape=(columns, columns)).tolil()
        around[0, -1] = around[-1, 0] = 1.0
        whole = sparse.identity(rows * columns)
        sides = sparse.kron(along, sparse.identity(columns))
        sides = sides + sparse.kron(sparse.identity(rows), around)
        relative = whole - sides / 6 - sparse.kron(along, around) / 12
        scalar = sparse.diags(self._lumped.ravel()) + self._added * relative
        return sparse.kron(scalar, sparse.identity(3), format="csr")

    def velocity(self, momentum: np.ndarray) -> np.ndarray:
        """See `Mass`; good until the next call."""
        scaling = self._scaling
        iterations, left = _conjugate_gradients(
            self._lumped, self._added, momentum, self._velocity,
            scaling.tolerance, scaling.iterations_max,
        )  # fmt: skip
        self.iterations += iterations
        if not np.isfinite(left):
            raise SolveError("the momentum of the selective mass was not finite")
        if left > scaling.tolerance:
            raise SolveError(
                f"{iterations} iterations left {left:.1e} of the momentum where the selective mass "
                f"has to be solved to {scaling.tolerance:.1e}; use a smaller beta or more "
                "iterations"
            )
        return self._velocity
