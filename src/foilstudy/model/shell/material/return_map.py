"""Von Mises plasticity in plane stress, layer by layer: closest-point return with hardening.

After Simo and Taylor (Int. J. Numer. Methods Engrg. 22, 1986): with the stress less the back
stress as half-sum, half-difference and shear, the return divides each by a linear function of one
multiplier g, which is the root of a concave function; Newton's method climbs to it from below and
needs no safeguard. Fast-math would not let what is not a number through to where it is noticed.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

_ROUNDING = 1e-12
"""Relative; what has returned to the yield surface does not flow for less."""


class Flow(NamedTuple):
    """Constants of the return map.

    Attributes
    ----------
    youngs_modulus, poisson_ratio : float
    yield_stress : float
        Of the virgin material, Pa.
    isotropic, kinematic : float
        Slopes of the flow stress and of the back stress over the plastic strain, Pa.
    """

    youngs_modulus: float
    poisson_ratio: float
    yield_stress: float
    isotropic: float
    kinematic: float


@njit(cache=True, error_model="numpy", forceinline=True)
def _trial(e1, e2, e6, p1, p2, p6, flow):
    """Sum, difference and shear of the stress less the back stress, were there no more flow."""
    modulus, nu, _, _, kinematic = flow
    back = kinematic * (2.0 / 3.0)
    sums, shear = modulus / (1.0 - nu), modulus / (1.0 + nu)
    return (
        sums * ((e1 - p1) + (e2 - p2)) - 3.0 * back * (p1 + p2),
        shear * ((e1 - p1) - (e2 - p2)) - back * (p1 - p2),
        0.5 * (shear * (e6 - p6) - back * p6),
    )


@njit(cache=True, error_model="numpy", forceinline=True)
def _excess(u, v, w, done, flow):
    """By how much the square of the von Mises stress is beyond that of the flow stress."""
    limit = flow[2] + flow[3] * done
    return 0.25 * u * u + 0.75 * v * v + 3.0 * w * w - (1.0 + _ROUNDING) * limit * limit


@njit(cache=True, error_model="numpy", forceinline=True)
def _flowed(u, v, w, done, flow):
    """Plastic strain increments (11, 22, 2 12) and that of the accumulated one, beyond yield."""
    modulus, nu, limit, isotropic, kinematic = flow
    back = kinematic * (2.0 / 3.0)
    a, b = modulus / (3.0 * (1.0 - nu)) + back, modulus / (1.0 + nu) + back
    in_sum, apart = u * u / 12.0, 0.25 * v * v + w * w
    target = np.sqrt(3.0) / (limit + isotropic * done)
    slope = isotropic * (2.0 / 3.0) * target
    g, step = 0.0, np.inf
    while step > _ROUNDING * g:
        x, y = 1.0 / (1.0 + a * g), 1.0 / (1.0 + b * g)
        mean, deviation = in_sum * x * x, apart * y * y
        total = mean + deviation
        root = 1.0 / np.sqrt(total)
        rise = root * (mean * a * x + deviation * b * y) / total + slope
        step = (target - slope * g - root) / rise
        g += step
    x, y = 1.0 / (1.0 + a * g), 1.0 / (1.0 + b * g)
    along, across = g * u * x / 6.0, 0.5 * g * v * y
    equivalent = np.sqrt(3.0 * (in_sum * x * x + apart * y * y))
    return along + across, along - across, 2.0 * g * w * y, (2.0 / 3.0) * g * equivalent


@njit(cache=True, error_model="numpy")
def increment(strain, plastic, done, flow):
    """Plastic strain increments (11, 22, 2 12) and that of the accumulated one, of one layer.

    Parameters
    ----------
    strain, plastic : tuple of float
        Strains 11, 22, 2 12 that have been reached, and the plastic ones so far.
    done : float
        Accumulated plastic strain so far.
    flow : Flow
    """
    u, v, w = _trial(*strain, *plastic, flow)
    if not _excess(u, v, w, done, flow) > 0.0:
        return 0.0, 0.0, 0.0, 0.0
    return _flowed(u, v, w, done, flow)


_W = 128
"""Elements at a time."""
# Rows of the work array, of constant distance, by which the compiler sees that they do not overlap.
_STRAIN, _BENT, _PLASTIC, _DONE = 0, 3, 6, 9
_MEAN, _CURVED, _ENERGY, _VOLUME = 10, 13, 16, 17
_FRAME, _EXCESS = 18, 24
_ROWS = 25


@njit(cache=True, error_model="numpy")
def _turn(w, to, n):
    """Three strains into Cartesian axes, where they stand."""
    for k in range(n):
        e1, e2, e6 = w[to * _W + k], w[(to + 1) * _W + k], w[(to + 2) * _W + k]
        w[to * _W + k] = w[_FRAME * _W + k] * e1
        w[(to + 1) * _W + k] = (
            w[(_FRAME + 1) * _W + k] * e1
            + w[(_FRAME + 2) * _W + k] * e2
            + w[(_FRAME + 3) * _W + k] * e6
        )
        w[(to + 2) * _W + k] = w[(_FRAME + 4) * _W + k] * e1 + w[(_FRAME + 5) * _W + k] * e6


@njit(cache=True, error_model="numpy")
def _turn_back(w, at, n):
    for k in range(n):
        c1 = w[at * _W + k] / w[_FRAME * _W + k]
        c6 = (w[(at + 2) * _W + k] - w[(_FRAME + 4) * _W + k] * c1) / w[(_FRAME + 5) * _W + k]
        c2 = w[(at + 1) * _W + k]
        c2 -= w[(_FRAME + 1) * _W + k] * c1 + w[(_FRAME + 3) * _W + k] * c6
        w[at * _W + k] = c1
        w[(at + 1) * _W + k] = c2 / w[(_FRAME + 2) * _W + k]
        w[(at + 2) * _W + k] = c6


@njit(cache=True, error_model="numpy", forceinline=True)
def _trial_at(w, k, z, flow):
    return _trial(
        w[_STRAIN * _W + k] + z * w[_BENT * _W + k],
        w[(_STRAIN + 1) * _W + k] + z * w[(_BENT + 1) * _W + k],
        w[(_STRAIN + 2) * _W + k] + z * w[(_BENT + 2) * _W + k],
        w[_PLASTIC * _W + k],
        w[(_PLASTIC + 1) * _W + k],
        w[(_PLASTIC + 2) * _W + k],
        flow,
    )


@njit(cache=True, error_model="numpy")
def _layer(w, n, z, mean, bent, flow):
    """Bring one layer of the elements up to date, and count it in."""
    for k in range(n):
        u, v, s = _trial_at(w, k, z, flow)
        w[_EXCESS * _W + k] = _excess(u, v, s, w[_DONE * _W + k], flow)
    for k in range(n):  # few flow at a time
        if w[_EXCESS * _W + k] > 0.0:
            u, v, s = _trial_at(w, k, z, flow)
            d1, d2, d6, more = _flowed(u, v, s, w[_DONE * _W + k], flow)
            w[_PLASTIC * _W + k] += d1
            w[(_PLASTIC + 1) * _W + k] += d2
            w[(_PLASTIC + 2) * _W + k] += d6
            w[_DONE * _W + k] += more
    sums, shear = 0.25 * mean * flow[0] / (1.0 - flow[1]), 0.25 * mean * flow[0] / (1.0 + flow[1])
    for k in range(n):
        p1, p2, p6 = w[_PLASTIC * _W + k], w[(_PLASTIC + 1) * _W + k], w[(_PLASTIC + 2) * _W + k]
        w[_MEAN * _W + k] += mean * p1
        w[(_MEAN + 1) * _W + k] += mean * p2
        w[(_MEAN + 2) * _W + k] += mean * p6
        w[_CURVED * _W + k] += bent * p1
        w[(_CURVED + 1) * _W + k] += bent * p2
        w[(_CURVED + 2) * _W + k] += bent * p6
        density = sums * (p1 + p2) * (p1 + p2) + shear * ((p1 - p2) * (p1 - p2) + p6 * p6)
        w[_ENERGY * _W + k] += w[_VOLUME * _W + k] * density


@njit(cache=True, error_model="numpy")
def evolve(strain, frame, layers, flow, before, after, inelastic):
    """Plastic strains of all layers once mean strains have been reached.

    Parameters
    ----------
    strain : ndarray, shape (elements_along, 6, elements_around)
        e_11, e_22, 2 e_12 and k_11, k_22, 2 k_12 in the coordinates of the elements.
    frame : ndarray, shape (elements_along, 7, elements_around)
        See `cartesian_frame`; the last one is the volume of an element, m3.
    layers : ndarray, shape (layers,)
        Heights above the middle surface, m; all count alike.
    flow : Flow
    before, after : ndarray, shape (elements_along, layers, 4, elements_around)
        Plastic strains 11, 22, 2 12 in Cartesian axes, and the accumulated one.
    inelastic : ndarray, shape of strain
        Receives the mean of the plastic strains and their curvature, in the element's coordinates.

    Returns
    -------
    float
        Elastic energy that the plastic strains alone would have, J.
    """
    number = layers.size
    mean, square = 1.0 / number, np.sum(layers * layers)
    w = np.empty(_ROWS * _W)
    energy = 0.0
    for j in range(strain.shape[0]):
        for start in range(0, strain.shape[2], _W):
            n = min(_W, strain.shape[2] - start)
            stop = start + n
            for part in range(6):
                w[part * _W : part * _W + n] = strain[j, part, start:stop]
                w[(_FRAME + part) * _W : (_FRAME + part) * _W + n] = frame[j, part, start:stop]
            w[_VOLUME * _W : _VOLUME * _W + n] = frame[j, 6, start:stop]
            _turn(w, _STRAIN, n)
            _turn(w, _BENT, n)
            w[_MEAN * _W : (_ENERGY + 1) * _W] = 0.0
            for layer in range(number):
                z = layers[layer]
                for part in range(4):
                    at = (_PLASTIC + part) * _W
                    w[at : at + n] = before[j, layer, part, start:stop]
                _layer(w, n, z, mean, z / square, flow)
                for part in range(4):
                    at = (_PLASTIC + part) * _W
                    after[j, layer, part, start:stop] = w[at : at + n]
            _turn_back(w, _MEAN, n)
            _turn_back(w, _CURVED, n)
            for part in range(6):
                at = (_MEAN + part) * _W
                inelastic[j, part, start:stop] = w[at : at + n]
            for k in range(n):
                energy += w[_ENERGY * _W + k]
    return energy


def cartesian_frame(forms: np.ndarray) -> np.ndarray:
    """Strains in Cartesian axes, the first along a_1, from those in the coordinates of elements.

    Parameters
    ----------
    forms : ndarray, shape (elements_along, 6, elements_around)
        See `section.Section`.

    Returns
    -------
    ndarray, shape (elements_along, 6, elements_around)
        Coefficients 11-11, 22-11, 22-22, 22-12, 12-11, 12-12 on (e_11, e_22, 2 e_12); the others
        are zero.
    """
    a11, a22, a12 = forms[:, 0], forms[:, 1], 0.5 * forms[:, 2]
    det = a11 * a22 - a12**2
    along, skew = a12 / a11, a12 / np.sqrt(det)  # a_2 over a_1, and over its height above a_1
    shear = 1 / np.sqrt(det)
    by_first = -2 * along * shear
    return np.stack(
        [
            1 / a11,
            -(skew**2) / a11 - skew * by_first,
            a11 / det,
            -skew * shear,
            by_first,
            shear,
        ],
        axis=1,
    )
