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
_LAST = 1e-13
"""Of the multiplier: what the next step of Newton's method would be at most, once it is enough."""


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
def _square(u, v, w):
    """Of the von Mises stress."""
    return 0.25 * u * u + 0.75 * v * v + 3.0 * w * w


@njit(cache=True, error_model="numpy", forceinline=True)
def _excess(square, limit):
    """By how much the square of the von Mises stress is beyond that of the flow stress."""
    return square - (1.0 + _ROUNDING) * limit * limit


@njit(cache=True, error_model="numpy", forceinline=True)
def _pliancies(flow):
    """What the multiplier is multiplied by, in the return of the sum and of the others."""
    modulus, nu, _, _, kinematic = flow
    back = kinematic * (2.0 / 3.0)
    return modulus / (3.0 * (1.0 - nu)) + back, modulus / (1.0 + nu) + back


@njit(cache=True, error_model="numpy", forceinline=True)
def _newton(u, v, w, limit, g, flow):
    """Newton's step of the multiplier: root of sqrt(3) / limit - slope g = 1 / sqrt(total)."""
    a, b = _pliancies(flow)
    inverse = 1.0 / (limit * (1.0 + a * g) * (1.0 + b * g))
    target = np.sqrt(3.0) * inverse * (1.0 + a * g) * (1.0 + b * g)
    slope = flow[3] * (2.0 / 3.0) * target
    x, y = limit * (1.0 + b * g) * inverse, limit * (1.0 + a * g) * inverse
    mean, deviation = u * u * (1.0 / 12.0) * x * x, (0.25 * v * v + w * w) * y * y
    total = mean + deviation
    root = np.sqrt(total)
    rise = (mean * a * x + deviation * b * y) + slope * total * root
    return ((target - slope * g) * root - 1.0) * total / rise


@njit(cache=True, error_model="numpy", forceinline=True)
def _goes_on(g, step, flow):
    """Whether the next of Newton's steps, less than b step^2, would be more than rounding."""
    return _pliancies(flow)[1] * step * step > _LAST * g


@njit(cache=True, error_model="numpy", forceinline=True)
def _flowed(u, v, w, g, flow):
    """Plastic strain increments (11, 22, 2 12) and that of the accumulated one, by multiplier."""
    a, b = _pliancies(flow)
    x, y = 1.0 / (1.0 + a * g), 1.0 / (1.0 + b * g)
    along, across = g * u * x / 6.0, 0.5 * g * v * y
    equivalent = np.sqrt(0.25 * u * u * x * x + 3.0 * (0.25 * v * v + w * w) * y * y)
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
    limit = flow[2] + flow[3] * done
    if not _excess(_square(u, v, w), limit) > 0.0:
        return 0.0, 0.0, 0.0, 0.0
    g, step = 0.0, np.inf
    while _goes_on(g, step, flow):
        step = _newton(u, v, w, limit, g, flow)
        g += step
    return _flowed(u, v, w, g, flow)


_BATCH = 64
"""Elements whose layers flow together."""
_DISTANCE = _BATCH + 8
# Rows of a work array, a value of every element of a batch: membrane and bending strains in
# Cartesian axes; the frame; what the layers add up to; least room, largest multiplier.
_MEAN, _BENT, _FRAME, _SUM, _LEAST, _MOST, _OF_ELEMENTS = 0, 3, 6, 13, 22, 23, 24
# Of one layer of every element: trial stress, flow stress, multiplier, last step.
_U, _LIMIT, _MULTIPLIER, _STEP, _OF_LAYER = 0, 3, 4, 5, 6


@njit(cache=True, error_model="numpy", forceinline=True)
def _turned(f, k, first):
    """Three strains of an element in Cartesian axes."""
    e1, e2, e6 = (
        f[first * _DISTANCE + k], f[(first + 1) * _DISTANCE + k], f[(first + 2) * _DISTANCE + k],
    )  # fmt: skip
    at = _FRAME * _DISTANCE + k
    return (
        f[at] * e1,
        f[at + _DISTANCE] * e1 + f[at + 2 * _DISTANCE] * e2 + f[at + 3 * _DISTANCE] * e6,
        f[at + 4 * _DISTANCE] * e1 + f[at + 5 * _DISTANCE] * e6,
    )


