"""Circular cylinder in Koiter's linear shell theory: frequencies and axial buckling.

Displacements axial U(z) cos(n theta), around V(z) sin(n theta), radial W(z) cos(n theta), outwards
positive. The strains are the linear parts of those of the sheet, changes of the first and second
fundamental forms [W. T. Koiter, A consistent first approximation in the general theory of thin
elastic shells, 1960], with q = n / R:

    e_zz = U'              e_ss = q V + W/R                        2 e_sz = V' - q U
    b_zz = W''             b_ss = -q^2 W - 2 q V/R - W/R^2         2 b_sz = -2 q W' - 2 V'/R

Rotary inertia is left out, as in the mass matrix of the sheet.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag, cholesky, eigh, solve_triangular, svdvals

from foilstudy.model.materials import Material
from foilstudy.study.verification.spectral import LineBasis

CLAMPED, DIAPHRAGM, FREE = (1, 1, 2), (0, 1, 1), (0, 0, 0)
"""Orders of the zeros of axial, circumferential and radial displacement at both edges."""


@dataclass(frozen=True)
class Cylinder:
    """A circular cylinder of foil; lengths in m."""

    radius: float
    length: float
    thickness: float
    material: Material

    def strains(self, n: int, around: float = 1.0, along: float = 1.0) -> np.ndarray:
        """Coefficients of the strains, shape (6, 3, 3): strain, component, derivative in z.

        With stretches `around` and `along` the cylinder is already strained, and these are the
        changes of its material (Green-Lagrange) strains. What the stretches change in bending is
        of order (t/R)^2 and left out.
        """
        q, r = n / self.radius, self.radius
        b = np.zeros((6, 3, 3))
        b[0, 0, 1] = along
        b[1, 1, 0], b[1, 2, 0] = around * q, around / r
        b[2, 0, 0], b[2, 1, 1] = -along * q, around
        b[3, 2, 2] = 1
        b[4, 1, 0], b[4, 2, 0] = -2 * q / r, -(q**2) - 1 / r**2
        b[5, 1, 1], b[5, 2, 1] = -2 / r, -2 * q
        return b

    def law(self) -> np.ndarray:
        """Plane stress, membrane then bending, shape (6, 6); N/m and N m."""
        nu, e, t = self.material.poisson_ratio, self.material.youngs_modulus, self.thickness
        plane = np.array([[1, nu, 0], [nu, 1, 0], [0, 0, 0.5 * (1 - nu)]]) / (1 - nu**2)
        return block_diag(e * t * plane, e * t**3 / 12 * plane)

    @property
    def mass(self) -> float:
        """Mass per area, kg/m2."""
        return self.material.density * self.thickness


def frequencies(
    cylinder: Cylinder, edges: tuple[int, int, int], n: int, count: int = 1, functions: int = 40
) -> np.ndarray:
    """Lowest natural frequencies of circumferential order n.

    Ritz with Legendre polynomials along the height. On foil cylinders (R/t of 200 and 2000,
    L/R = 1.7) 40 functions give seven digits. Frequencies are singular values of the strains of
    all functions: the stiffness matrix, their square, would lose those of inextensional motions.

    Parameters
    ----------
    edges : tuple of int
        `CLAMPED`, `DIAPHRAGM` or `FREE`, both alike.
    count : int
        How many; rigid motions count.

    Returns
    -------
    ndarray, shape (count,)
        Hz, ascending.
    """
    points = functions + 5  # enough to integrate all products exactly
    bases = [LineBasis(functions, zero, cylinder.length, points) for zero in edges]
    root = cholesky(cylinder.law())  # upper: law = root^T root
    columns = []
    for component, basis in enumerate(bases):
        derivatives = np.stack([basis.weighted(order) for order in range(3)])
        strains = np.einsum("sk,kfg->sgf", cylinder.strains(n)[:, component], derivatives)
        stresses = np.einsum("rs,sgf->rgf", root, strains).reshape(-1, functions)
        # functions that are orthonormal in mass
        mass_root = np.linalg.qr(np.sqrt(cylinder.mass) * derivatives[0].T, mode="r")
        columns.append(solve_triangular(mass_root, stresses.T, trans="T").T)
    values = svdvals(np.concatenate(columns, axis=1))
    return values[::-1][:count] / (2 * np.pi)


def classical_buckling_stress(cylinder: Cylinder) -> float:
    """Classical stress of axial buckling, Pa.

    E t / (R sqrt(3 (1 - nu^2))) [S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd
    ed., 1961, art. 11.1].
    """
    e, nu = cylinder.material.youngs_modulus, cylinder.material.poisson_ratio
    return e * cylinder.thickness / (cylinder.radius * np.sqrt(3 * (1 - nu**2)))


def buckling_strain(cylinder: Cylinder, m: int, n: int) -> float:
    """Axial shortening per length at which the mode cos(m pi z / L) cos(n theta) grows.

    Edges slide in planes normal to the axis, so that the state before buckling is uniform: axial
    strain -x, around +nu x. The tangent is linear in x: (K_0 + x K_1) phi = 0, with the stress
    -E t x |u_,z|^2 / 2 on all three components and the change of the strains by the stretches.
    """
    p, nu = m * np.pi / cylinder.length, cylinder.material.poisson_ratio
    tension = -cylinder.material.youngs_modulus * cylinder.thickness * p**2 * np.eye(3)
    unstrained = _wave_stiffness(cylinder, cylinder.strains(n), p)
    # the tangent's strain part is quadratic in the stretches: a central difference is exact
    step = 1e-3
    ahead, behind = (
        _wave_stiffness(cylinder, cylinder.strains(n, 1 + nu * x, 1 - x), p) for x in (step, -step)
    )
    slope = (ahead - behind) / (2 * step) + tension
    growth = eigh(slope, unstrained, eigvals_only=True)
    return float(-1 / growth[0])


def _wave_stiffness(cylinder: Cylinder, strains: np.ndarray, p: float) -> np.ndarray:
    """Stiffness of U, V, W that go like exp(i p z), per area, Hermitian (3, 3)."""
    wave = strains @ (1j * p) ** np.arange(3)
    return wave.conj().T @ cylinder.law() @ wave


def pinched_deflection(cylinder: Cylinder, terms: int = 600) -> float:
    """Deflection under one of two opposite unit forces at mid-length, ends on diaphragms, m/N.

    Double Fourier series, m odd and n even, each term one solution of the 3 x 3 equations. Waves
    shorter than those of the last term bend a flat plate, so that their sum is an integral.
    """
    shortest = terms / cylinder.radius
    total = 0.0
    for n in range(0, terms + 1, 2):
        q = n / cylinder.radius
        last = np.sqrt(shortest**2 - q**2) * cylinder.length / np.pi
        p = np.arange(1, last + 1, 2) * np.pi / cylinder.length
        wave = np.einsum("scd,pd->psc", cylinder.strains(n), (1j * p[:, None]) ** np.arange(3))
        stiffness = np.einsum("psc,st,ptd->pcd", wave.conj(), cylinder.law(), wave)
        total += np.linalg.inv(stiffness)[:, 2, 2].real.sum() / (2 if n == 0 else 1)
    # one term per 2 pi / L times 2 / R of the quadrant of wave numbers, 1 / (D k^4) each
    tail = np.pi / (4 * shortest**2) * cylinder.length * cylinder.radius / (4 * np.pi)
    total += tail / cylinder.law()[3, 3]
    return float(4 * total / (np.pi * cylinder.radius * cylinder.length))
