"""Forces and tangents of groups of control points, gathered and added up by whole arrays.

For models that are made to be seen failing, not to be fast.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foilstudy.model.patch import Patch
from foilstudy.model.shell.tangent import REACH


@dataclass(frozen=True, eq=False)
class Groups:
    """Groups of as many control points each, such as the ends of springs.

    Attributes
    ----------
    patch : Patch
    rows, columns : ndarray of int, shape (groups, points)
        Columns count on round a closed patch.
    """

    patch: Patch
    rows: np.ndarray
    columns: np.ndarray

    @cached_property
    def _index(self) -> np.ndarray:
        return self.rows * self.patch.columns + self.columns % self.patch.columns

    def gathered(self, points: np.ndarray) -> np.ndarray:
        """Positions, shape (groups, points, 3), m."""
        return points.reshape(3, -1).T[self._index]

    def add_force(self, force: np.ndarray, out: np.ndarray) -> None:
        """Add forces, shape (groups, points, 3), to those on the control points."""
        index = self._index.ravel()
        for c in range(3):
            total = np.bincount(index, force[..., c].ravel(), minlength=out[c].size)
            out[c] += total.reshape(out[c].shape)

    def add_blocks(self, hessian: np.ndarray, blocks: np.ndarray) -> None:
        """Add matrices, shape (groups, points, 3, points, 3), to the blocks of a tangent."""
        up = self.rows[:, None] - self.rows[:, :, None] + REACH
        right = self.columns[:, None] - self.columns[:, :, None] + REACH
        rows = np.broadcast_to(self.rows[:, :, None], up.shape)
        columns = np.broadcast_to(self.columns[:, :, None], up.shape) % self.patch.columns
        np.add.at(blocks, (rows, columns, up, right), hessian.transpose(0, 1, 3, 2, 4))


def no_blocks(patch: Patch) -> np.ndarray:
    """Blocks of a tangent of nothing, see `ElementKernel.tangent_blocks`."""
    width = 2 * REACH + 1
    return np.zeros((patch.rows, patch.columns, width, width, 3, 3))
