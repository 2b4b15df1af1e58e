"""What pairs of points and triangles, and of edges, exert; and they as springs."""

from __future__ import annotations

import numpy as np
from numba import njit

from foilstudy.model.contact.barrier import barrier, pair_energy, pair_hessian
from foilstudy.model.contact.distance import closest


@njit(cache=True, error_model="numpy")
def distances(knots, pairs, edges):
    """Distance of each of some pairs, m."""
    x, a = np.empty((4, 3)), np.empty(4)
    change, w = np.empty((2, 4)), np.empty(3)
    out = np.empty(len(pairs))
    for p in range(len(pairs)):
        for i in range(4):
            for c in range(3):
                x[i, c] = knots[pairs[p, i], c]
        square, _ = closest(x, edges[p], a, change, w)
        out[p] = np.sqrt(square)
    return out


@njit(cache=True, error_model="numpy")
def exert(knots, pairs, edges, full, thickness, span, size, forces):
    """Add what pairs exert to the forces on the knots, N; return their energy, J.

    Parameters
    ----------
    knots : ndarray, shape (count, 3)
    pairs : ndarray of int, shape (active, 4)
    edges : ndarray of bool, shape (active,)
    full : ndarray, shape (active,)
        See `barrier.pair_energy`.
    thickness, span, size : float
        t, m; s, m2; E0, J.
    forces : ndarray, shape (count, 3)
    """
    x, gradient = np.empty((4, 3)), np.empty((4, 3))
    a, change, w = np.empty(4), np.empty((2, 4)), np.empty(3)
    total = 0.0
    for p in range(len(pairs)):
        for i in range(4):
            for c in range(3):
                x[i, c] = knots[pairs[p, i], c]
        total += size * pair_energy(x, edges[p], full[p], thickness, span, a, change, w, gradient)
        for i in range(4):
            for c in range(3):
                forces[pairs[p, i], c] += size * gradient[i, c]
    return total


@njit(cache=True, error_model="numpy")
def hessians(knots, pairs, edges, full, thickness, span, size):
    """Second derivatives of the energies of pairs, shape (active, 12, 12), N/m."""
    x, a = np.empty((4, 3)), np.empty(4)
    change, w = np.empty((2, 4)), np.empty(3)
    out = np.empty((len(pairs), 12, 12))
    for p in range(len(pairs)):
        for i in range(4):
            for c in range(3):
                x[i, c] = knots[pairs[p, i], c]
        pair_hessian(x, edges[p], full[p], thickness, span, a, change, w, out[p])
        out[p] *= size
    return out


@njit(cache=True, error_model="numpy")
def normal_forces(knots, pairs, edges, full, thickness, span, size):
    """With which the sides of pairs repel each other, shape (active,), N."""
    x, gradient = np.empty((4, 3)), np.empty((4, 3))
    a, change, w = np.empty(4), np.empty((2, 4)), np.empty(3)
    out = np.empty(len(pairs))
    for p in range(len(pairs)):
        for i in range(4):
            for c in range(3):
                x[i, c] = knots[pairs[p, i], c]
        pair_energy(x, edges[p], full[p], thickness, span, a, change, w, gradient)
        square = 0.0
        for c in range(3):
            one_side = gradient[0, c] + gradient[1, c] if edges[p] else gradient[0, c]
            square += one_side * one_side
        out[p] = size * np.sqrt(square)
    return out


@njit(cache=True, error_model="numpy")
def springs(knots, pairs, edges, thickness, span, size):
    """Pairs as springs between their closest points.

    Returns
    -------
    stiffness : ndarray, shape (active,)
        Second derivative of the energy by the distance, N/m; the factor of edges is left at 1.
    weights : ndarray, shape (active, 4)
    direction : ndarray, shape (active, 3)
        From one side to the other.
    """
    x, a = np.empty((4, 3)), np.empty(4)
    change, w = np.empty((2, 4)), np.empty(3)
    stiffness, weights = np.empty(len(pairs)), np.empty((len(pairs), 4))
    direction = np.empty((len(pairs), 3))
    for p in range(len(pairs)):
        for i in range(4):
            for c in range(3):
                x[i, c] = knots[pairs[p, i], c]
        square, _ = closest(x, edges[p], a, change, w)
        _, slope, bend = barrier((square - thickness * thickness) / span)
        stiffness[p] = size * (4.0 * square * bend / (span * span) + 2.0 * slope / span)
        weights[p] = a
        direction[p] = w / np.sqrt(square)
    return stiffness, weights, direction
