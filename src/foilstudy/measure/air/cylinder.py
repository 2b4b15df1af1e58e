"""The air about a straight cylindrical wall of finite length.

Inside, the wall ends at two rigid plates, so that the waves of the wall are eigenfunctions. Outside
it goes on as a rigid cylinder (a baffle), and waves along it couple.
"""

from __future__ import annotations

import numpy as np

from foilstudy.measure.air.potential import inside, outside
from foilstudy.measure.air.waves import Wall, Waves

_REACH, _NODES, _SPLITS = 12, 8, 14
"""Of the integral over waves along the baffled wall: its end over the largest wave number taken,
nodes a panel of pi / length, and halvings of the first panel, where the integrand has a
logarithm."""


def cylinder_thickness(waves: Waves) -> np.ndarray:
    """Thickness of air on both sides between waves, for means over elements, shape (r, r), m.

    The mean flow out of the enclosed volume has no mass: it leaves by a vent, or is compressed.
    """
    wall, n, m = waves.wall, waves.n, waves.m
    thickness = np.zeros((n.size, n.size))
    for around in np.unique(n):
        half_waves = np.arange(m[n == around].max() + 1)
        block = _outside(int(around), half_waves, waves)
        within = half_waves >= (around == 0)
        q = np.pi * half_waves[within] / wall.length
        block[half_waves[within], half_waves[within]] += inside(around, q, wall.radius)
        for sine in (False, True):
            which = np.flatnonzero((n == around) & (waves.sine == sine))
            thickness[np.ix_(which, which)] = block[np.ix_(m[which], m[which])]
    return thickness / np.outer(waves.mean, waves.mean)


def _outside(n: int, m: np.ndarray, waves: Waves) -> np.ndarray:
    """Thickness of air outside in cosines along a wall that goes on rigidly, m.

    (1/pi) int_0^inf d_n(k) c_i(k) c_j(k) dk with their transforms c, real or imaginary by parity.
    """
    wall, length = waves.wall, waves.wall.length
    k, weight = _nodes(wall, waves.limit)
    q = np.pi * m[:, None] / length
    below, above = (0.5 * length * np.sinc(0.5 * length * (k + s * q) / np.pi) for s in (-1, 1))
    parity = np.where(m % 2, -1.0, 1.0)
    sign = np.where(m // 2 % 2, -1.0, 1.0)
    size = np.sqrt(np.where(m > 0, 2.0, 1.0) / length)
    transform = (sign * size)[:, None] * (below + parity[:, None] * above)
    integral = (transform * (weight * outside(n, k, wall.radius))) @ transform.T / np.pi
    return np.where(np.equal.outer(parity, parity), integral, 0.0)


def _nodes(wall: Wall, limit: float) -> tuple[np.ndarray, np.ndarray]:
    """Gauss points and weights of the integral over wave numbers along the wall, 1/m."""
    panel = np.pi / wall.length
    first = panel * np.concatenate([[0.0], 0.5 ** np.arange(_SPLITS, -1.0, -1.0)])
    ends = np.concatenate([first, panel * np.arange(2, int(_REACH * limit / panel) + 2)])
    node, weight = np.polynomial.legendre.leggauss(_NODES)
    half = 0.5 * np.diff(ends)[:, None]
    return (0.5 * (ends[1:] + ends[:-1])[:, None] + half * node).ravel(), (half * weight).ravel()
