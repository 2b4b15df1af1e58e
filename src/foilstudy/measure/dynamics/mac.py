"""Modal assurance criterion: do two sets of mode shapes describe the same motions?"""

from __future__ import annotations

import numpy as np


def mac(shapes_a: np.ndarray, shapes_b: np.ndarray, mass=None) -> np.ndarray:
    """MAC of every pair of shapes: (a.M b)^2 / ((a.M a) (b.M b)), 1 for the same shape.

    R. J. Allemang and D. L. Brown, A correlation coefficient for modal vector analysis, Proc. 1st
    International Modal Analysis Conference (1982) 110-116.

    Parameters
    ----------
    shapes_a : ndarray, shape (unknowns, modes of a)
        Any scale and sign, real.
    shapes_b : ndarray, shape (unknowns, modes of b)
        At the same unknowns.
    mass : sparse or dense symmetric matrix (unknowns, unknowns), optional
        Weight; with it the modes of one structure are orthogonal. Without it all unknowns count
        alike, which is nearly the same on a uniform grid of material points.

    Returns
    -------
    ndarray, shape (modes of a, modes of b)
        Between 0 and 1.

    Raises
    ------
    ValueError
        If the shapes are not two matrices over the same unknowns, or one of them is zero or not
        finite.
    """
    a, b = np.asarray(shapes_a, float), np.asarray(shapes_b, float)
    if a.ndim != 2 or b.ndim != 2 or len(a) != len(b):
        raise ValueError(
            f"mac: shapes of {a.shape} and {b.shape} cannot be compared; give one column per mode, "
            "with the same unknowns in both."
        )
    weighted_a, weighted_b = (a, b) if mass is None else (mass @ a, mass @ b)
    squares_a = np.einsum("nm,nm->m", a, weighted_a)
    squares_b = np.einsum("nm,nm->m", b, weighted_b)
    for name, squares in (("first", squares_a), ("second", squares_b)):
        bad = np.flatnonzero(~(np.isfinite(squares) & (squares > 0)))
        if bad.size:
            raise ValueError(
                f"mac: mode {bad[0] + 1} of the {name} set is zero, not finite or without mass; "
                "leave it out."
            )
    product = a.T @ weighted_b
    # rounding alone would leave a MAC of 1 + 1e-16
    return np.minimum(product**2 / np.outer(squares_a, squares_b), 1.0)
