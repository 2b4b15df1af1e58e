"""The planes of the rings, which no part of a sheet passes, as a term of the potential energy.

A plane goes through three knots of its ring, and moves and turns with it. The barrier is that
between parts of the sheet, with half a thickness; the closest vector from the plane to a knot is
that from a triangle without bounds, so that gradient and second derivative are those of
`barrier`, and the forces on the three knots are what the plane passes on to its ring.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse
from numba import njit

from foilstudy.base.errors import Refusal
from foilstudy.model.contact.barrier import add_half_square, barrier
from foilstudy.model.contact.sizes import reach_on
from foilstudy.model.contact.springs import STIFFNESS, Springs
from foilstudy.model.contact.stencils import Pressing, of_points
from foilstudy.model.contact.surface import triangulation
from foilstudy.model.shell.section import Section


class RingPlanes(Springs):
    """Barrier between the planes of the rings and the sheet between them; without memory.

    Parameters
    ----------
    section : Section
        Of the sheet, on a closed patch.
    reach : float, optional
        m; see `sizes.reach_on`.
    stiffness : float
        See `options.BarrierContact`.

    Attributes
    ----------
    half, reach : float
        Half a thickness, and the gap beyond it at which the barrier begins, m.
    membrane_stiffness : float
        E t/(1 - nu^2), N/m.
    """

    energy_names, name = ("ring_plane",), "ring_plane"

    def __init__(self, section: Section, reach: float | None = None, stiffness: float = STIFFNESS):
        material, patch = section.law.material, section.patch
        membrane = material.youngs_modulus * section.thickness / (1 - material.poisson_ratio**2)
        super().__init__(triangulation(patch), membrane)
        self.half = 0.5 * section.thickness
        self.reach = reach_on(patch, section.thickness, reach)
        self._span = (self.half + self.reach) ** 2 - self.half**2
        self._size = stiffness * membrane * self.reach**2
        columns = patch.columns
        third = np.array([0, columns // 3, (2 * columns) // 3])
        # both turned so that the sheet is on the side of their normals
        self._rings = np.stack([third, self._surface.count - columns + third[::-1]])
        self._inner = columns, self._surface.count - columns
        self._knots: np.ndarray | None = None
        self._closed = np.empty((0, 4), dtype=np.int64)

    def __repr__(self) -> str:
        return f"<RingPlanes: reach {1e3 * self.reach:g} mm>"

    def start(self) -> None:
        """There is no memory."""

    def evolved(self, points: np.ndarray, state: None) -> None:
        """There is no memory."""

    def force(self, points: np.ndarray, out: np.ndarray, state: None = None) -> np.ndarray:
        """See `solve.problem.Term`.

        Raises
        ------
        Refusal
            If the first shape that is asked for is beyond the planes.
        """
        out[:] = 0.0
        if not self._reached(points):
            return np.array([np.inf])
        if not len(self._closed):
            return np.zeros(1)
        forces = np.zeros_like(self._knots)
        energy = _exert(self._knots, self._closed, self.half, self._span, self._size, forces)
        self._surface.gathered(forces, out)
        return np.array([energy])

    def tangent(self, points: np.ndarray, state: None = None) -> sparse.csr_matrix:
        """See `solve.problem.Term`.

        Raises
        ------
        ValueError
            If the energy is infinite there.
        """
        self.closed_at(points)
        blocks = _hessians(self._knots, self._closed, self.half, self._span, self._size)
        return self.on_points(self._closed, blocks)

    def numbers(self, state: None = None) -> dict[str, float]:
        """Of the last shape with a finite energy, by the names of quantities."""
        self._arrive()
        return {"contact_knots_at_rings": float(len(self._closed))}

    def knots(self) -> np.ndarray:
        """See `Springs`."""
        return self._knots

    def passable_share(self, motion: np.ndarray, closing: float) -> float:
        """Part of a motion of the knots in which no gap closes by more than a share of it.

        Parameters
        ----------
        motion : ndarray, shape (count, 3)
            From the last shape with a finite energy, m.
        closing : float
        """
        return _passable_share(
            self._knots, motion, self._rings, *self._inner, self.half, self.reach, closing
        )

    def springs(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """See `Springs`."""
        return _springs(self._knots, self._closed, self.half, self._span, self._size)

    def pressing(self) -> Pressing:
        """See `Springs`."""
        _, weights, direction = self.springs()
        force = _normal_forces(self._knots, self._closed, self.half, self._span, self._size)
        return of_points(self._closed, weights, direction, force)

    def _closed_knots(self) -> np.ndarray:
        return self._closed

    def _has_begun(self) -> bool:
        return self._knots is not None

    def _reached(self, points: np.ndarray) -> bool:
        knots = self._surface.knots(points)
        if self._knots is not None and np.array_equal(knots, self._knots):
            return True
        closed = np.empty((2 * len(knots), 4), dtype=np.int64)
        number = _closed(knots, self._rings, *self._inner, self.half, self.reach, closed)
        if number < 0:
            if self._knots is None:
                raise Refusal(
                    "the foil lies beyond the plane of a ring, or nearer than half its thickness, "
                    "in the shape from which it would be moved; start from one that does not, or "
                    "let the foil pass the planes."
                )
            return False
        self._knots, self._closed = knots, closed[:number].copy()
        return True


@njit(cache=True, error_model="numpy")
def _plane(knots, ring, normal):
    """Unit normal of the plane through three knots, towards the sheet, and its height along it."""
    i, j, k = ring
    for c in range(3):
        d, e = (c + 1) % 3, (c + 2) % 3
        normal[c] = (knots[j, d] - knots[i, d]) * (knots[k, e] - knots[i, e]) - (
            knots[j, e] - knots[i, e]
        ) * (knots[k, d] - knots[i, d])
    size = np.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
    height = 0.0
    for c in range(3):
        normal[c] /= size
        height += normal[c] * knots[i, c]
    return height


@njit(cache=True, error_model="numpy")
def _closed(knots, rings, first, last, half, reach, closed):
    """Write the knots within the reach of a plane, with its knots; -1 if any is within `half`."""
    normal, number = np.empty(3), 0
    for r in range(2):
        height = _plane(knots, rings[r], normal)
        for p in range(first, last):
            x, y, z = knots[p, 0], knots[p, 1], knots[p, 2]
            distance = normal[0] * x + normal[1] * y + normal[2] * z - height
            if not distance > half:  # what is not a number goes through
                return -1
            if distance < half + reach:
                closed[number, 0] = p
                closed[number, 1:] = rings[r]
                number += 1
    return number


@njit(cache=True, error_model="numpy")
def _passable_share(knots, motion, rings, first, last, half, reach, closing):
    """See `RingPlanes.passable_share`; the planes' own motion is in that of their knots."""
    normal, turned = np.empty(3), np.empty(3)
    moved = np.empty((3, 3))
    corner = np.arange(3)
    least = 1.0
    for r in range(2):
        height = _plane(knots, rings[r], normal)
        for m in range(3):
            for c in range(3):
                moved[m, c] = knots[rings[r, m], c] + motion[rings[r, m], c]
        height_then = _plane(moved, corner, turned)
        for p in range(first, last):
            gap, then = -height - half, -height_then - half
            for c in range(3):
                gap += normal[c] * knots[p, c]
                then += turned[c] * (knots[p, c] + motion[p, c])
            if then < reach and gap - then > least * closing * gap:
                least = min(least, closing * gap / (gap - then))
    return least


