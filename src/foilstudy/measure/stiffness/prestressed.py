"""Stiffness between the rings with the stresses left in."""

from __future__ import annotations

from typing import Protocol

import numpy as np
import scipy.sparse as sparse

from foilstudy.measure.stiffness.condensation import InterfaceSystem, condense
from foilstudy.measure.stiffness.directional import fixed_stiffness
from foilstudy.measure.stiffness.rings import Rings
from foilstudy.model.patch import Patch


class Stressed(Protocol):
    """What has a tangent in any shape: a `Shell`, or a problem at its state.

    Attributes
    ----------
    patch : Patch
    """

    patch: Patch

    def tangent(self, points: np.ndarray) -> sparse.csr_matrix:
        """See `Shell.tangent`."""
        ...


def prestressed_stiffness(sheet: Stressed, points: np.ndarray) -> np.ndarray:
    """Axial and radial stiffness of the consistent tangent at an equilibrium, other motions held.

    Parameters
    ----------
    sheet : Stressed
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
