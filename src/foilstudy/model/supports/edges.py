"""Edges of a patch, what is held at them, and the displacements that remain free.

With unclamped knots an edge depends on its outer two lines of control points only: with the
displacements u0 (outer) and u1 (inner) its position moves by (u0 + u1)/2 and its slope across by
(u1 - u0)/h. So every condition is a relation between a control point and its neighbour across the
edge, and those of two edges meet in the four control points of a corner.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from foilstudy.model.patch import Patch
from foilstudy.model.supports.interpolation import (
    along_weights,
    around_weights,
    as_field,
    as_vector,
)
from foilstudy.model.supports.null_space import null_space

EDGES = ("bottom", "top", "left", "right")
"""First and last control rows, first and last control columns (these of open patches only)."""

Direction = int | np.ndarray
"""A coordinate axis (0, 1, 2), or unit vectors (n, 3), one per control point along the edge."""


@dataclass(frozen=True, eq=False)
class EdgeCondition:
    """Directions in which the position and the slope across an edge keep their values.

    Attributes
    ----------
    held : tuple of Direction
        No displacement of the edge in these directions.
    no_slope : tuple of Direction
        No change of the slope across the edge in these directions.
    """

    held: tuple[Direction, ...] = ()
    no_slope: tuple[Direction, ...] = ()


FREE = EdgeCondition()
SIMPLY_SUPPORTED = EdgeCondition(held=(0, 1, 2))


def diaphragm(*axes: int) -> EdgeCondition:
    """Edge held in some coordinate directions, free to move along the others and to rotate."""
    return EdgeCondition(held=axes)


def symmetric(axis: int) -> EdgeCondition:
    """Edge in a plane of mirror symmetry that is normal to a coordinate axis.

    The shape itself must be mirrored too: its outer control points are the images of the inner.
    """
    return EdgeCondition(held=(axis,), no_slope=tuple({0, 1, 2} - {axis}))


def clamped(patch: Patch, shape: np.ndarray, edge: str) -> EdgeCondition:
    """Edge that neither moves nor turns about its own line.

    The slope is held along the surface normal only: held in all directions it would also fix the
    strain across the edge, which the support does not, and cost an order of accuracy.

    Parameters
    ----------
    patch : Patch
    shape : ndarray, shape (3, rows, columns)
        Control points of the shape that is clamped, m.
    edge : str
        One of `EDGES`.
    """
    return EdgeCondition(held=(0, 1, 2), no_slope=(edge_normals(patch, shape, edge),))


RIGID_LINES = EdgeCondition(held=(0, 1, 2), no_slope=(0, 1, 2))
"""Both outer lines of control points held, as the rings of a crumple do."""


@dataclass(frozen=True)
class PointHold:
    """No displacement of one point of the sheet along one coordinate axis.

    Attributes
    ----------
    at : tuple of float
        Parameters around and along, m.
    axis : int
    """

    at: tuple[float, float]
    axis: int


@dataclass(frozen=True, eq=False)
class Constraints:
    """The displacements that the supports leave free.

    Attributes
    ----------
    patch : Patch
    matrix : csr_matrix, shape (3 rows columns, free)
        Displacement of all control points (order row, column, component) per free unknown; its
        columns are orthonormal.
    """

    patch: Patch
    matrix: sparse.csr_matrix

    @property
    def free(self) -> int:
        """Number of free unknowns."""
        return self.matrix.shape[1]

    def displacement(self, unknowns: np.ndarray) -> np.ndarray:
        """Displacement of the control points, shape (3, rows, columns), m."""
        return as_field(self.matrix @ unknowns, self.patch)

    def reduced(self, field: np.ndarray) -> np.ndarray:
        """Force on the unknowns of a force on the control points; also restricts displacements."""
        return self.matrix.T @ as_vector(field)

    def reduced_matrix(self, matrix: sparse.csr_matrix) -> sparse.csr_matrix:
        """T^T A T of a symmetric matrix on all control points."""
        return (self.matrix.T @ (matrix @ self.matrix)).tocsr()


def constraints(
    patch: Patch,
    edges: Mapping[str, EdgeCondition],
    holds: Sequence[PointHold] = (),
) -> Constraints:
    """Free displacements of a patch that is held at some edges and points.

    Parameters
    ----------
    patch : Patch
    edges : mapping of str to EdgeCondition
        Edges that are not named are free.
    holds : sequence of PointHold

    Raises
    ------
    ValueError
        If an edge does not exist, or if a direction does not fit it.
    """
    rows = [_edge_equations(patch, edge, edges) for edge in edges]
    rows += [_hold_equation(patch, hold) for hold in holds]
    size = 3 * patch.rows * patch.columns
    equations = sparse.vstack([sparse.csr_matrix((0, size)), *rows]).tocsr()
    equations.eliminate_zeros()
    return Constraints(patch, null_space(equations))


def edge_lines(patch: Patch, edge: str) -> tuple[np.ndarray, np.ndarray]:
    """Control points (row times columns plus column) of the outer and the inner line of an edge.

    Raises
    ------
    ValueError
        If the patch has no such edge.
    """
    if edge not in EDGES:
        raise ValueError(f"an edge is one of {', '.join(EDGES)}, not {edge!r}")
    if patch.periodic and edge in ("left", "right"):
        raise ValueError(f"a closed patch has no {edge} edge")
    index = np.arange(patch.rows * patch.columns).reshape(patch.rows, patch.columns)
    if edge in ("left", "right"):
        index = index.T
    if edge in ("top", "right"):
        index = index[::-1]
    return index[0], index[1]


def edge_parameter(patch: Patch, edge: str) -> float:
    """Parameter across the patch at which an edge lies, m."""
    edge_lines(patch, edge)
    return {
        "bottom": 0.0,
        "left": 0.0,
        "top": patch.elements_along * patch.size_along,
        "right": patch.elements_around * patch.size_around,
    }[edge]


def edge_normals(patch: Patch, shape: np.ndarray, edge: str) -> np.ndarray:
    """Unit normals of a surface on its edge, at the control points along it, shape (n, 3)."""
    across = np.array([edge_parameter(patch, edge)])
    around, along = patch.parameters()
    if edge in ("bottom", "top"):
        along = across
    else:
        around = across
    a1, a2 = (
        np.einsum(
            "yj,xi,cji->yxc",
            along_weights(patch, along, orders[1]),
            around_weights(patch, around, orders[0]),
            shape,
        ).reshape(-1, 3)
        for orders in ((1, 0), (0, 1))
    )
    normals = np.cross(a1, a2)
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def edge_offset(
    patch: Patch, shape: np.ndarray, edge: str, motion: Callable[[np.ndarray], np.ndarray]
) -> np.ndarray:
    """Displacement field that moves both lines of an edge and nothing else.

    To clamp a moved edge, take `clamped` at the moved shape.

    Parameters
    ----------
    patch, shape, edge
        As in `clamped`.
    motion : callable
        Rigid motion: maps positions (n, 3) to positions, m.

    Returns
    -------
    ndarray, shape (3, rows, columns)
        m.
    """
    points = as_vector(shape).reshape(-1, 3)
    offset = np.zeros_like(points)
    lines = np.concatenate(edge_lines(patch, edge))
    offset[lines] = motion(points[lines]) - points[lines]
    return as_field(offset, patch)


def _edge_equations(patch, edge, edges) -> sparse.csr_matrix:
    """One equation per held direction and control point along an edge."""
    outer, inner = edge_lines(patch, edge)
    skipped = _tied_ends(patch, edge, edges)
    size = 3 * patch.rows * patch.columns
    blocks = []
    condition = edges[edge]
    for directions, sign in ((condition.held, 1.0), (condition.no_slope, -1.0)):
        for direction in directions:
            vectors, kept = _vectors(direction, edge, len(outer)), np.arange(len(outer))
            if not isinstance(direction, int):
                kept = np.setdiff1d(kept, skipped)
            row = np.repeat(np.arange(len(kept)), 3)
            column = 3 * outer[kept, None] + np.arange(3), 3 * inner[kept, None] + np.arange(3)
            value = vectors[kept].ravel()
            blocks += [
                sparse.csr_matrix((value, (row, column[0].ravel())), (len(kept), size))
                + sparse.csr_matrix((sign * value, (row, column[1].ravel())), (len(kept), size))
            ]
    return sparse.vstack([sparse.csr_matrix((0, size)), *blocks])


def _tied_ends(patch, edge, edges) -> list[int]:
    """Ends of an edge at which a crossing edge ties the outer control points to the inner ones.

    There a condition in a varying direction holds already; said again, with the direction that
    belongs to the outer control point, it would differ by the curvature and hold a second one.
    """
    if edge in ("bottom", "top"):
        crossing, last = ("left", "right"), patch.columns - 1
    else:
        crossing, last = ("bottom", "top"), patch.rows - 1
    return [
        end
        for name, end in zip(crossing, (0, last))
        if name in edges and len(edges[name].held) + len(edges[name].no_slope) >= 3
    ]


def _vectors(direction: Direction, edge: str, count: int) -> np.ndarray:
    if isinstance(direction, int):
        if direction not in (0, 1, 2):
            raise ValueError(f"a coordinate axis is 0, 1 or 2, not {direction}")
        return np.tile(np.eye(3)[direction], (count, 1))
    if np.shape(direction) != (count, 3):
        raise ValueError(
            f"directions at the {edge} edge have shape {np.shape(direction)}, its control points "
            f"need ({count}, 3)"
        )
    return np.asarray(direction, dtype=float)


def _hold_equation(patch: Patch, hold: PointHold) -> sparse.csr_matrix:
    field = np.zeros(patch.shape)
    field[hold.axis] = np.outer(
        along_weights(patch, np.array([hold.at[1]]))[0],
        around_weights(patch, np.array([hold.at[0]]))[0],
    )
    return sparse.csr_matrix(as_vector(field))
