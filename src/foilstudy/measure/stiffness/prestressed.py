"""Stiffness between the rings with the stresses left in."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.measure.stiffness.condensation import InterfaceSystem, condense
from foilstudy.measure.stiffness.directional import fixed_stiffness
from foilstudy.measure.stiffness.rings import Rings
from foilstudy.model.patch import Patch
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
    return tangent_stiffness(sheet.tangent(points), sheet.patch, points)


def tangent_stiffness(tangent: sparse.csr_matrix, patch: Patch, points: np.ndarray) -> np.ndarray:
    """The same of any tangent on all control points, such as that of a problem."""
    system = InterfaceSystem.split(tangent, Rings.of(patch, points))
    return fixed_stiffness(condense(system).stiffness)
