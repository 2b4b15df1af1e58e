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
_LAST = 1e-6
"""Of the multiplier: after a step of Newton's method that is less, the next would be rounding."""


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
def _newton(u, v, w, limit, g, flow):
    """Newton's step of the multiplier."""
    modulus, nu, _, isotropic, kinematic = flow
    back = kinematic * (2.0 / 3.0)
    a, b = modulus / (3.0 * (1.0 - nu)) + back, modulus / (1.0 + nu) + back
    target = np.sqrt(3.0) / limit
    slope = isotropic * (2.0 / 3.0) * target
    x, y = 1.0 / (1.0 + a * g), 1.0 / (1.0 + b * g)
    mean, deviation = u * u / 12.0 * x * x, (0.25 * v * v + w * w) * y * y
    total = mean + deviation
    root = 1.0 / np.sqrt(total)
    rise = root * (mean * a * x + deviation * b * y) / total + slope
    return (target - slope * g - root) / rise


@njit(cache=True, error_model="numpy", forceinline=True)
def _flowed(u, v, w, g, flow):
    """Plastic strain increments (11, 22, 2 12) and that of the accumulated one, by multiplier."""
    modulus, nu, _, _, kinematic = flow
    back = kinematic * (2.0 / 3.0)
    a, b = modulus / (3.0 * (1.0 - nu)) + back, modulus / (1.0 + nu) + back
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
    while step > _LAST * g:
        step = _newton(u, v, w, limit, g, flow)
        g += step
    return _flowed(u, v, w, g, flow)


@njit(cache=True, error_model="numpy", forceinline=True)
def _turned(frame, j, k, e1, e2, e6):
    """Three strains of an element in Cartesian axes."""
    return (
        frame[j, 0, k] * e1,
        frame[j, 1, k] * e1 + frame[j, 2, k] * e2 + frame[j, 3, k] * e6,
        frame[j, 4, k] * e1 + frame[j, 5, k] * e6,
    )


@njit(cache=True, error_model="numpy", forceinline=True)
def _turned_back(frame, j, k, e1, e2, e6):
    c1 = e1 / frame[j, 0, k]
    c6 = (e6 - frame[j, 4, k] * c1) / frame[j, 5, k]
    return c1, (e2 - frame[j, 1, k] * c1 - frame[j, 3, k] * c6) / frame[j, 2, k], c6


@njit(cache=True, error_model="numpy")
def _moved(strain, seen, frame, room, j, farthest, flow, over):
    """By how much elements of a row have come nearer to yield than they have room for, squared.

    The von Mises stress of what strains have changed by is convex over the thickness, so that no
    layer has come nearer by more than the larger one of the outermost two.
    """
    sums, shear = flow[0] / (1.0 - flow[1]), flow[0] / (1.0 + flow[1])
    for k in range(over.size):
        m1, m2, m6 = _turned(
            frame, j, k,
            strain[j, 0, k] - seen[j, 0, k],
            strain[j, 1, k] - seen[j, 1, k],
            strain[j, 2, k] - seen[j, 2, k],
        )  # fmt: skip
        b1, b2, b6 = _turned(
            frame, j, k,
            strain[j, 3, k] - seen[j, 3, k],
            strain[j, 4, k] - seen[j, 4, k],
            strain[j, 5, k] - seen[j, 5, k],
        )  # fmt: skip
        mu, mv, mw = sums * (m1 + m2), shear * (m1 - m2), 0.5 * shear * m6
        bu, bv = farthest * sums * (b1 + b2), farthest * shear * (b1 - b2)
        bw = farthest * 0.5 * shear * b6
        even = 0.25 * (mu * mu + bu * bu) + 0.75 * (mv * mv + bv * bv) + 3.0 * (mw * mw + bw * bw)
        odd = 0.5 * mu * bu + 1.5 * mv * bv + 6.0 * mw * bw
        over[k] = even + abs(odd) - room[j, k] * abs(room[j, k])


