"""The stiffness between held rings as blocks, in the order in which the grid is best eliminated."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from foilstudy.linalg import BlockPattern, DefiniteBlocks, dissection
from foilstudy.model.patch import RING_ROWS, Patch
from foilstudy.model.shell.tangent import REACH, sparsity


def held_blocks(patch: Patch, blocks: np.ndarray) -> DefiniteBlocks:
    """Stiffness of a shape without stress between its held rings, which is positive definite.

    Neither a sparse matrix of all points is made nor is an order sought.

    Parameters
    ----------
    patch : Patch
    blocks : ndarray, shape (rows, columns, 5, 5, 3, 3)
        See `Shell.tangent_blocks`.
    """
    pattern, where = _held_pattern(patch)
    return DefiniteBlocks(pattern, blocks.reshape(-1, *blocks.shape[-2:])[where])


@lru_cache(maxsize=4)
def _held_pattern(patch: Patch) -> tuple[BlockPattern, np.ndarray]:
    """Pattern between the rings, and where its blocks stand among those of the stencil."""
    starts, other, valid = sparsity(patch)
    point = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    owned, size = RING_ROWS * patch.columns, len(starts) - 1
    kept = (point >= owned) & (other >= point) & (other < size - owned)
    point, other = point[kept] - owned, other[kept] - owned
    order = np.lexsort((other, point))  # rising, also across the seam
    count = size - 2 * owned
    eliminated = dissection(patch.rows - 2 * RING_ROWS, patch.columns, REACH, patch.periodic)
    pattern = BlockPattern(
        np.concatenate([[0], np.cumsum(np.bincount(point, minlength=count))]).astype(np.int32),
        other[order].astype(np.int32),
        eliminated.astype(np.int32),
    )
    return pattern, np.flatnonzero(valid)[kept][order]
