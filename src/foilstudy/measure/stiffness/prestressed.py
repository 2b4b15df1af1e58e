"""Stiffness between the rings with the stresses left in."""

from __future__ import annotations

import numpy as np

from foilstudy.measure.stiffness.condensation import InterfaceSystem, condense
from foilstudy.measure.stiffness.directional import fixed_stiffness
from foilstudy.measure.stiffness.rings import Rings
from foilstudy.model.shell.shell import Shell


def prestressed_stiffness(sheet: Shell, points: np.ndarray) -> np.ndarray:
    """Axial and radial stiffness of the consistent tangent at an equilibrium, other motions held.

    Parameters
    ----------
    sheet : Shell
    points : ndarray, shape (3, rows, columns)
        Control points at the equilibrium, m.

    Returns
    -------
    ndarray, shape (2,)
        N/m; may be negative, as the rings are held.

    Raises
    ------
    SolveError
        If the tangent with held rings is singular.
    """
    tangent = sheet.tangent(points)
    system = InterfaceSystem.split(tangent, Rings.of(sheet.patch, points))
    return fixed_stiffness(condense(system).stiffness)