LAYERS_MAX = _W = 512
"""Of an element, and as many flow at a time."""
# Rows of work arrays, of constant distance, by which the compiler sees that they do not overlap: of
# the layers of one element, and of those that flow.
_EXCESS, _LEFT = 3, 4
_LIMIT, _MULTIPLIER, _STEP, _FLOWING = 3, 4, 5, 6


@njit(cache=True, error_model="numpy")
def _excesses(layers, mean, bent, heights, flow, trial):
    """Trial stress, excess beyond yield and room before it of the layers of one element."""
    p1, p2, p6, done = layers[0], layers[1], layers[2], layers[3]
    for n in range(heights.size):
        z = heights[n]
        u, v, w = _trial(
            mean[0] + z * bent[0], mean[1] + z * bent[1], mean[2] + z * bent[2],
            p1[n], p2[n], p6[n], flow,
        )  # fmt: skip
        limit, square = flow[2] + flow[3] * done[n], _square(u, v, w)
        trial[n], trial[_W + n], trial[2 * _W + n] = u, v, w
        trial[_EXCESS * _W + n] = _excess(square, limit)
        trial[_LEFT * _W + n] = limit - np.sqrt(square)


@njit(cache=True, error_model="numpy")
def _flow(layers, f, where, count, flow):
    """Let layers flow, all at once."""
    for n in range(count):
        f[_MULTIPLIER * _W + n], f[_STEP * _W + n] = 0.0, np.inf
    left = count
    while left > 0:
        for n in range(count):
            g = f[_MULTIPLIER * _W + n]
            step = _newton(
                f[n], f[_W + n], f[2 * _W + n], f[_LIMIT * _W + n], g, flow
            )  # fmt: skip
            # what has come to its end stays there, whatever flows beside it
            step = step if f[_STEP * _W + n] > _LAST * g else 0.0
            f[_MULTIPLIER * _W + n], f[_STEP * _W + n] = g + step, step
        left = 0
        for n in range(count):
            left += f[_STEP * _W + n] > _LAST * f[_MULTIPLIER * _W + n]
    for n in range(count):
        d1, d2, d6, more = _flowed(f[n], f[_W + n], f[2 * _W + n], f[_MULTIPLIER * _W + n], flow)
        f[n], f[_W + n], f[2 * _W + n], f[_LIMIT * _W + n] = d1, d2, d6, more
    for n in range(count):
        slot, layer = where[0, n], where[1, n]
        for part in range(4):
            layers[slot, part, layer] += f[part * _W + n]


@njit(cache=True, error_model="numpy")
def _sum_all(layers, where, count, heights, frame, flow, sums):
    for n in range(count):
        j, k, slot = where[2, n], where[3, n], where[4, n]
        _sum_up(layers[slot], heights, frame, j, k, flow, sums[slot])


@njit(cache=True, error_model="numpy", fastmath={"reassoc", "contract", "nsz"})
def _sum_up(layers, heights, frame, j, k, flow, sums):
    """What the layers of an element add up to, see `layers.Layers`."""
    p1, p2, p6, done = layers[0], layers[1], layers[2], layers[3]
    square, kinematic = 0.0, flow[4]
    a = b = c = d = e = f = elastic = used = kept = 0.0
    first, second = 0.25 * flow[0] / (1.0 - flow[1]), 0.25 * flow[0] / (1.0 + flow[1])
    for n in range(heights.size):
        z = heights[n]
        square += z * z
        a, b, c = a + p1[n], b + p2[n], c + p6[n]
        d, e, f = d + z * p1[n], e + z * p2[n], f + z * p6[n]
        total, apart = p1[n] + p2[n], p1[n] - p2[n]
        elastic += first * total * total + second * (apart * apart + p6[n] * p6[n])
        used += done[n] * (flow[2] + 0.5 * flow[3] * done[n])
        kept += 0.75 * total * total + 0.25 * (apart * apart + p6[n] * p6[n])
    one = 1.0 / heights.size
    sums[0], sums[1], sums[2] = _turned_back(frame, j, k, one * a, one * b, one * c)
    sums[3], sums[4], sums[5] = _turned_back(frame, j, k, d / square, e / square, f / square)
    share = one * frame[j, 6, k]
    sums[6], sums[7] = share * elastic, share * used
    sums[8] = share * (2.0 / 3.0) * kinematic * kept


