"""Supports with two ends, floor and payload, and their sum.

The two motions of every 2 x 2 dynamic stiffness D are those of `FLOOR` and `PAYLOAD`, along one
direction, all other motions held. With time factor exp(i omega t) and the forces that the support
needs at its ends, F = D u, a positive imaginary part dissipates.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

FLOOR, PAYLOAD = 0, 1
"""Order of the two motions."""


def two_ended(floor: np.ndarray, payload: np.ndarray, transfer: np.ndarray) -> np.ndarray:
    """Symmetric 2 x 2 dynamic stiffness from its three independent entries.

    Parameters
    ----------
    floor, payload : ndarray
        Driving stiffness: force on an end per motion of that end, the other held, N/m.
    transfer : ndarray
        Force on a held end per motion of the other, with the sign in which a spring has its
        stiffness, N/m.

    Returns
    -------
    ndarray of complex, shape (..., 2, 2), N/m
        ``[[floor, -transfer], [-transfer, payload]]``.
    """
    floor, payload, transfer = np.broadcast_arrays(floor, payload, transfer)
    stiffness = np.empty((*transfer.shape, 2, 2), dtype=complex)
    stiffness[..., FLOOR, FLOOR] = floor
    stiffness[..., PAYLOAD, PAYLOAD] = payload
    stiffness[..., FLOOR, PAYLOAD] = stiffness[..., PAYLOAD, FLOOR] = -transfer
    return stiffness


def foil_link(driving: np.ndarray, transfer: np.ndarray) -> np.ndarray:
    """2 x 2 dynamic stiffness of a crumpled foil, one ring on the floor, one on the payload.

    Both rings are given the driving stiffness of the bottom ring, the one that the cube holds.
    The two differ from realisation to realisation only, and the one at the payload acts beside
    the inertia of the payload, which is far larger.

    Parameters
    ----------
    driving, transfer : ndarray, shape (..., f)
        Dynamic stiffness of one direction in these definitions, N/m.

    Returns
    -------
    ndarray of complex, shape (..., f, 2, 2), N/m
    """
    return two_ended(driving, driving, transfer)


def in_parallel(supports: Iterable[tuple[int, np.ndarray]]) -> np.ndarray:
    """Sum of supports that share their two ends.

    Parameters
    ----------
    supports : iterable of (count, 2 x 2 dynamic stiffness)
        The stiffnesses broadcast, shape (..., f, 2, 2), N/m; zero of a kind is allowed.

    Returns
    -------
    ndarray of complex, shape (..., f, 2, 2), N/m

    Raises
    ------
    ValueError
        If there is no support at all, a count is negative, or a stiffness is not 2 x 2.
    """
    supports = tuple(supports)
    if not any(count for count, _ in supports):
        raise ValueError("Nothing stands between floor and payload; give at least one support.")
    for count, stiffness in supports:
        if count < 0:
            raise ValueError(f"A support is counted {count} times; give zero or more.")
        if np.shape(stiffness)[-2:] != (2, 2):
            raise ValueError(
                f"The dynamic stiffness of a support has shape {np.shape(stiffness)}; it must end "
                "in 2 x 2, for floor and payload."
            )
    return sum(count * np.asarray(stiffness) for count, stiffness in supports)
