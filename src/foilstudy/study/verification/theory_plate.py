"""Square Kirchhoff plates: deflections and natural frequencies to many digits.

Lengths are in units of the side a, stiffness in units of D = E t^3 / (12 (1 - nu^2)).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.linalg import eigh

from foilstudy.study.verification.spectral import LineBasis

FREE, SIMPLY_SUPPORTED, CLAMPED = 0, 1, 2
"""Order of the zero that a condition puts on the deflection at the edge."""


def simply_supported_deflection(terms: int = 400) -> float:
    """Centre deflection under uniform load, in units of q a^4 / D.

    Levy's single series [S. Timoshenko, S. Woinowsky-Krieger, Theory of Plates and Shells, 2nd ed.,
    1959, art. 30]: 5/384 less 4/pi^5 sum over odd m of
    (-1)^((m-1)/2) / m^5 (2 + alpha tanh alpha) / (2 cosh alpha), alpha = m pi / 2.
    """
    m = np.arange(1, terms, 2)
    alpha = np.minimum(0.5 * np.pi * m, 300.0)  # cosh would overflow where its term is zero
    sign = (-1.0) ** ((m - 1) // 2)
    term = sign / m**5 * (2 + alpha * np.tanh(alpha)) / (2 * np.cosh(alpha))
    return float(5 / 384 - 4 / np.pi**5 * term.sum())


def clamped_deflection(functions: int = 24) -> float:
    """Centre deflection of the clamped plate under uniform load, in units of q a^4 / D.

    Ritz with Legendre polynomials, converged to ten digits. R. L. Taylor and S. Govindjee, Solution
    of clamped rectangular plate problems, Commun. Numer. Meth. Engng 20 (2004) 757-765, give
    0.00126532.
    """
    basis = LineBasis(functions, CLAMPED)
    load, centre = basis.integrals(), basis.middle()
    deflection = np.linalg.solve(_bending(basis, 0.0), np.kron(load, load))
    return float(np.kron(centre, centre) @ deflection)


@lru_cache
def frequencies(
    condition: int, poisson_ratio: float, count: int, functions: int = 24
) -> np.ndarray:
    """Lowest nonzero omega a^2 sqrt(rho t / D) of a plate with four equal edges, ascending.

    Rayleigh-Ritz with Legendre polynomials in both directions, converged to seven digits. For
    simply supported edges they are pi^2 (m^2 + n^2).

    Parameters
    ----------
    condition : int
        `FREE`, `SIMPLY_SUPPORTED` or `CLAMPED`.
    poisson_ratio : float
        Matters for free edges alone.
    count : int
        The three rigid motions of the free plate are not counted.
    """
    basis = LineBasis(functions, condition)
    mass = basis.gram(0, 0)
    rigid = 3 if condition == FREE else 0
    values = eigh(
        _bending(basis, poisson_ratio),
        np.kron(mass, mass),
        eigvals_only=True,
        subset_by_index=(rigid, rigid + count - 1),
    )
    return np.sqrt(values)


def _bending(basis: LineBasis, poisson_ratio: float) -> np.ndarray:
    """w_xx^2 + w_yy^2 + 2 nu w_xx w_yy + 2 (1 - nu) w_xy^2, integrated over the plate."""
    mass, slope = basis.gram(0, 0), basis.gram(1, 1)
    curvature, cross = basis.gram(2, 2), basis.gram(2, 0)
    return (
        np.kron(curvature, mass)
        + np.kron(mass, curvature)
        + poisson_ratio * (np.kron(cross, cross.T) + np.kron(cross.T, cross))
        + 2 * (1 - poisson_ratio) * np.kron(slope, slope)
    )
