"""What closed contacts add to the stress-free stiffness of a crumple: a bracket, never one number.

What a closed contact does in a small motion depends on what model and data do not hold: it may open
(as if it were not there), resist approach, or stick. Springs resist opening, too, and so overstate
a contact that may open.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
import scipy.sparse as sparse

from foilstudy.base.errors import Refusal
from foilstudy.measure.choices import CLOSED_CONTACTS
from foilstudy.measure.stiffness.condensation import InterfaceSystem, condense
from foilstudy.measure.stiffness.directional import fixed_stiffness
from foilstudy.measure.stiffness.rings import Rings
from foilstudy.measure.stiffness.stress_removal import Relieved

__all__ = ["CONTACT_SPRINGS", "ContactBracket", "Touching", "contact_bracket", "contact_springs"]

_RIGID = 100.0
"""Stiffness of a rigid spring relative to E t/(1 - nu^2)."""

CONTACT_SPRINGS = ("ignored", *CLOSED_CONTACTS)
"""What closed contacts may do in a small motion, see `ContactBracket`."""


@runtime_checkable
class Touching(Protocol):
    """A term of contact, by what is measured of it.

    Attributes
    ----------
    membrane_stiffness : float
        E t/(1 - nu^2) of the foil, N/m.
    """

    membrane_stiffness: float

    def closed_at(self, points: np.ndarray) -> int:
        """Contacts that are closed in a shape."""
        ...

    def spring_tangent(
        self, points: np.ndarray, stiffness: float | None = None, stuck: bool = False
    ) -> sparse.csr_matrix:
        """Stiffness of these as springs, on all control points."""
        ...


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


def contact_springs(
    kind: str, contacts: Sequence[Touching], points: np.ndarray
) -> sparse.csr_matrix | None:
    """Stiffness of closed contacts on all control points, N/m; None where they add nothing.

    Parameters
    ----------
    kind : str
        One of `CONTACT_SPRINGS`.
    contacts : sequence of Touching
    points : ndarray, shape (3, rows, columns)
        m.
    """
    if kind not in CONTACT_SPRINGS:
        raise Refusal(
            f"{kind!r} is not what closed contacts may do; use one of {', '.join(CONTACT_SPRINGS)}."
        )
    if kind == "ignored" or not contacts:
        return None
    springs = [
        each.spring_tangent(
            points,
            None if kind == "normal" else _RIGID * each.membrane_stiffness,
            kind == "stuck",
        )
        for each in contacts
    ]
    return sum(springs[1:], start=springs[0])


def contact_bracket(
    sheet: Relieved, contacts: Sequence[Touching], points: np.ndarray
) -> ContactBracket:
    """The bracket of a relieved sheet.

    Parameters
    ----------
    sheet : Relieved
        Stress-free in the shape `points`.
    contacts : sequence of Touching
    points : ndarray, shape (3, rows, columns)
        m.

    Raises
    ------
    SolveError
        If a stiffness with held rings is singular.
    """
    tangent, rings = sheet.tangent(), Rings.of(sheet.patch, points)
    closed = sum(each.closed_at(points) for each in contacts)

    def stiffness(kind: str) -> np.ndarray:
        springs = contact_springs(kind, contacts, points)
        matrix = tangent if springs is None else (tangent + springs).tocsr()
        return fixed_stiffness(condense(InterfaceSystem.split(matrix, rings)).stiffness)

    ignored = stiffness("ignored")
    if not closed:
        return ContactBracket(ignored, ignored, ignored, ignored, 0)
    return ContactBracket(ignored, *map(stiffness, CONTACT_SPRINGS[1:]), closed)