@njit(cache=True, error_model="numpy")
def flow_on(strain, frame, heights, flow, layers, sums, seen, room, slots, free, changed):
    """Bring the layers of all elements up to date once mean strains have been reached.

    Layers are looked at only where strains have changed, since they were looked at last, by as much
    as the element then had room for before any layer yields; there they are where they would
    be had all been looked at.

    Parameters
    ----------
    strain : ndarray, shape (elements_along, 6, elements_around)
        e_11, e_22, 2 e_12 and k_11, k_22, 2 k_12 in the coordinates of the elements.
    frame : ndarray, shape (elements_along, 7, elements_around)
        See `cartesian_frame`; the last one is the volume of an element, m3.
    heights : ndarray, shape (layers,)
        Above the middle surface, m; all count alike.
    flow : Flow
    layers, sums : ndarray
        See `layers.Layers`; what flows is written into free slots.
    seen : ndarray, shape of strain
        Strains that were looked at last.
    room : ndarray, shape (elements_along, elements_around)
        How much the von Mises stress could rise then in any layer, Pa; negative where the element
        has to be looked at.
    slots : ndarray of int, shape (elements_along, elements_around)
        Of the elements; overwritten where one flows.
    free : ndarray of int
        Free slots, as many as elements at least.
    changed : ndarray of int, shape (elements,)
        Receives the elements that have flowed, row times elements around plus column.

    Returns
    -------
    int
        How many free slots were used.
    """
    number, used, waiting, elements = heights.size, 0, 0, 0
    farthest = np.abs(heights).max()
    trial, over = np.empty(5 * _W), np.empty(strain.shape[2])
    flowing, where = np.empty(_FLOWING * _W), np.empty((5, _W), dtype=np.int64)
    for j in range(strain.shape[0]):
        _moved(strain, seen, frame, room, j, farthest, flow, over)
        for k in range(over.size):
            if over[k] < 0.0:  # what is not a number is looked at
                continue
            for part in range(6):
                seen[j, part, k] = strain[j, part, k]
            mean = _turned(frame, j, k, strain[j, 0, k], strain[j, 1, k], strain[j, 2, k])
            bent = _turned(frame, j, k, strain[j, 3, k], strain[j, 4, k], strain[j, 5, k])
            slot = slots[j, k]
            _excesses(layers[slot], mean, bent, heights, flow, trial)
            least, first = np.inf, waiting
            for n in range(number):
                if trial[_EXCESS * _W + n] > 0.0:
                    for part in range(3):
                        flowing[part * _W + waiting] = trial[part * _W + n]
                    flowing[_LIMIT * _W + waiting] = flow[2] + flow[3] * layers[slot, 3, n]
                    where[0, waiting], where[1, waiting] = free[used], n
                    waiting += 1
                if not trial[_LEFT * _W + n] >= least:
                    least = trial[_LEFT * _W + n]
            room[j, k] = least
            if waiting == first:
                continue
            room[j, k] = 0.0
            layers[free[used]] = layers[slot]
            slots[j, k] = free[used]
            changed[used] = j * over.size + k
            where[2, elements], where[3, elements], where[4, elements] = j, k, free[used]
            used += 1
            elements += 1
            if waiting + number > _W:
                _flow(layers, flowing, where, waiting, flow)
                _sum_all(layers, where, elements, heights, frame, flow, sums)
                waiting = elements = 0
    _flow(layers, flowing, where, waiting, flow)
    _sum_all(layers, where, elements, heights, frame, flow, sums)
    return used


@njit(cache=True, error_model="numpy")
def sum_up(layers, slots, heights, frame, flow, sums):
    """Write what the layers in the slots of all elements that have yielded add up to."""
    for j in range(slots.shape[0]):
        for k in range(slots.shape[1]):
            if slots[j, k] > 0:
                slot = slots[j, k]
                _sum_up(layers[slot], heights, frame, j, k, flow, sums[slot])


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
