"""What the motions of the top ring that are not probed do."""

from __future__ import annotations

import numpy as np

from foilstudy.measure.stiffness.directional import by_direction

OTHERS = ("held", "free")
"""As in `fixed_stiffness` and `free_stiffness`; of the top ring, the bottom one stands."""


def require_others(others: str) -> None:
    """Refuse any other word.

    Raises
    ------
    ValueError
    """
    if others not in OTHERS:
        raise ValueError(f"the other motions of a ring are {' or '.join(OTHERS)}, not {others!r}")


def combined(along_axes: np.ndarray, others: str) -> np.ndarray:
    """Axial and radial stiffness from those along x, y and z, N/m.

    The mean of x and y where the others are held, that of their compliances where they are free.
    """
    return by_direction(along_axes) if others == "held" else 1 / by_direction(1 / along_axes)
