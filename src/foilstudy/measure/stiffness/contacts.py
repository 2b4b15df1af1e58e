"""Stress-free stiffness of a crumple whose parts touch: a bracket, never one number.

What a closed contact does in a small motion depends on what model and data do not hold: it may open
(as if it were not there), resist approach, or stick. Springs resist opening, too, and so overstate
a contact that may open.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.measure.stiffness.condensation import InterfaceSystem, condense
from foilstudy.measure.stiffness.directional import fixed_stiffness
from foilstudy.measure.stiffness.rings import Rings
from foilstudy.measure.stiffness.stress_removal import Relieved
from foilstudy.model.contact import SelfContact

_RIGID = 100.0
"""Stiffness of a rigid spring relative to E t/(1 - nu^2)."""


@dataclass(frozen=True, eq=False)
class ContactBracket:
    """Axial and radial stiffness, other motions held, N/m, shape (2,) each.

    Attributes
    ----------
    ignored : ndarray
        Contacts as if they were open.
    normal : ndarray
        As springs along their gaps, as stiff as the barrier where it has come to rest.
    rigid : ndarray
        The same with rigid springs.
    stuck : ndarray
        With rigid springs in all directions.
    closed : int
        Pairs within the reach.
    """

    ignored: np.ndarray
    normal: np.ndarray
    rigid: np.ndarray
    stuck: np.ndarray
    closed: int


def contact_bracket(sheet: Relieved, contact: SelfContact, points: np.ndarray) -> ContactBracket:
    """The bracket of a relieved sheet.

    Parameters
    ----------
    sheet : Relieved
        Stress-free in the shape `points`.
    contact : SelfContact
    points : ndarray, shape (3, rows, columns)
        m.

    Raises
    ------
    SolveError
        If a stiffness with held rings is singular.
    """
    tangent, rings = sheet.tangent(), Rings.of(sheet.patch, points)
    rigid = _RIGID * contact.membrane_stiffness

    def stiffness(*spring: float | bool | None) -> np.ndarray:
        matrix = tangent
        if spring:
            matrix = (tangent + contact.spring_tangent(points, *spring)).tocsr()
        return fixed_stiffness(condense(InterfaceSystem.split(matrix, rings)).stiffness)

    ignored = stiffness()
    normal, held, stuck = stiffness(None, False), stiffness(rigid, False), stiffness(rigid, True)
    return ContactBracket(ignored, normal, held, stuck, len(contact.closed()))
