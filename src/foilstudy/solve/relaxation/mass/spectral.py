"""Spectral mass scaling: a mass that bounds the stiffness of the sheet at every wavelength.

M = (s/4) (C_m L + D_b L^2) on the control grid, with L the discrete Laplacian (Dirichlet rows
at the rings), C_m = E t/(1 - nu^2) and D_b = E t^3/(12 (1 - nu^2)), bounds a quarter of the
stiffness of every membrane and bending wave, so that the pseudo-time step 1 is stable whatever the
mesh. A Fourier transform around makes M a pentadiagonal matrix along the height for every wave
number, which is factored once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from foilstudy.linalg.fourier import row_transform
from foilstudy.model.patch import RING_ROWS
from foilstudy.model.shell.section import Section
from foilstudy.solve.problem import Problem


@njit(cache=True, fastmath=True, error_model="numpy")
def _solve_pentadiagonal(inverse_pivot, first, second, rhs):
    """In-place L D L^T solution; every array is (.., rows, columns), one system per column.

    `rhs` has shape (3, rows, 2 * wave numbers): real and imaginary parts as separate columns. The
    three components go together, so that the factors are read once.
    """
    rows, columns = rhs.shape[1], rhs.shape[2]
    for c in range(3):
        y = rhs[c]
        for k in range(columns):
            y[1, k] -= first[1, k] * y[0, k]
    for j in range(2, rows):
        for c in range(3):
            y = rhs[c]
            for k in range(columns):
                y[j, k] -= first[j, k] * y[j - 1, k] + second[j, k] * y[j - 2, k]
    for c in range(3):
        y = rhs[c]
        for k in range(columns):
            y[rows - 1, k] *= inverse_pivot[rows - 1, k]
        for k in range(columns):
            y[rows - 2, k] = (
                y[rows - 2, k] * inverse_pivot[rows - 2, k] - first[rows - 1, k] * y[rows - 1, k]
            )
    for back in range(2, rows):
        j = rows - 1 - back
        for c in range(3):
            y = rhs[c]
            for k in range(columns):
                y[j, k] = (
                    y[j, k] * inverse_pivot[j, k]
                    - first[j + 1, k] * y[j + 1, k]
                    - second[j + 2, k] * y[j + 2, k]
                )


@dataclass(frozen=True)
class SpectralMassScaling:
    """Spectral mass of a sheet between two clamped rings.

    Attributes
    ----------
    safety : float
        The factor s. The elastic stiffness of the undeformed sheet needs 1.01 to 1.2; folds
        stiffen it: at 1.05 sheets with 92 % overlength became unstable, at 1.3 none did.
    single : bool
        Whether the mass is inverted in single precision: faster, but rounding errors then decide in
        which of many equilibria a sheet comes to rest, which are others on another machine.
    """

    kind = "spectral"
    safety: float = 1.5
    single: bool = False

    def start(self, problem: Problem) -> SpectralMass:
        """See `MassScaling`; of the terms it knows the shell alone."""
        return SpectralMass(problem.whole.section, self)


class SpectralMass:
    """The factored spectral mass of one section."""

    def __init__(self, section: Section, scaling: SpectralMassScaling):
        patch, material = section.patch, section.law.material
        h1, h2 = patch.size_around, patch.size_along
        membrane = material.youngs_modulus * section.thickness / (1 - material.poisson_ratio**2)
        membrane *= section.stiffest
        bending = membrane * section.thickest**2 / 12
        rows = patch.rows - 2 * RING_ROWS
        self._transform = row_transform((3, rows, patch.columns), scaling.single)
        wave = 2 * np.pi * np.arange(patch.columns // 2 + 1) / patch.columns
        around = 2 - 2 * np.cos(wave)
        area = h1 * h2
        # the Laplacian per area along the height is tridiagonal, (2 + around) on the diagonal
        diagonal = around / h1**2 + 2 / h2**2
        off = -1 / h2**2
        mass = np.zeros((3, rows, wave.size))  # diagonal, first and second off-diagonal
        mass[0] = membrane * diagonal + bending * (diagonal**2 + 2 * off**2)
        mass[0, [0, -1]] -= bending * off**2
        mass[1] = membrane * off + bending * 2 * diagonal * off
        mass[2] = bending * off**2
        # the transforms there and back multiply by the number of columns
        self._factor(0.25 * scaling.safety * area * patch.columns * mass)

    def _factor(self, mass: np.ndarray) -> None:
        _, rows, waves = mass.shape
        pivot = np.empty((rows, waves))
        first = np.zeros((rows, waves))
        second = np.zeros((rows, waves))
        for j in range(rows):
            pivot[j] = mass[0, j]
            coupling = mass[1, j].copy()
            if j >= 2:
                second[j] = mass[2, j] / pivot[j - 2]
                coupling -= second[j] * pivot[j - 2] * first[j - 1]
                pivot[j] -= second[j] ** 2 * pivot[j - 2]
            if j >= 1:
                first[j] = coupling / pivot[j - 1]
                pivot[j] -= first[j] ** 2 * pivot[j - 1]
        interleave = np.repeat(np.arange(waves), 2)
        dtype = self._transform.real.dtype
        self._factors = tuple(
            np.ascontiguousarray(part[:, interleave], dtype) for part in (1 / pivot, first, second)
        )

    def velocity(self, momentum: np.ndarray) -> np.ndarray:
        """See `Mass`; good until the next call."""
        transform = self._transform
        with np.errstate(over="ignore"):  # a motion that diverges is seen by its energy
            transform.real[:] = momentum
        transform.forward()
        _solve_pentadiagonal(*self._factors, transform.spectrum.view(transform.real.dtype))
        transform.backward()
        return transform.real
