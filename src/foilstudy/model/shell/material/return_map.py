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

from foilstudy.model.shell.elements.mean_kernel import (
    OVER,
    ROWS,
    STRAINS,
    STRIDE,
    WIDTH,
    advance,
    begin,
)

ROOM = 6
LOOKED = 7
"""Values kept of an element that was looked at: its strains, and the room that it had."""
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
    target = np.sqrt(3.0)
    slope = isotropic * (2.0 / 3.0) * target
    first, second = 1.0 + a * g, 1.0 + b * g
    both = 1.0 / (first * second)
    x, y = second * both, first * both
    mean, deviation = u * u / 12.0 * x * x, (0.25 * v * v + w * w) * y * y
    total = mean + deviation
    cube = total * np.sqrt(total)
    # of 1 / sqrt(total) - (target - slope g) / limit, both times limit and cube: divisions are dear
    rise = limit * (mean * a * x + deviation * b * y) + slope * cube
    return ((target - slope * g) * cube - limit * total) / rise


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
def _turned(frame, e1, e2, e6):
    """Three strains of an element in Cartesian axes."""
    return (
        frame[0] * e1,
        frame[1] * e1 + frame[2] * e2 + frame[3] * e6,
        frame[4] * e1 + frame[5] * e6,
    )


@njit(cache=True, error_model="numpy", forceinline=True)
def _turned_back(frame, e1, e2, e6):
    c1 = e1 / frame[0]
    c6 = (e6 - frame[4] * c1) / frame[5]
    return c1, (e2 - frame[1] * c1 - frame[3] * c6) / frame[2], c6


@njit(cache=True, error_model="numpy")
def _moved(w, look, norm, count):
    """By how much elements of a row have come nearer to yield than they have room for, squared.

    The von Mises stress of what strains have changed by is convex over the thickness, so that no
    layer has come nearer by more than the larger one of the outermost two.
    """
    first, second, farthest = norm[0], norm[1], norm[5]
    third, fourth, fifth = norm[2], norm[3], norm[4]
    for k in range(count):
        m1 = w[STRAINS * STRIDE + k] - look[k]
        m2 = w[(STRAINS + 1) * STRIDE + k] - look[STRIDE + k]
        m6 = w[(STRAINS + 2) * STRIDE + k] - look[2 * STRIDE + k]
        b1 = farthest * (w[(STRAINS + 3) * STRIDE + k] - look[3 * STRIDE + k])
        b2 = farthest * (w[(STRAINS + 4) * STRIDE + k] - look[4 * STRIDE + k])
        b6 = farthest * (w[(STRAINS + 5) * STRIDE + k] - look[5 * STRIDE + k])
        mu, mv, mw = first * m1 + second * m2, third * m1 - fourth * m2, fifth * m6
        bu, bv, bw = first * b1 + second * b2, third * b1 - fourth * b2, fifth * b6
        even = 0.25 * (mu * mu + bu * bu) + 0.75 * (mv * mv + bv * bv) + 3.0 * (mw * mw + bw * bw)
        odd = 0.5 * mu * bu + 1.5 * mv * bv + 6.0 * mw * bw
        w[OVER * STRIDE + k] = even + abs(odd) - look[ROOM * STRIDE + k]


@njit(cache=True, error_model="numpy")
def _copied(w, strain, j, first, count):
    for part in range(6):
        for k in range(count):
            w[(STRAINS + part) * STRIDE + k] = strain[j, part, first + k]


LAYERS_MAX = _W = 512
"""Of an element, and as many flow at a time."""
_USUAL = 8
"""Layers that loops are compiled for apart, as they are too few for one of unknown length."""
# Rows of work arrays, of constant distance, by which the compiler sees that they do not overlap: of
# the layers of one element, and of those that flow.
_EXCESS, _LEFT = 3, 4
_LIMIT, _MULTIPLIER, _STEP, _FLOWING = 3, 4, 5, 6


@njit(cache=True, error_model="numpy", forceinline=True)
def _excesses(layers, mean, bent, heights, number, flow, trial):
    """Trial stress, its von Mises stress squared and the excess of that over yield, of layers."""
    p1, p2, p6, done = layers[0], layers[1], layers[2], layers[3]
    for n in range(number):
        z = heights[n]
        u, v, w = _trial(
            mean[0] + z * bent[0], mean[1] + z * bent[1], mean[2] + z * bent[2],
            p1[n], p2[n], p6[n], flow,
        )  # fmt: skip
        limit, square = flow[2] + flow[3] * done[n], _square(u, v, w)
        trial[n], trial[_W + n], trial[2 * _W + n] = u, v, w
        trial[_EXCESS * _W + n], trial[_LEFT * _W + n] = _excess(square, limit), square


