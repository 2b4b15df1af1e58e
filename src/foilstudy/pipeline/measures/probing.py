"""What probes have in common: the motions that are not probed, and whether the foil was linear."""

from __future__ import annotations

import numpy as np

from foilstudy.measure.stiffness.directional import by_direction
from foilstudy.solve.equilibrium.guided import GuidedEquilibrium

OTHERS = ("held", "free")
"""As in `fixed_stiffness` and `free_stiffness`; of the top ring, the bottom one stands."""

_NONLINEAR = 0.5
"""Difference of the energy from that of a spring, as a share of it, from which a probe says so.

A foil whose stiffness changes steadily on the way, by all of itself, differs by a third.
"""


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


def doubt(rest: GuidedEquilibrium, end: GuidedEquilibrium, axis: int) -> str:
    """Why the way from rest to an end is not that of a spring; empty where it is.

    A snap sets energy free, so that less is stored than the force on the ring has put in.
    """
    stored = end.energy - rest.energy - rest.pull[1] @ end.motion
    spring = 0.5 * (end.pull[1] - rest.pull[1])[axis] * end.motion[axis]
    if abs(stored - spring) <= _NONLINEAR * abs(spring):
        return ""
    return (
        f"the foil has snapped or is far from linear with the ring moved by "
        f"{1e3 * end.motion[axis]:.2g} mm along {'xyz'[axis]}: it stores {stored:.2g} J where a "
        f"spring would {spring:.2g} J"
    )


def in_words(reasons: list[str]) -> str:
    """One message of several, each of them once."""
    return "; ".join(dict.fromkeys(filter(None, reasons)))
