"""Loads on a sheet: dead forces, and moments that turn with an edge.

A load is conservative: it has a work, whose derivatives are the forces on the control points and
the load stiffness.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import scipy.sparse as sparse

from foilstudy.model.patch import Patch
from foilstudy.model.supports.edges import edge_lines
from foilstudy.model.supports.interpolation import (
    along_weights,
    around_weights,
    as_field,
    as_vector,
    gauss_line,
)

_MIN_ARM = 1e-6
"""Slope in the plane of a moment, relative to the whole slope, below which it has no angle."""


class Load(Protocol):
    """A conservative load of given size."""

    def work_and_force(self, points: np.ndarray) -> tuple[float, np.ndarray]:
        """Work done from the reference shape (J), and its gradient (3, rows, columns), N."""
        ...

    def stiffness(self, points: np.ndarray) -> sparse.csr_matrix:
        """Second derivative of the work, order row, column, component, N/m."""
        ...


@dataclass(frozen=True, eq=False)
class Loading:
    """A multiple of a load as a term of a problem: its potential is minus the work.

    Attributes
    ----------
    load : Load
    factor : float
    """

    load: Load
    factor: float = 1.0
    energy_names = ("load",)

    def start(self) -> None:
        """A conservative load has no memory."""

    def evolved(self, points: np.ndarray, state: None) -> None:
        """A conservative load has no memory."""

    def force(self, points: np.ndarray, out: np.ndarray, state: None = None) -> np.ndarray:
        """See `foilstudy.solve.problem.Term`."""
        work, force = self.load.work_and_force(points)
        np.multiply(force, -self.factor, out=out)
        return np.array([-self.factor * work])

    def tangent(self, points: np.ndarray, state: None = None) -> sparse.csr_matrix:
        """See `foilstudy.solve.problem.Term`."""
        return -self.factor * self.load.stiffness(points)


@dataclass(frozen=True, eq=False)
class DeadLoad:
    """Forces on the control points that keep their size and direction.

    Attributes
    ----------
    reference : ndarray, shape (3, rows, columns)
        Control points where the work is zero, m.
    force : ndarray, same shape
        N.
    """

    reference: np.ndarray
    force: np.ndarray

    def work_and_force(self, points: np.ndarray) -> tuple[float, np.ndarray]:
        """See `Load`."""
        return float(np.sum(self.force * (points - self.reference))), self.force

    def stiffness(self, points: np.ndarray) -> sparse.csr_matrix:
        """See `Load`."""
        return sparse.csr_matrix((points.size, points.size))


def point_load(
    patch: Patch, reference: np.ndarray, at: tuple[float, float], force: np.ndarray
) -> DeadLoad:
    """Force (3,), N, on the point of the sheet at parameters around and along, m."""
    weights = np.outer(
        along_weights(patch, np.array([at[1]]))[0], around_weights(patch, np.array([at[0]]))[0]
    )
    return DeadLoad(reference, np.multiply.outer(np.asarray(force, dtype=float), weights))


def edge_load(patch: Patch, reference: np.ndarray, edge: str, line_force: np.ndarray) -> DeadLoad:
    """Force (3,) per length of the undeformed edge, N/m."""
    weights, lengths = _edge_quadrature(patch, reference, edge)
    outer, inner = edge_lines(patch, edge)
    along_edge = lengths @ weights
    force = np.zeros((patch.rows * patch.columns, 3))
    for line in (outer, inner):
        force[line] = np.multiply.outer(0.5 * along_edge, np.asarray(line_force, dtype=float))
    return DeadLoad(reference, as_field(force, patch))


def area_load(patch: Patch, reference: np.ndarray, traction: np.ndarray) -> DeadLoad:
    """Force (3,) per undeformed area, as self weight is, Pa."""
    weights, areas = surface_quadrature(patch, reference)
    return DeadLoad(
        reference,
        np.multiply.outer(
            np.asarray(traction, dtype=float),
            np.einsum("yx,yj,xi->ji", areas, weights[1], weights[0]),
        ),
    )


def surface_quadrature(
    patch: Patch, shape: np.ndarray
) -> tuple[tuple[np.ndarray, np.ndarray], np.ndarray]:
    """Points of a 3 x 3 Gauss rule per element: weights of the control points, and areas.

    Returns
    -------
    tuple of ndarray
        Weights of the control columns (points around, columns) and rows (points along, rows).
    ndarray, shape (points along, points around)
        m2.
    """
    start = 0.5 * patch.size_around if patch.periodic else 0.0
    around, length_around = gauss_line(patch.elements_around, patch.size_around, start)
    along, length_along = gauss_line(patch.elements_along, patch.size_along)
    a1, a2 = (
        np.einsum(
            "yj,xi,cji->cyx",
            along_weights(patch, along, orders[1]),
            around_weights(patch, around, orders[0]),
            shape,
        )
        for orders in ((1, 0), (0, 1))
    )
    stretch = np.linalg.norm(np.cross(a1, a2, axis=0), axis=0)
    areas = stretch * length_along[:, None] * length_around
    return (around_weights(patch, around), along_weights(patch, along)), areas


class EdgeMoment:
    """Moment about a fixed axis, spread evenly over an edge, that turns with the edge.

    Its work is the mean over the edge of moment times the angle that the slope across the edge has
    turned about the axis. Whole turns are counted along the sheet from the opposite edge, which
    does not turn, so that the work is continuous however far the sheet is rolled up.

    Parameters
    ----------
    patch : Patch
    reference : ndarray, shape (3, rows, columns)
        Control points where the work is zero, m.
    edge : str
    moment : ndarray, shape (3,)
        Axis times size, N m.
    """

    def __init__(self, patch: Patch, reference: np.ndarray, edge: str, moment: np.ndarray):
        self._patch = patch
        self._edge = edge
        self._size = float(np.linalg.norm(moment))
        if self._size == 0.0:
            raise ValueError("an edge moment needs an axis and a size other than zero")
        axis = np.asarray(moment, dtype=float) / self._size
        # any two directions with which the axis is a right-handed triad
        first = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
        first /= np.linalg.norm(first)
        self._plane = np.stack([first, np.cross(axis, first)])
        weights, lengths = _edge_quadrature(patch, reference, edge)
        self._shares = lengths / lengths.sum()
        self._slopes = self._slope_operator(weights)
        self._weights = weights
        self._reference_angles = self._angles(reference)
        if not np.isfinite(self.work_and_force(reference)[0]):
            raise ValueError(
                f"the slope at the {edge} edge is parallel to the axis of its moment, about which "
                "it has no angle"
            )

    def work_and_force(self, points: np.ndarray) -> tuple[float, np.ndarray]:
        """See `Load`; both are NaN where the slope is parallel to the axis and has no angle."""
        turned = self._angles(points) - self._reference_angles
        slope, arm = self._slope_in_plane(points)
        # gradient of the angle: the slope turned by 90 degrees over its square
        gradient = np.stack([-slope[1], slope[0]]) / arm**2
        weighted = self._size * self._shares * gradient
        force = self._slopes.T @ (weighted.T @ self._plane)
        work = self._size * float(self._shares @ (turned + 0.0 * arm))
        return work, as_field(force, self._patch)

    def stiffness(self, points: np.ndarray) -> sparse.csr_matrix:
        """See `Load`."""
        (x, y), arm = self._slope_in_plane(points)
        scale = self._size * self._shares / arm**4
        second = np.array([[2 * x * y, y**2 - x**2], [y**2 - x**2, -2 * x * y]]) * scale
        blocks = np.einsum("abk,ac,bd->kcd", second, self._plane, self._plane)
        spread = sparse.kron(self._slopes, sparse.identity(3), format="csr")
        count = len(blocks)
        middle = sparse.bsr_matrix((blocks, np.arange(count), np.arange(count + 1)))
        return (spread.T @ middle @ spread).tocsr()

    def _slope_operator(self, weights):
        """Slope across the edge, up to a factor, at its quadrature points: points x controls."""
        outer, inner = edge_lines(self._patch, self._edge)
        size = self._patch.rows * self._patch.columns
        spread = sparse.csr_matrix(weights)
        columns = [
            sparse.csr_matrix((np.ones(len(line)), (np.arange(len(line)), line)), (len(line), size))
            for line in (outer, inner)
        ]
        return (spread @ (columns[0] - columns[1])).tocsr()

    def _slope_in_plane(self, points):
        slope = self._slopes @ as_vector(points).reshape(-1, 3)
        flat = self._plane @ slope.T
        arm = np.linalg.norm(flat, axis=0)
        return flat, np.where(arm > _MIN_ARM * np.linalg.norm(slope, axis=1), arm, np.nan)

    def _angles(self, points):
        """Angle of the slope at the quadrature points, whole turns included, shape (n,)."""
        lines = np.moveaxis(points, 1 if self._edge in ("bottom", "top") else 2, 1)
        if self._edge in ("bottom", "left"):
            lines = lines[:, ::-1]
        slopes = np.einsum("kc,clm,nm->kln", self._plane, np.diff(lines, axis=1), self._weights)
        return np.unwrap(np.arctan2(slopes[1], slopes[0]), axis=0)[-1]


def _edge_quadrature(patch, shape, edge) -> tuple[np.ndarray, np.ndarray]:
    """Weights of the control points along an edge, (n, m), and lengths (n,), m, at Gauss points."""
    outer, inner = edge_lines(patch, edge)
    if edge in ("bottom", "top"):
        start = 0.5 * patch.size_around if patch.periodic else 0.0
        at, lengths = gauss_line(patch.elements_around, patch.size_around, start)
        weights, slopes = (around_weights(patch, at, order) for order in (0, 1))
    else:
        at, lengths = gauss_line(patch.elements_along, patch.size_along)
        weights, slopes = (along_weights(patch, at, order) for order in (0, 1))
    points = as_vector(shape).reshape(-1, 3)
    tangent = slopes @ (0.5 * (points[outer] + points[inner]))
    return weights, lengths * np.linalg.norm(tangent, axis=1)