@njit(cache=True, error_model="numpy", forceinline=True)
def _turned_back(f, k, e1, e2, e6):
    at = _FRAME * _DISTANCE + k
    c1 = e1 / f[at]
    c6 = (e6 - f[at + 4 * _DISTANCE] * c1) / f[at + 5 * _DISTANCE]
    c2 = (e2 - f[at + _DISTANCE] * c1 - f[at + 3 * _DISTANCE] * c6) / f[at + 2 * _DISTANCE]
    return c1, c2, c6


@njit(cache=True, error_model="numpy")
def _tried(f, plastic, layer, z, count, flow):
    """Trial stress of a layer, room left before it yields, and whether it flows."""
    for k in range(count):
        u, v, w = _trial(
            f[_MEAN * _DISTANCE + k] + z * f[_BENT * _DISTANCE + k],
            f[(_MEAN + 1) * _DISTANCE + k] + z * f[(_BENT + 1) * _DISTANCE + k],
            f[(_MEAN + 2) * _DISTANCE + k] + z * f[(_BENT + 2) * _DISTANCE + k],
            plastic[k], plastic[_DISTANCE + k], plastic[2 * _DISTANCE + k], flow,
        )  # fmt: skip
        limit, square = flow[2] + flow[3] * plastic[3 * _DISTANCE + k], _square(u, v, w)
        layer[k], layer[_DISTANCE + k], layer[2 * _DISTANCE + k] = u, v, w
        layer[_LIMIT * _DISTANCE + k] = limit
        layer[_MULTIPLIER * _DISTANCE + k] = 0.0
        layer[_STEP * _DISTANCE + k] = np.inf if _excess(square, limit) > 0.0 else 0.0
    for k in range(count):
        u, v, w = layer[k], layer[_DISTANCE + k], layer[2 * _DISTANCE + k]
        left = layer[_LIMIT * _DISTANCE + k] - np.sqrt(_square(u, v, w))
        least = f[_LEAST * _DISTANCE + k]
        f[_LEAST * _DISTANCE + k] = least if left >= least else left


@njit(cache=True, error_model="numpy")
def _returned(f, plastic, layer, count, flow):
    """Let a layer of every element flow back to its yield surface, all at once."""
    flowing = 0
    for k in range(count):
        flowing += layer[_STEP * _DISTANCE + k] > 0.0
    if flowing == 0:
        return
    while flowing > 0:
        for k in range(count):
            g, before = layer[_MULTIPLIER * _DISTANCE + k], layer[_STEP * _DISTANCE + k]
            step = _newton(
                layer[k], layer[_DISTANCE + k], layer[2 * _DISTANCE + k],
                layer[_LIMIT * _DISTANCE + k], g, flow,
            )  # fmt: skip
            # what has come to its end stays there, whatever flows beside it
            step = step if _goes_on(g, before, flow) else 0.0
            layer[_MULTIPLIER * _DISTANCE + k] = g + step
            layer[_STEP * _DISTANCE + k] = step
        flowing = 0
        for k in range(count):
            g, step = layer[_MULTIPLIER * _DISTANCE + k], layer[_STEP * _DISTANCE + k]
            flowing += _goes_on(g, step, flow)
    for k in range(count):
        g = layer[_MULTIPLIER * _DISTANCE + k]
        d1, d2, d6, more = _flowed(
            layer[k], layer[_DISTANCE + k], layer[2 * _DISTANCE + k], g, flow
        )
        plastic[k] += d1
        plastic[_DISTANCE + k] += d2
        plastic[2 * _DISTANCE + k] += d6
        plastic[3 * _DISTANCE + k] += more
        most = f[_MOST * _DISTANCE + k]
        f[_MOST * _DISTANCE + k] = g if g > most else most


