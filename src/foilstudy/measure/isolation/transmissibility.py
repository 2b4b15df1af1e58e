"""Motion of an isolated payload per motion of the floor."""

from __future__ import annotations

import numpy as np

from foilstudy.measure.isolation.parallel import FLOOR, PAYLOAD


def transmissibility(
    stiffness: np.ndarray, frequencies: np.ndarray, payload_mass: float
) -> np.ndarray:
    """Motion of a rigid payload per motion of the floor, along one direction.

    ::

        payload, mass m    --+--------------+--   u_p
                             |              |
                           mount(s)    foil link(s)      D = sum of both
                             |              |
        floor              --+--------------+--   u_f, prescribed

    Nothing but its supports acts on the payload: D_pf u_f + D_pp u_p = omega^2 m u_p, so that
    T = u_p / u_f = -D_pf / (D_pp - omega^2 m).

    Parameters
    ----------
    stiffness : ndarray of complex, shape (..., f, 2, 2)
        Sum of all supports, N/m, see `foilstudy.measure.isolation.parallel`.
    frequencies : ndarray, shape (f,)
        Hz.
    payload_mass : float
        m, kg.

    Returns
    -------
    ndarray of complex, shape (..., f)

    Raises
    ------
    ValueError
        If the mass is negative or not finite.
    """
    if not (np.isfinite(payload_mass) and payload_mass >= 0):
        raise ValueError(f"The payload mass is {payload_mass!r} kg; give zero or more.")
    inertia = (2 * np.pi * np.asarray(frequencies, dtype=float)) ** 2 * payload_mass
    return -stiffness[..., PAYLOAD, FLOOR] / (stiffness[..., PAYLOAD, PAYLOAD] - inertia)


def decibels(ratio: np.ndarray) -> np.ndarray:
    """20 log10 of a magnitude."""
    return 20 * np.log10(np.abs(ratio))
