"""Stiffness of a stress-free sheet between its rings, without their rotations."""

from __future__ import annotations

import numpy as np

from foilstudy.measure.stiffness.condensation import factorise_held
from foilstudy.measure.stiffness.directional import by_direction
from foilstudy.measure.stiffness.stress_removal import Relieved
from foilstudy.model.patch import RING_ROWS
from foilstudy.model.shell.held import held_blocks


def transfer_stiffness(sheet: Relieved) -> np.ndarray:
    """Axial and radial stiffness of a relieved sheet, other motions held, N/m.

    The numbers of the whole interface stiffness, from three loads instead of twelve.

    Raises
    ------
    SolveError
        If the stiffness with held rings is singular to working precision.
    """
    blocks = sheet.tangent_blocks()
    bottom, top = _pulls(blocks, slice(0, RING_ROWS)), _pulls(blocks, slice(-RING_ROWS, None))
    between = slice(RING_ROWS, -RING_ROWS)
    factor = factorise_held(held_blocks(sheet.patch, blocks))
    motion = -factor.solve(bottom[between].reshape(-1, 3))
    direct = bottom[-RING_ROWS:].sum(axis=(0, 1))
    transfer = direct + top[between].reshape(-1, 3).T @ motion
    return by_direction(-np.diag(transfer))


def _pulls(blocks: np.ndarray, ring: slice) -> np.ndarray:
    """Force on every control point per translation of a ring, shape (rows, columns, 3, 3)."""
    rows, reach = len(blocks), blocks.shape[2] // 2
    owned = np.zeros(rows + 2 * reach, dtype=bool)
    owned[reach:-reach][ring] = True
    pulls = np.zeros((*blocks.shape[:2], 3, 3))
    for offset in range(blocks.shape[2]):
        near = owned[offset : offset + rows]  # the row at this offset belongs to the ring
        pulls[near] += blocks[near, :, offset].sum(axis=2)
    return pulls