@njit(cache=True, error_model="numpy")
def _closest(x, a, change, w):
    """Weights of the vector from the plane of x[1:] to x[0], see `distance.closest`."""
    uu = uv = vv = ru = rv = 0.0
    for c in range(3):
        u, v, r = x[2, c] - x[1, c], x[3, c] - x[1, c], x[0, c] - x[1, c]
        uu += u * u
        uv += u * v
        vv += v * v
        ru += r * u
        rv += r * v
    det = uu * vv - uv * uv
    p, q = (vv * ru - uv * rv) / det, (uu * rv - uv * ru) / det
    a[0], a[1], a[2], a[3] = 1.0, p + q - 1.0, -p, -q
    change[:] = 0.0
    change[0, 1], change[0, 2] = 1.0, -1.0
    change[1, 1], change[1, 3] = 1.0, -1.0
    square = 0.0
    for c in range(3):
        w[c] = a[0] * x[0, c] + a[1] * x[1, c] + a[2] * x[2, c] + a[3] * x[3, c]
        square += w[c] * w[c]
    return square


@njit(cache=True, error_model="numpy")
def _exert(knots, closed, half, span, size, forces):
    """Add what planes exert to the forces on the knots, N; return the energy, J."""
    a, change, w = np.empty(4), np.empty((2, 4)), np.empty(3)
    total = 0.0
    for p in range(len(closed)):
        square = _closest(knots[closed[p]], a, change, w)
        value, slope, _ = barrier((square - half * half) / span)
        total += size * value
        for i in range(4):
            for c in range(3):
                forces[closed[p, i], c] += size * slope * 2.0 / span * a[i] * w[c]
    return total


@njit(cache=True, error_model="numpy")
def _normal_forces(knots, closed, half, span, size):
    """With which planes repel knots, shape (closed,), N."""
    a, change, w = np.empty(4), np.empty((2, 4)), np.empty(3)
    out = np.empty(len(closed))
    for p in range(len(closed)):
        square = _closest(knots[closed[p]], a, change, w)
        _, slope, _ = barrier((square - half * half) / span)
        out[p] = -size * slope * 2.0 / span * np.sqrt(square)
    return out


@njit(cache=True, error_model="numpy")
def _hessians(knots, closed, half, span, size):
    """Second derivatives of the energies, shape (closed, 12, 12), N/m."""
    a, change, w = np.empty(4), np.empty((2, 4)), np.empty(3)
    out = np.zeros((len(closed), 12, 12))
    for p in range(len(closed)):
        x = knots[closed[p]]
        square = _closest(x, a, change, w)
        _, slope, bend = barrier((square - half * half) / span)
        add_half_square(x, 2, a, change, w, size * slope * 2.0 / span, out[p])
        along = size * bend * 4.0 / (span * span)
        for i in range(12):
            for j in range(12):
                out[p, i, j] += along * a[i // 3] * w[i % 3] * a[j // 3] * w[j % 3]
    return out


@njit(cache=True, error_model="numpy")
def _springs(knots, closed, half, span, size):
    """See `pairs.springs`."""
    a, change, w = np.empty(4), np.empty((2, 4)), np.empty(3)
    stiffness, weights = np.empty(len(closed)), np.empty((len(closed), 4))
    direction = np.empty((len(closed), 3))
    for p in range(len(closed)):
        square = _closest(knots[closed[p]], a, change, w)
        _, slope, bend = barrier((square - half * half) / span)
        stiffness[p] = size * (4.0 * square * bend / (span * span) + 2.0 * slope / span)
        weights[p] = a
        direction[p] = w / np.sqrt(square)
    return stiffness, weights, direction
