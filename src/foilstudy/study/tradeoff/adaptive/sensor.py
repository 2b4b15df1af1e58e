"""Where the error of the strain energy is, and what it would be with larger elements.

The second derivatives of a quadratic spline are constant within an element, so that no spline on
elements of a size has less bending energy in its error than a shape deviates from its mean strains
on these elements. Membrane strains count alike, as the default element samples them once at each
corner. Energies of errors are second order in the element size.
"""

from __future__ import annotations

import numpy as np

from foilstudy.model.patch import Patch
from foilstudy.model.shell.geometry import reference_geometry
from foilstudy.pipeline.shape import Shape

_WITHIN = 1 / 3
"""Of a linear field: its spread within elements over the spread of elements in cells of two."""


def strain_fields(shape: Shape) -> np.ndarray:
    """Strains of a shape, scaled so that the sum of all their squares is its strain energy.

    Parameters are taken for arc lengths at right angles, as they are on a cylinder.

    Returns
    -------
    ndarray, shape (6, elements along, elements around)
        Three of bending, in the middle of an element, and three of the membrane, at its first
        corner; square roots of J.
    """
    patch, material, thickness = shape.patch, shape.foil.material, shape.foil.thickness
    membrane = material.youngs_modulus * thickness / (1 - material.poisson_ratio**2)
    bending = membrane * thickness**2 / 12
    curvatures = _curvatures(patch, shape.points) - _curvatures(patch, shape.reference)
    stretches = _stretches(patch, shape.points) - _stretches(patch, shape.reference)
    half_area = 0.5 * patch.size_around * patch.size_along
    return np.concatenate(
        [
            np.sqrt(stiffness * half_area) * _principal(strains, material.poisson_ratio)
            for stiffness, strains in ((bending, curvatures), (membrane, stretches))
        ]
    )


def _principal(strains: np.ndarray, poisson_ratio: float) -> np.ndarray:
    """Mean, difference and shear of 11, 22 and 2 x 12: their squares add up in an isotropic law."""
    first, second, shear = strains
    together, apart = np.sqrt((1 + poisson_ratio) / 2), np.sqrt((1 - poisson_ratio) / 2)
    return np.stack([together * (first + second), apart * (first - second), apart * shear])


def _curvatures(patch: Patch, points: np.ndarray) -> np.ndarray:
    sizes = patch.size_around, patch.size_along
    return reference_geometry(points, patch.elements_around, *sizes)[:, 3:6].swapaxes(0, 1)


def _stretches(patch: Patch, points: np.ndarray) -> np.ndarray:
    """Green strains at the corners, where a spline has the slopes of its control net."""
    right = np.roll(points, -1, axis=2)
    lower, upper = points[:, :-2], points[:, 1:-1]
    lower_right, upper_right = right[:, :-2], right[:, 1:-1]
    around = (lower_right - lower + upper_right - upper) / (2 * patch.size_around)
    along = (upper - lower + upper_right - lower_right) / (2 * patch.size_along)
    pairs = ((around, around / 2), (along, along / 2), (around, along))
    products = [(first * second).sum(axis=0) for first, second in pairs]
    return np.stack(products)[:, :, : patch.elements_around]


def spread(fields: np.ndarray, along: int, around: int) -> np.ndarray:
    """Energy of what elements deviate from the mean of their cell, by cell, J.

    Parameters
    ----------
    fields : ndarray, shape (..., elements along, elements around)
    along, around : int
        Elements in a cell; the last cells may have fewer.
    """
    squares = cell_sums((fields**2).sum(axis=0), along, around)
    count = cell_sums(np.ones(fields.shape[1:]), along, around)
    means = np.stack([cell_sums(field, along, around) for field in fields]) / count
    return np.maximum(squares - count * (means**2).sum(axis=0), 0.0)


def cell_sums(values: np.ndarray, along: int, around: int) -> np.ndarray:
    """Sum of the values of the elements in each cell."""
    rows, columns = values.shape
    padded = np.pad(values, ((0, -rows % along), (0, -columns % around)))
    rows, columns = padded.shape
    return padded.reshape(rows // along, along, columns // around, around).sum(axis=(1, 3))


def over_elements(cells: np.ndarray, side: int, shape: tuple[int, ...]) -> np.ndarray:
    """Values of square cells at each of their elements, `side` in a row; `shape` is the mesh's."""
    return np.repeat(np.repeat(cells, side, axis=0), side, axis=1)[: shape[0], : shape[1]]


def element_errors(fields: np.ndarray) -> np.ndarray:
    """Energy error in each element of the mesh as it is, J.

    It is what neighbours differ by, continued to within the elements.
    """
    return over_elements(_WITHIN / 4 * spread(fields, 2, 2), 2, fields.shape[1:])


def cell_errors(fields: np.ndarray, elements: int) -> np.ndarray:
    """Energy error in cells of `elements` by `elements`, each made one element, J."""
    within = cell_sums(element_errors(fields), elements, elements)
    return within + spread(fields, elements, elements)


def directional_errors(fields: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Energy error due to the size of the elements around and along, J.

    Returns
    -------
    around : ndarray, shape (elements along, pairs of elements around)
    along : ndarray, shape (pairs of elements along, elements around)
    """
    return _WITHIN * spread(fields, 1, 2), _WITHIN * spread(fields, 2, 1)
