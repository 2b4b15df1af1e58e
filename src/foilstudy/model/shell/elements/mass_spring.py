"""A model that is too little: springs along the edges of triangles, and hinges between these.

The control points of the patch are the nodes, on a lattice of triangles: odd rows stand half a
column further. Springs of one stiffness on equilateral triangles make a sheet of Poisson's ratio
1/3, E t = 2 k / sqrt(3) [Seung and Nelson, Phys. Rev. A 38, 1005, 1988]. Hinges of D e^2 / A on
their angles [Grinspun, Hirani, Desbrun and Schroeder, SCA 2003], e long and between triangles of
the area A, bend into a cylinder as a plate of stiffness D does, and into nothing else: a plate
element has 1/2 D (tr^2 - 2 (1 - nu) det) of its curvature, the hinges 1/2 D (tr^2 - 8/3 det), as
if Poisson's ratio were -1/3. A twist costs twice what it should, a dome half.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.patch import Patch
from foilstudy.model.shell.elements.assembly import Groups, no_blocks
from foilstudy.model.shell.section import Section

POISSON_RATIO = 1 / 3
"""Of the lattice, whatever the material says."""
_TINY = 1e-40
"""Imaginary step: derivatives of analytic functions by it are exact."""


@dataclass(frozen=True)
class MassSpring:
    """Springs and hinges on a closed lattice, stiff as Young's modulus and thickness say."""

    name: str = "mass_spring"

    def kernel(self, section: Section) -> MassSpringKernel:
        if not section.patch.periodic:
            raise ValueError("springs and hinges need a patch that is closed around")
        return MassSpringKernel(section)


def lattice_patch(diameter: float, height: float, edge: float) -> Patch:
    """The patch whose nodes make triangles that are nearest to equilateral ones of an edge, m.

    The second row and the last but one stand on the edges of the cylinder, where it is held.
    """
    around = np.arange(round(0.9 * np.pi * diameter / edge), round(1.1 * np.pi * diameter / edge))
    sizes = np.pi * diameter / around
    steps = np.maximum(np.round(height / (0.5 * np.sqrt(3) * sizes)), 2)
    best = np.abs(height / steps / sizes - 0.5 * np.sqrt(3)).argmin()
    along = int(steps[best])
    return Patch(int(around[best]), along + 1, float(sizes[best]), height / along)


def lattice_cylinder(patch: Patch, diameter: float) -> np.ndarray:
    """Nodes on a cylinder, shape (3, rows, columns), m."""
    row, column = np.indices((patch.rows, patch.columns))
    angle = 2 * np.pi * (column + 0.5 * (row % 2)) / patch.columns
    across = 0.5 * diameter * np.array([np.cos(angle), np.sin(angle)])
    return np.concatenate([across, (row[None] - 1) * patch.size_along])