@njit(cache=True, error_model="numpy")
def _room(layers, number, flow, trial):
    """By how much the von Mises stress may rise in any layer of an element, signed, squared."""
    least = np.inf
    for n in range(number):
        left = flow[2] + flow[3] * layers[3, n] - np.sqrt(trial[_LEFT * _W + n])
        if not left >= least:
            least = left
    return least * abs(least)


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
def _sum_all(layers, where, count, heights, frame, sums):
    for n in range(count):
        j, k, slot = where[2, n], where[3, n], where[4, n]
        if heights.size == _USUAL:
            _sum_up(layers[slot], heights, _USUAL, frame[j, k], sums[slot])
        else:
            _sum_up(layers[slot], heights, heights.size, frame[j, k], sums[slot])


@njit(cache=True, error_model="numpy", forceinline=True, fastmath={"reassoc", "contract", "nsz"})
def _sum_up(layers, heights, number, frame, sums):
    """Mean and curvature of the plastic strains of an element, see `layers.Layers`."""
    p1, p2, p6 = layers[0], layers[1], layers[2]
    square = a = b = c = d = e = f = 0.0
    for n in range(number):
        z = heights[n]
        square += z * z
        a, b, c = a + p1[n], b + p2[n], c + p6[n]
        d, e, f = d + z * p1[n], e + z * p2[n], f + z * p6[n]
    one = 1.0 / number
    sums[0], sums[1], sums[2] = _turned_back(frame, one * a, one * b, one * c)
    sums[3], sums[4], sums[5] = _turned_back(frame, d / square, e / square, f / square)


@njit(cache=True, error_model="numpy", fastmath={"reassoc", "contract", "nsz"})
def _energies(layers, flow):
    """Of the layers of an element, J/m3: elastic, of the plastic strains alone; used up; kept."""
    p1, p2, p6, done = layers[0], layers[1], layers[2], layers[3]
    first, second = 0.25 * flow[0] / (1.0 - flow[1]), 0.25 * flow[0] / (1.0 + flow[1])
    elastic = used = kept = 0.0
    for n in range(done.size):
        total, apart = p1[n] + p2[n], p1[n] - p2[n]
        elastic += first * total * total + second * (apart * apart + p6[n] * p6[n])
        used += done[n] * (flow[2] + 0.5 * flow[3] * done[n])
        kept += 0.75 * total * total + 0.25 * (apart * apart + p6[n] * p6[n])
    one = 1.0 / done.size
    return one * elastic, one * used, one * (2.0 / 3.0) * flow[4] * kept


@njit(cache=True, error_model="numpy")
def energies(layers, slots, frame, flow, out):
    """Write what the plastic strains of all elements alone would have, used up and kept, J."""
    out[:] = 0.0
    for j in range(slots.shape[0]):
        for k in range(slots.shape[1]):
            if slots[j, k] > 0:
                elastic, used, kept = _energies(layers[slots[j, k]], flow)
                volume = frame[j, k, 6]
                out[0] += volume * elastic
                out[1] += volume * used
                out[2] += volume * kept


