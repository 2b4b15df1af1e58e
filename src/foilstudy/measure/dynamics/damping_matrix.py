"""Damping of a reduced model as a matrix, for solvers that know M, C and K only."""

from __future__ import annotations

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.measure.dynamics.damping import Damping
from foilstudy.measure.dynamics.reduction import ReducedModel


def damping_matrix(model: ReducedModel, damping: Damping) -> np.ndarray:
    """C = sum_j c_j (M phi_j)(M phi_j)^T over the free modes, c_j = 2 zeta_j omega_j.

    E. L. Wilson and J. Penzien, Evaluation of orthogonal damping matrices, Int. J. Numer. Methods
    Engrg. 4 (1972) 5-10. K - omega2 M + i omega C is then the dynamic stiffness with the damping.

    Parameters
    ----------
    model : ReducedModel
    damping : Damping

    Returns
    -------
    ndarray, shape (12 + m, 12 + m)
        Symmetric, positive semi-definite; N s/m for the translations of the rings.

    Raises
    ------
    Refusal
        If the damping is not viscous, as structural damping is not: no real matrix C does the same
        at all frequencies.
    """
    values, vectors = model.free_modes()
    coefficients = viscous_coefficients(values, damping)
    momenta = model.mass @ vectors
    return (momenta * coefficients) @ momenta.T


def viscous_coefficients(eigenvalues: np.ndarray, damping: Damping) -> np.ndarray:
    """c_j = 2 zeta_j omega_j of modes with the given squared angular eigenfrequencies, 1/s.

    Raises
    ------
    Refusal
        If the damping is not viscous.
    """
    once, twice = (damping.modal(eigenvalues, np.array(omega)) for omega in (1.0, 2.0))
    if not np.array_equal(twice, 2 * once):
        raise Refusal(
            f"{damping} is not viscous, so that no damping matrix C stands for it; use modal or "
            "Rayleigh damping, or a format that holds the frequency response (csv, uff)."
        )
    return once.imag