class MassSpringKernel:
    """Energy, force and tangent of one section; see `ElementKernel`."""

    def __init__(self, section: Section):
        self._section = section
        modulus, thickness = section.law.material.youngs_modulus, section.thickness
        self._stretch = 0.5 * np.sqrt(3) * modulus * thickness
        self._springs, self._hinges = _springs(section.patch), _hinges(section.patch)
        self._lengths = _lengths(self._springs.gathered(section.reference))[1]
        rest = self._hinges.gathered(section.reference)
        self._angles = _angles(rest)
        first, second = _normals(rest)
        areas = 0.5 * (_size(first) + _size(second))
        plate = modulus * thickness**3 / (12 * (1 - POISSON_RATIO**2))
        self._bend = plate * np.sum((rest[:, 1] - rest[:, 0]) ** 2, axis=1) / areas

    def force(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        out[:] = 0.0
        way, lengths = _lengths(self._springs.gathered(points))
        stretch = lengths - self._lengths
        pull = (self._stretch * stretch / lengths)[:, None] * way
        self._springs.add_force(np.stack([-pull, pull], axis=1), out)
        corners = self._hinges.gathered(points)
        turned = self._turned(corners)
        self._hinges.add_force((self._bend * turned)[:, None, None] * _slopes(corners), out)
        return np.array(
            [0.5 * self._stretch * np.sum(stretch**2), 0.5 * np.sum(self._bend * turned**2), 0.0]
        )

    def tangent_blocks(self, points: np.ndarray | None) -> np.ndarray:
        points = self._section.reference if points is None else points
        blocks = no_blocks(self._section.patch)
        way, lengths = _lengths(self._springs.gathered(points))
        along = way / lengths[:, None]
        outer = along[:, :, None] * along[:, None]
        slack = (1 - self._lengths / lengths)[:, None, None]
        pair = self._stretch * (outer + slack * (np.eye(3) - outer))
        signs = np.array([[1.0, -1.0], [-1.0, 1.0]])
        self._springs.add_blocks(np.einsum("ab,scd->sacbd", signs, pair), blocks)
        self._hinges.add_blocks(self._hinge_hessians(self._hinges.gathered(points)), blocks)
        return blocks

    def _turned(self, corners: np.ndarray) -> np.ndarray:
        """Change of the angles since the rest shape, the shorter way round."""
        return (_angles(corners) - self._angles + np.pi) % (2 * np.pi) - np.pi

    def _hinge_hessians(self, corners: np.ndarray) -> np.ndarray:
        slopes, turned = _slopes(corners), self._turned(corners)
        hessian = np.einsum("hac,hbd->hacbd", slopes, slopes)
        for node in range(4):
            for c in range(3):
                aside = corners.astype(complex)
                aside[:, node, c] += 1j * _TINY
                second = _slopes(aside).imag / _TINY
                hessian[..., node, c] += turned[:, None, None] * second
        return self._bend[:, None, None, None, None] * hessian


def _springs(patch: Patch) -> Groups:
    """From every node to the right, up to the right and up to the left."""
    row, column = (each.ravel() for each in np.indices((patch.rows, patch.columns)))
    shift = row % 2
    ends = [(row, column + 1), (row + 1, column + shift), (row + 1, column + shift - 1)]
    rows = np.concatenate([np.stack([row, r], axis=1) for r, _ in ends])
    columns = np.concatenate([np.stack([column, c], axis=1) for _, c in ends])
    inside = (rows < patch.rows).all(axis=1)
    return Groups(patch, rows[inside], columns[inside])


def _hinges(patch: Patch) -> Groups:
    """Both ends of every edge between two triangles, then the tips on its left and right."""
    row, column = (each.ravel() for each in np.indices((patch.rows, patch.columns)))
    shift = row % 2
    right, left = column + shift, column + shift - 1  # of the two nodes above
    corners = [
        [(row, column), (row, column + 1), (row + 1, right), (row - 1, right)],
        [(row, column), (row + 1, right), (row + 1, left), (row, column + 1)],
        [(row, column), (row + 1, left), (row, column - 1), (row + 1, right)],
    ]
    rows = np.concatenate([np.stack([r for r, _ in each], axis=1) for each in corners])
    columns = np.concatenate([np.stack([c for _, c in each], axis=1) for each in corners])
    inside = ((rows >= 0) & (rows < patch.rows)).all(axis=1)
    return Groups(patch, rows[inside], columns[inside])


def _size(vectors: np.ndarray) -> np.ndarray:
    """Length; analytic, unlike that of numpy."""
    return np.sqrt(np.sum(vectors * vectors, axis=-1))


def _lengths(ends: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    way = ends[:, 1] - ends[:, 0]
    return way, _size(way)


def _normals(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of the two triangles of hinges, twice their areas long."""
    return (
        np.cross(x[:, 2] - x[:, 0], x[:, 2] - x[:, 1]),
        np.cross(x[:, 3] - x[:, 1], x[:, 3] - x[:, 0]),
    )


def _angles(x: np.ndarray) -> np.ndarray:
    """By which hinges are turned out of the plane, rad."""
    first, second = _normals(x)
    edge = x[:, 1] - x[:, 0]
    across = np.sum(np.cross(second, first) * edge, axis=1) / _size(edge)
    return np.arctan2(across, np.sum(first * second, axis=1))


def _slopes(x: np.ndarray) -> np.ndarray:
    """Derivatives of the angles by the corners, shape (hinges, 4, 3)."""
    edge = x[:, 1] - x[:, 0]
    length = _size(edge)[:, None]
    first, second = (n / np.sum(n * n, axis=1, keepdims=True) for n in _normals(x))

    def share(tip, end):
        return np.sum((x[:, tip] - x[:, end]) * edge, axis=1, keepdims=True) / length

    return np.stack(
        [
            share(2, 1) * first + share(3, 1) * second,
            -share(2, 0) * first - share(3, 0) * second,
            length * first,
            length * second,
        ],
        axis=1,
    )
