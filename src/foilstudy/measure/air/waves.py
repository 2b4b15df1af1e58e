"""The added mass of a cylindrical wall of finite length in the waves that it can carry.

Inside, the wall ends at two rigid plates, so that cosines along the wall and waves around are the
eigenfunctions of the added mass. Outside, it goes on as a rigid cylinder (a baffle), and waves
along it couple. The sum is a matrix in the cosines for each number of waves around.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.measure.air.potential import inside, outside

WAVES = 250
"""Waves on the wall that are taken one by one, about: on a cylinder of 0.2 m and 0.17 m those
longer than 37 mm. Four times as many change the first eigenfrequency of 50 um by 0.03 %."""
_ELEMENTS = 4
"""Elements in a wave, at least."""
_REACH, _NODES, _SPLITS = 12, 8, 14
"""Of the integral over waves along the baffled wall: its end over the largest wave number taken,
nodes a panel of pi / length, and halvings of the first panel, where the integrand has a
logarithm."""


@dataclass(frozen=True)
class Wall:
    """A developed cylindrical wall in equal elements.

    Attributes
    ----------
    around, along : int
        Elements.
    radius, length : float
        m.
    """

    around: int
    along: int
    radius: float
    length: float

    @property
    def area(self) -> float:
        """m2."""
        return 2 * np.pi * self.radius * self.length

    def shortest(self, most: int = WAVES) -> float:
        """Largest wave number that is taken, 1/m: of so many waves, and resolved by elements."""
        size = max(2 * np.pi * self.radius / self.around, self.length / self.along)
        return float(min(np.sqrt(4 * np.pi * most / self.area), 2 * np.pi / (_ELEMENTS * size)))


@dataclass(frozen=True, eq=False)
class AirOfWaves:
    """Thickness of air that moves with a wall, an operator: local + U diag(w) U^T.

    Attributes
    ----------
    local : float
        That of all waves shorter than those taken, m.
    shapes : ndarray, shape (elements along * around, r)
        U: of unit mean square over the wall, 1/m, at the centres of the elements.
    weights : ndarray, shape (r,)
        What longer waves have more, m, positive.
    """

    local: float
    shapes: np.ndarray
    weights: np.ndarray

    def __repr__(self) -> str:
        return f"<AirOfWaves: {self.weights.size} waves, {1e3 * self.local:.2g} mm beyond them>"

    @classmethod
    def of(cls, wall: Wall, most: int = WAVES) -> AirOfWaves:
        """Of both sides of a wall.

        Waves beyond those taken are given the plane wall's 2 / k, averaged up to twice the wave
        number at which they begin.
        """
        limit = wall.shortest(most)
        local = 2 * np.log(2) / limit
        angle = 2 * np.pi * (np.arange(wall.around) + 1) / wall.around
        height = (np.arange(wall.along) + 0.5) / wall.along
        shapes, weights = [], []
        for n in range(int(limit * wall.radius) + 1):
            rest = np.sqrt(max(limit**2 - (n / wall.radius) ** 2, 0.0))
            m = np.arange(int(rest * wall.length / np.pi) + 1)
            q = np.pi * m / wall.length
            thickness = _outside(n, m, wall, limit)
            within = (n > 0) | (m > 0)  # the mean flow leaves by the vent, or is compressed
            thickness[m[within], m[within]] += inside(n, q[within], wall.radius)
            # the mean of a wave over an element is less than its value in the middle
            mean = np.sinc(n / wall.around) * np.sinc(0.5 * m / wall.along)
            values, turn = np.linalg.eigh(thickness / np.outer(mean, mean) - local * np.eye(m.size))
            axial = np.cos(np.pi * np.outer(height, m)) * np.sqrt(np.where(m > 0, 2.0, 1.0))
            axial = axial @ turn
            for around in (np.cos, np.sin)[: 2 if n else 1]:
                circle = around(n * angle) * (np.sqrt(2.0) if n else 1.0)
                both = axial[:, None, :] * circle[None, :, None] / np.sqrt(wall.area)
                shapes.append(both.reshape(-1, m.size))
                weights.append(values)
        return cls(local, np.hstack(shapes), np.concatenate(weights))


def _outside(n: int, m: np.ndarray, wall: Wall, limit: float) -> np.ndarray:
    """Thickness of air outside in cosines along a wall that goes on rigidly, m.

    (1/pi) int_0^inf d_n(k) c_i(k) c_j(k) dk with their transforms c, real or imaginary by parity.
    """
    length = wall.length
    panel = np.pi / length
    first = panel * np.concatenate([[0.0], 0.5 ** np.arange(_SPLITS, -1.0, -1.0)])
    ends = np.concatenate([first, panel * np.arange(2, int(_REACH * limit / panel) + 2)])
    node, weight = np.polynomial.legendre.leggauss(_NODES)
    half = 0.5 * np.diff(ends)[:, None]
    k = (0.5 * (ends[1:] + ends[:-1])[:, None] + half * node).ravel()
    weight = (half * weight).ravel()
    q = np.pi * m[:, None] / length
    below, above = (0.5 * length * np.sinc(0.5 * length * (k + s * q) / np.pi) for s in (-1, 1))
    parity = np.where(m % 2, -1.0, 1.0)
    sign = np.where(m // 2 % 2, -1.0, 1.0)
    size = np.sqrt(np.where(m > 0, 2.0, 1.0) / length)
    transform = (sign * size)[:, None] * (below + parity[:, None] * above)
    integral = (transform * (weight * outside(n, k, wall.radius))) @ transform.T / np.pi
    return np.where(np.equal.outer(parity, parity), integral, 0.0)