@njit(cache=True, error_model="numpy")
def _added(f, plastic, z, count, flow):
    """Add a layer to what those of each element amount to."""
    first, second = 0.25 * flow[0] / (1.0 - flow[1]), 0.25 * flow[0] / (1.0 + flow[1])
    for k in range(count):
        p1, p2, p6 = plastic[k], plastic[_DISTANCE + k], plastic[2 * _DISTANCE + k]
        done = plastic[3 * _DISTANCE + k]
        total, apart = p1 + p2, p1 - p2
        at = _SUM * _DISTANCE + k
        f[at] += p1
        f[at + _DISTANCE] += p2
        f[at + 2 * _DISTANCE] += p6
        f[at + 3 * _DISTANCE] += z * p1
        f[at + 4 * _DISTANCE] += z * p2
        f[at + 5 * _DISTANCE] += z * p6
        f[at + 6 * _DISTANCE] += first * total * total + second * (apart * apart + p6 * p6)
        f[at + 7 * _DISTANCE] += done * (flow[2] + 0.5 * flow[3] * done)
        f[at + 8 * _DISTANCE] += 0.75 * total * total + 0.25 * (apart * apart + p6 * p6)


@njit(cache=True, error_model="numpy")
def _averaged(f, count, heights, flow):
    """From sums over the layers to `layers.Layers.sums`."""
    one, square = 1.0 / heights.size, 0.0
    for z in heights:
        square += z * z
    for k in range(count):
        at = _SUM * _DISTANCE + k
        c1, c2, c6 = _turned_back(
            f, k, one * f[at], one * f[at + _DISTANCE], one * f[at + 2 * _DISTANCE]
        )
        b1, b2, b6 = _turned_back(
            f, k, f[at + 3 * _DISTANCE] / square, f[at + 4 * _DISTANCE] / square,
            f[at + 5 * _DISTANCE] / square,
        )  # fmt: skip
        share = one * f[(_FRAME + 6) * _DISTANCE + k]
        f[at], f[at + _DISTANCE], f[at + 2 * _DISTANCE] = c1, c2, c6
        f[at + 3 * _DISTANCE], f[at + 4 * _DISTANCE], f[at + 5 * _DISTANCE] = b1, b2, b6
        f[at + 6 * _DISTANCE] *= share
        f[at + 7 * _DISTANCE] *= share
        f[at + 8 * _DISTANCE] *= share * (2.0 / 3.0) * flow[4]


@njit(cache=True, error_model="numpy")
def _begun(f, frame, elements, first, count):
    """Clear the sums of a batch and note the frames of its elements."""
    f[_SUM * _DISTANCE :] = 0.0
    f[_LEAST * _DISTANCE : _MOST * _DISTANCE] = np.inf
    for k in range(count):
        for part in range(7):
            f[(_FRAME + part) * _DISTANCE + k] = frame[elements[first + k], part]


