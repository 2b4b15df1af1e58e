"""Values and derivatives of a patch at chosen parameters, as matrices on its control points."""

from __future__ import annotations

import numpy as np

from foilstudy.model.patch import Patch

_GAUSS_POINTS, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(3)


def as_vector(field: np.ndarray) -> np.ndarray:
    """Field (3, rows, columns) as a vector in the order row, column, component."""
    return np.moveaxis(field, 0, -1).ravel()


def as_field(vector: np.ndarray, patch: Patch) -> np.ndarray:
    """Inverse of `as_vector`, contiguous."""
    return np.ascontiguousarray(
        np.moveaxis(vector.reshape(patch.rows, patch.columns, 3), -1, 0), dtype=float
    )


def around_weights(patch: Patch, parameters: np.ndarray, order: int = 0) -> np.ndarray:
    """Weights of the control columns in the spline or its derivative at parameters around.

    Parameters
    ----------
    patch : Patch
    parameters : ndarray, shape (n,)
        m; parameter 0 is the left edge of an open patch. Beyond the edges of an open patch the
        polynomial of the outer element goes on.
    order : int
        Order of the derivative, 0 to 2.

    Returns
    -------
    ndarray, shape (n, columns)
    """
    count, size = patch.elements_around, patch.size_around
    if patch.periodic:  # element 0 begins half an element after parameter 0
        return _weights(np.asarray(parameters) / size - 0.5, order, size, patch.columns, None)
    return _weights(np.asarray(parameters) / size, order, size, patch.columns, count)


def along_weights(patch: Patch, parameters: np.ndarray, order: int = 0) -> np.ndarray:
    """Weights of the control rows at parameters along, shape (n, rows); see `around_weights`."""
    size = patch.size_along
    return _weights(np.asarray(parameters) / size, order, size, patch.rows, patch.elements_along)


def _weights(parameters, order, size, controls, elements):
    """Weights of all control points of a line; `elements` is None on a closed one."""
    element = np.floor(parameters).astype(int)
    if elements is not None:
        element = np.clip(element, 0, elements - 1)
    t = parameters - element
    # the three pieces of the uniform quadratic B-spline
    if order == 0:
        pieces = (0.5 * (1 - t) ** 2, 0.5 + t - t**2, 0.5 * t**2)
    elif order == 1:
        pieces = (t - 1, 1 - 2 * t, t)
    else:
        pieces = (np.ones_like(t), -2 * np.ones_like(t), np.ones_like(t))
    weights = np.zeros((len(t), controls))
    for k, piece in enumerate(pieces):
        np.add.at(weights, (np.arange(len(t)), (element + k) % controls), piece / size**order)
    return weights


def gauss_line(elements: int, size: float, start: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Three Gauss points and weights per element of a line, parameters and weights in m."""
    middles = start + size * (np.arange(elements) + 0.5)
    points = middles[:, None] + 0.5 * size * _GAUSS_POINTS
    return points.ravel(), np.tile(0.5 * size * _GAUSS_WEIGHTS, elements)
