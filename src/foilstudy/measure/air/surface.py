"""A foil and its rings as a wall between two volumes of air: flux through it, enclosed volume."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sparse

from foilstudy.measure.air.waves import Wall
from foilstudy.measure.stiffness import Rings
from foilstudy.model.patch import RING_ROWS, Patch

_GAUSS = np.polynomial.legendre.leggauss(3)
_NODES, _WEIGHTS = 0.5 * (_GAUSS[0] + 1), 0.5 * _GAUSS[1]
"""Exact for the volume below a quadratic spline, of degree five in either parameter."""
_VALUES = np.array([0.5 * (1 - _NODES) ** 2, 0.5 + _NODES * (1 - _NODES), 0.5 * _NODES**2])
_SLOPES = np.array([_NODES - 1, 1 - 2 * _NODES, _NODES])
"""Of the three basis functions of an element at the nodes, shape (3, nodes)."""


@dataclass(frozen=True, eq=False)
class WettedSurface:
    """The wall; normals point out of the enclosed volume.

    Attributes
    ----------
    patch : Patch
        Periodic.
    points : ndarray, shape (3, rows, columns)
        Control points, m.
    """

    patch: Patch
    points: np.ndarray

    def __repr__(self) -> str:
        return f"<WettedSurface: {self._normals.shape[0]} elements, {1e3 * self.volume:.3g} l>"

    @property
    def wall(self) -> Wall:
        """The foil, developed into a straight cylinder."""
        patch = self.patch
        radius = patch.elements_around * patch.size_around / (2 * np.pi)
        length = patch.elements_along * patch.size_along
        return Wall(patch.elements_around, patch.elements_along, radius, length)

    @cached_property
    def flux(self) -> sparse.csr_matrix:
        """Volume that displacements sweep in each element, m2, shape (elements, 3 * points).

        The exact integral of the displacement over the area vectors of the spline.
        """
        patch = self.patch
        elements = self._windows[0]
        columns = 3 * elements[:, :, None] + np.arange(3)
        rows = np.broadcast_to(np.arange(len(elements))[:, None, None], columns.shape)
        shape = (len(elements), 3 * patch.rows * patch.columns)
        values = self._normals.reshape(-1, 9, 3)
        return sparse.csr_matrix((values.ravel(), (rows.ravel(), columns.ravel())), shape=shape)

    @cached_property
    def _windows(self) -> tuple[np.ndarray, np.ndarray]:
        """Control points of each element, their numbers, shape (elements, 9), and places."""
        patch = self.patch
        j, i = np.meshgrid(
            np.arange(patch.elements_along), np.arange(patch.elements_around), indexing="ij"
        )
        node = np.arange(9)
        index = (j.reshape(-1, 1) + node // 3) * patch.columns
        index = index + (i.reshape(-1, 1) + node % 3) % patch.columns
        return index, self.points.reshape(3, -1).T[index].reshape(-1, 3, 3, 3)

    @cached_property
    def _normals(self) -> np.ndarray:
        """Integral of each basis function times the area vector, m2, (elements, 3, 3, 3)."""
        control = self._windows[1]
        around = np.einsum("erci,rp,cq->epqi", control, _VALUES, _SLOPES)
        along = np.einsum("erci,rp,cq->epqi", control, _SLOPES, _VALUES)
        normal = np.cross(around, along)
        weights = np.multiply.outer(_WEIGHTS, _WEIGHTS)
        return np.einsum("epqi,pq,rp,cq->erci", normal, weights, _VALUES, _VALUES)

    @cached_property
    def _caps(self) -> tuple[tuple[np.ndarray, np.ndarray, np.ndarray], ...]:
        """Centre, area vector (m2) and its moment (m3) of the end plates, lower and upper one.

        A plate is the cone from the ring's centre to the edge of the foil: a disc, if that is one.
        """
        found = []
        for rows, outwards in ((slice(0, RING_ROWS), -1.0), (slice(-RING_ROWS, None), 1.0)):
            ring = self.points[:, rows]
            centre = np.array([0.0, 0.0, ring[2].mean()])
            edge = ring.mean(axis=1).T - centre
            window = np.stack([edge, np.roll(edge, -1, axis=0), np.roll(edge, -2, axis=0)], axis=1)
            place = np.einsum("eri,rp->epi", window, _VALUES)
            step = np.einsum("eri,rp->epi", window, _SLOPES)
            swept = 0.5 * outwards * np.cross(place, step)
            moment = 2 / 3 * np.cross(place, swept)
            found.append((centre, *(np.einsum("epi,p->i", x, _WEIGHTS) for x in (swept, moment))))
        return tuple(found)

    @cached_property
    def volume(self) -> float:
        """Enclosed by foil and end plates, m3."""
        below = float(np.einsum("erci,erci->", self._windows[1], self._normals))
        return (below + sum(float(centre @ area) for centre, area, _ in self._caps)) / 3

    @cached_property
    def plates(self) -> np.ndarray:
        """Volume that the end plates sweep for each motion of the rings, m2 and m3, shape (12,)."""
        return np.concatenate([np.concatenate(each[1:]) for each in self._caps])

    def swept(self, rings: Rings) -> tuple[np.ndarray, np.ndarray]:
        """Growth of the enclosed volume with the interior and the rings, (interior,) and (12,)."""
        foil = np.asarray(self.flux.sum(axis=0)).ravel()
        return foil[rings.interior], rings.motion.T @ foil[rings.boundary] + self.plates
