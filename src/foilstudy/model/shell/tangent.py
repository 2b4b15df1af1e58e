"""Consistent tangent and mass matrix of the sheet, assembled on the structured stencil.

Every element sees three control rows and columns, whatever its strain samples; so every control
point is coupled to the 5 x 5 around it.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.model.patch import Patch

_MASS = np.array([[6.0, 13.0, 1.0], [13.0, 54.0, 13.0], [1.0, 13.0, 6.0]]) / 120.0
"""Mass of one quadratic uniform B-spline element per unit of length."""

REACH = 2
"""To how many control points on either side one is coupled by the elements that they share."""
_WIDTH = 2 * REACH + 1


def sparsity(patch: Patch) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where the blocks of an element kernel stand in a matrix.

    Returns
    -------
    starts, columns : ndarray of int
        Of the control points in the columns, and these: not rising across the seam.
    valid : ndarray of bool, shape (rows, columns, 5, 5)
        Blocks that stand in the matrix, in its order.

    Raises
    ------
    ValueError
        If there are fewer than five control points around.
    """
    if patch.periodic and patch.columns < _WIDTH:
        raise ValueError(f"a patch needs at least {_WIDTH} elements around, not {patch.columns}")
    rows, columns = patch.rows, patch.columns
    row = np.arange(rows)[:, None, None, None]
    column = np.arange(columns)[None, :, None, None]
    reach = np.arange(_WIDTH) - REACH
    other_row = row + reach[None, None, :, None]
    other_column = column + reach[None, None, None, :]
    shape = (rows, columns, _WIDTH, _WIDTH)
    valid = (other_row >= 0) & (other_row < rows)
    if not patch.periodic:
        valid = valid & (other_column >= 0) & (other_column < columns)
    valid = np.broadcast_to(valid, shape)
    index = np.broadcast_to(other_row * columns + other_column % columns, shape)
    starts = np.concatenate([[0], np.cumsum(valid.sum(axis=(2, 3)).ravel())])
    return starts, index[valid], valid


def block_matrix(patch: Patch, blocks: np.ndarray) -> sparse.csr_matrix:
    """Sparse matrix from the blocks of an element kernel, ordered row, column, component.

    Parameters
    ----------
    patch : Patch
    blocks : ndarray, shape (rows, columns, 5, 5, 3, 3)
        Control point, neighbour; see `ElementKernel.tangent_blocks`.

    Raises
    ------
    ValueError
        If there are fewer than five control points around.
    """
    starts, index, valid = sparsity(patch)
    size = 3 * patch.rows * patch.columns
    matrix = sparse.bsr_matrix((blocks[valid], index, starts), shape=(size, size)).tocsr()
    matrix.sort_indices()
    return matrix


def mass_matrix(patch: Patch, element_masses: np.ndarray) -> sparse.csr_matrix:
    """Consistent mass on all control points, same order as `block_matrix`.

    Parameters
    ----------
    patch : Patch
    element_masses : ndarray, shape (elements_along, elements_around)
        kg; taken from the undeformed foil, so that crumpling conserves mass.
    """
    element = np.kron(_MASS, _MASS)
    rows, columns = patch.rows, patch.columns
    node = np.arange(9)
    j, i = np.meshgrid(
        np.arange(patch.elements_along), np.arange(patch.elements_around), indexing="ij"
    )
    index = (j[..., None] + node // 3) * columns + (i[..., None] + node % 3) % columns
    first = np.repeat(index, 9, axis=-1)
    second = np.tile(index, (1, 1, 9))
    values = element_masses[..., None] * element.ravel()
    size = rows * columns
    scalar = sparse.coo_matrix((values.ravel(), (first.ravel(), second.ravel())), (size, size))
    return sparse.kron(scalar.tocsr(), sparse.identity(3), format="csr")