@njit(cache=True, error_model="numpy")
def flow_on(strain, rest, spacings, frame, heights, flow, norm, layers, sums, look, slots, free,
            changed):  # fmt: skip
    """Bring the layers of all elements up to date once mean strains have been reached.

    Layers are looked at only where strains have changed, since they were looked at last, by as much
    as the element then had room for before any layer yields; there they are where they would
    be had all been looked at.

    Parameters
    ----------
    strain : ndarray, shape (elements_along, 6, elements_around)
        e_11, e_22, 2 e_12 and k_11, k_22, 2 k_12 in the coordinates of the elements; or control
        points, m, of which `mean_kernel` makes them.
    rest, spacings
        See `mean_kernel.strains`; None with strains.
    frame : ndarray, shape (elements_along, elements_around, 7)
        See `cartesian_frame`; the last one is the volume of an element, m3.
    heights : ndarray, shape (layers,)
        Above the middle surface, m; all count alike.
    flow : Flow
    norm : tuple of float
        See `norm_of`.
    layers, sums : ndarray
        See `layers.Layers`; what flows is written into free slots.
    look : ndarray, shape (pieces, elements_along, `LOOKED`, `mean_kernel.STRIDE`)
        Of the elements, `mean_kernel.WIDTH` a piece, the strains that were looked at last, and the
        square of how much the von Mises stress could rise then in any layer, Pa2; negative where
        an element has to be looked at.
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
    along, around = slots.shape
    w, trial = np.empty(ROWS * STRIDE), np.empty(5 * _W)
    picked = np.empty(WIDTH + 1, dtype=np.int64)
    flowing, where = np.empty(_FLOWING * _W), np.empty((5, _W), dtype=np.int64)
    for piece in range(look.shape[0]):
        first = piece * WIDTH
        count = min(WIDTH, around - first)
        if rest is not None:
            begin(w, strain, first, count, spacings)
        for j in range(along):
            if rest is not None:
                advance(w, strain, j, first, count, spacings, rest[piece, j].ravel())
            else:
                _copied(w, strain, j, first, count)
            last = look[piece, j].ravel()
            _moved(w, last, norm, count)
            picks = 0
            for k in range(count):
                picked[picks] = k
                picks += not w[OVER * STRIDE + k] < 0.0  # what is not a number is looked at
            for pick in range(picks):
                k = picked[pick]
                column = first + k
                for part in range(6):
                    last[part * STRIDE + k] = w[(STRAINS + part) * STRIDE + k]
                own = frame[j, column]
                mean = _turned(own, last[k], last[STRIDE + k], last[2 * STRIDE + k])
                bent = _turned(
                    own, last[3 * STRIDE + k], last[4 * STRIDE + k], last[5 * STRIDE + k]
                )
                slot = slots[j, column]
                if number == _USUAL:  # known to the compiler
                    _excesses(layers[slot], mean, bent, heights, _USUAL, flow, trial)
                else:
                    _excesses(layers[slot], mean, bent, heights, number, flow, trial)
                before = waiting
                for n in range(number):
                    if trial[_EXCESS * _W + n] > 0.0:
                        for part in range(3):
                            flowing[part * _W + waiting] = trial[part * _W + n]
                        flowing[_LIMIT * _W + waiting] = flow[2] + flow[3] * layers[slot, 3, n]
                        where[0, waiting], where[1, waiting] = free[used], n
                        waiting += 1
                if waiting == before:
                    last[ROOM * STRIDE + k] = _room(layers[slot], number, flow, trial)
                    continue
                last[ROOM * STRIDE + k] = 0.0
                layers[free[used]] = layers[slot]
                slots[j, column] = free[used]
                changed[used] = j * around + column
                where[2, elements], where[3, elements] = j, column
                where[4, elements] = free[used]
                used += 1
                elements += 1
                if waiting + number > _W:
                    _flow(layers, flowing, where, waiting, flow)
                    _sum_all(layers, where, elements, heights, frame, sums)
                    waiting = elements = 0
    _flow(layers, flowing, where, waiting, flow)
    _sum_all(layers, where, elements, heights, frame, sums)
    return used


@njit(cache=True, error_model="numpy")
def sum_up(layers, slots, heights, frame, sums):
    """Write what the layers in the slots of all elements that have yielded add up to."""
    for j in range(slots.shape[0]):
        for k in range(slots.shape[1]):
            if slots[j, k] > 0:
                slot = slots[j, k]
                _sum_up(layers[slot], heights, heights.size, frame[j, k], sums[slot])


def norm_of(frame: np.ndarray, heights: np.ndarray, flow: Flow) -> tuple[float, ...]:
    """One norm of strains for all elements, by which none comes nearer to yield than it says.

    That of a mean element without shear, times what an element may have more at most.

    Parameters
    ----------
    frame : ndarray, shape (elements_along, elements_around, 7)
    heights : ndarray
    flow : Flow

    Returns
    -------
    tuple of float
        Coefficients of 11 and 22 in the sum of the stress, in its difference, of 2 12 in its shear,
        as in `_trial`, Pa; and the height of the outermost layer, m.
    """
    sums, shear = flow.youngs_modulus / np.array([1 - flow.poisson_ratio, 1 + flow.poisson_ratio])
    form = np.diag([0.0, 0.0, 0.75 * shear**2])
    form[:2, :2] = 0.25 * sums**2 + 0.75 * shear**2 * np.array([[1.0, -1.0], [-1.0, 1.0]])
    f = frame.reshape(-1, 7).T
    turned = np.zeros((f.shape[1], 3, 3))
    turned[:, 0, 0], turned[:, 1, 0], turned[:, 1, 1], turned[:, 1, 2] = f[:4]
    turned[:, 2, 0], turned[:, 2, 2] = f[4:6]
    mean = np.array([f[0].mean(), f[2].mean(), f[5].mean()])
    root = np.linalg.cholesky(form).T  # form = root' root
    beside = root @ turned @ np.linalg.inv(root @ np.diag(mean))
    more = (1 + 1e-9) * np.linalg.norm(beside, ord=2, axis=(1, 2)).max()
    one, two, six = more * mean
    return (
        sums * one, sums * two, shear * one, shear * two, 0.5 * shear * six,
        np.abs(heights).max(),
    )  # fmt: skip


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