@njit(cache=True, error_model="numpy")
def flow_on(
    elements, strains, frame, heights, flow, layers, sums, room, slots, free, changed
):  # fmt: skip
    """Bring the layers of some elements up to date once mean strains have been reached.

    Many elements at a time, layer by layer, so that all of it is done on vectors.

    Parameters
    ----------
    elements : ndarray of int, shape (number,)
        Row times elements around plus column.
    strains : ndarray, shape (number, 6)
        e_11, e_22, 2 e_12 and k_11, k_22, 2 k_12 in the coordinates of the elements.
    frame : ndarray, shape (all elements, 7)
        See `cartesian_frame`; the last one is the volume of an element, m3.
    heights : ndarray, shape (layers,)
        Above the middle surface, m; all count alike.
    flow : Flow
    layers, sums : ndarray
        See `layers.Layers`; what flows is written into free slots.
    room : ndarray, shape (number,)
        Receives how much the von Mises stress can rise in any layer before it yields, Pa.
    slots : ndarray of int, shape (all elements,)
        Of the elements; overwritten where one flows.
    free : ndarray of int
        Free slots, as many as elements at least; the last ones are taken first.
    changed : ndarray of int, shape (number,)
        Receives the elements that have flowed.

    Returns
    -------
    int
        How many free slots were used.
    """
    number, used = heights.size, 0
    f, layer = np.zeros(_OF_ELEMENTS * _DISTANCE), np.zeros(_OF_LAYER * _DISTANCE)
    width = 4 * _DISTANCE
    plastic = np.zeros(number * width)
    for first in range(0, len(elements), _BATCH):
        count = min(_BATCH, len(elements) - first)
        _begun(f, frame, elements, first, count)
        for k in range(count):
            for part in range(6):
                f[part * _DISTANCE + k] = strains[first + k, part]
            slot = slots[elements[first + k]]
            for part in range(4):
                for n in range(number):
                    plastic[n * width + part * _DISTANCE + k] = layers[slot, part, n]
        for k in range(count):
            m1, m2, m6 = _turned(f, k, _MEAN)
            b1, b2, b6 = _turned(f, k, _BENT)
            f[k], f[_DISTANCE + k], f[2 * _DISTANCE + k] = m1, m2, m6
            f[3 * _DISTANCE + k], f[4 * _DISTANCE + k], f[5 * _DISTANCE + k] = b1, b2, b6
        for n in range(number):
            p = plastic[n * width : (n + 1) * width]
            _tried(f, p, layer, heights[n], count, flow)
            _returned(f, p, layer, count, flow)
            _added(f, p, heights[n], count, flow)
        _averaged(f, count, heights, flow)
        for k in range(count):
            if not f[_MOST * _DISTANCE + k] > 0.0:
                room[first + k] = f[_LEAST * _DISTANCE + k]
                continue
            room[first + k] = 0.0
            slot = free[len(free) - 1 - used]
            slots[elements[first + k]] = slot
            changed[used] = elements[first + k]
            used += 1
            for part in range(4):
                for n in range(number):
                    layers[slot, part, n] = plastic[n * width + part * _DISTANCE + k]
            for part in range(9):
                sums[slot, part] = f[(_SUM + part) * _DISTANCE + k]
    return used


@njit(cache=True, error_model="numpy")
def sum_up(elements, frame, heights, flow, layers, slots, sums):
    """Write what the layers in the slots of some elements add up to."""
    f, plastic = np.zeros(_OF_ELEMENTS * _DISTANCE), np.zeros(4 * _DISTANCE)
    for first in range(0, len(elements), _BATCH):
        count = min(_BATCH, len(elements) - first)
        _begun(f, frame, elements, first, count)
        for n in range(heights.size):
            for k in range(count):
                for part in range(4):
                    slot = slots[elements[first + k]]
                    plastic[part * _DISTANCE + k] = layers[slot, part, n]
            _added(f, plastic, heights[n], count, flow)
        _averaged(f, count, heights, flow)
        for k in range(count):
            for part in range(9):
                slot = slots[elements[first + k]]
                sums[slot, part] = f[(_SUM + part) * _DISTANCE + k]


def stress_forms(frame: np.ndarray, flow: Flow) -> np.ndarray:
    """Matrices whose quadratic form is the square of the von Mises stress of elastic strains.

    Parameters
    ----------
    frame : ndarray, shape (elements, 6 or 7)
        See `cartesian_frame`.

    Returns
    -------
    ndarray, shape (elements, 3, 3)
        Of e_11, e_22, 2 e_12 in the coordinates of the elements, Pa2.
    """
    zero = np.zeros(len(frame))
    turn = np.stack(
        [frame[:, 0], zero, zero, *frame[:, 1:4].T, frame[:, 4], zero, frame[:, 5]], axis=1
    ).reshape(-1, 3, 3)
    sums = flow.youngs_modulus / (1 - flow.poisson_ratio)
    shear = flow.youngs_modulus / (1 + flow.poisson_ratio)
    halves = np.array(
        [
            [0.5 * sums, 0.5 * sums, 0.0],
            [np.sqrt(0.75) * shear, -np.sqrt(0.75) * shear, 0.0],
            [0.0, 0.0, np.sqrt(0.75) * shear],
        ]
    )
    parts = halves @ turn
    return parts.transpose(0, 2, 1) @ parts


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
