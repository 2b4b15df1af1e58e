"""Coulomb's friction of closed contacts, as springs that let go at their limit.

A contact that sticks is a spring across its gap, from where it closed. Its force is the coefficient
times the normal force at most; beyond, it slips. Within a step the limit is that of the shape last
committed, so that the force is the derivative of the energy of the springs and of what slipping
spends, and its tangent symmetric; once a shape is committed every spring is let down to the limit
of that shape. So in every committed shape the law holds as it stands, and nothing ever gives work
back.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
import scipy.sparse as sparse

from foilstudy.base.errors import Refusal
from foilstudy.model.contact import sliding
from foilstudy.model.contact.stencils import Pressing
from foilstudy.model.contact.surface import Triangulation
from foilstudy.model.patch import RING_ROWS

__all__ = ["STICK", "Friction", "Rubbing", "Sticks"]

STICK = 0.1
"""Stiffness of a contact that sticks relative to E t/(1 - nu^2)."""
_AT_LIMIT = 1 - 1e-9
"""Share of its limit from which a contact counts as slipping."""


class Rubbing(Protocol):
    """A term of contact that knows what presses on what.

    Attributes
    ----------
    name : str
        By which what its friction records is told from that of other terms.
    membrane_stiffness : float
        E t/(1 - nu^2), N/m.
    surface : Triangulation
    """

    name: str
    membrane_stiffness: float
    surface: Triangulation

    def pressing_at(self, points: np.ndarray) -> Pressing | None:
        """What is closed in a shape; None where its energy is infinite."""
        ...

    def on_points(self, knots: np.ndarray, blocks: np.ndarray) -> sparse.csr_matrix:
        """Matrix on the control points, from one on each set of knots."""
        ...


@dataclass(frozen=True, eq=False)
class Sticks:
    """Springs of the contacts that were closed in the shape last committed.

    Attributes
    ----------
    contacts : Pressing
        In that shape.
    arms : ndarray, shape (n, POINTS, 3)
        Of their patches there, m.
    stretched : ndarray, shape (n, 3)
        Springs there, m.
    limit : ndarray, shape (n,)
        Of their force, N.
    slipped : ndarray, shape (n, 3)
        Since, m.
    spent : float
        By slipping and by contacts that opened, J.
    """

    contacts: Pressing
    arms: np.ndarray
    stretched: np.ndarray
    limit: np.ndarray
    slipped: np.ndarray
    spent: float = 0.0

    def __len__(self) -> int:
        return len(self.contacts)

    @property
    def geometry(self) -> tuple[np.ndarray, ...]:
        """What `sliding` takes."""
        of = self.contacts
        return of.stencils, of.sides, of.weights, self.arms, of.direction


class Friction:
    """Between parts of a sheet, or between it and the planes of its rings.

    Parameters
    ----------
    contact : Rubbing
        The term that presses.
    coefficient : float
        Largest force along a contact over that across it.

    Attributes
    ----------
    stiffness : float
        Of a contact that sticks, N/m.
    """

    energy_names = ("friction",)

    def __init__(self, contact: Rubbing, coefficient: float):
        self._contact, self.coefficient = contact, coefficient
        self.stiffness = STICK * contact.membrane_stiffness

    def __repr__(self) -> str:
        return f"<Friction: {self.coefficient:g} of {self._contact!r}>"

    def start(self) -> Sticks:
        """Nothing touches."""
        none = np.empty((0, sliding.POINTS), dtype=np.int64)
        vectors = np.empty((0, 3))
        closed = Pressing(none, none, none.astype(float), vectors, np.empty(0))
        return Sticks(closed, np.empty((0, sliding.POINTS, 3)), vectors, np.empty(0), vectors)

    def force(self, points: np.ndarray, out: np.ndarray, state: Sticks) -> np.ndarray:
        """See `solve.problem.Term`: of springs that slip no further."""
        out[:] = 0.0
        if not len(state):
            return np.zeros(1)
        knots = self._contact.surface.knots(points)
        forces = np.zeros_like(knots)
        stretched = state.stretched - state.slipped
        energy = sliding.push(knots, *state.geometry, stretched, self.stiffness, forces)
        self._contact.surface.gathered(forces, out)
        return np.array([energy])

    def tangent(self, points: np.ndarray, state: Sticks) -> sparse.csr_matrix:
        """See `solve.problem.Term`.

        Contacts that have slipped since the last committed shape go on slipping; in a committed
        shape all stick.
        """
        knots = self._contact.surface.knots(points)
        slip, held = _length(state.slipped), state.limit / self.stiffness
        whole = np.divide(slip, held, out=np.zeros(len(state)), where=held > 0)
        loose = (slip > 0) & (held == 0)  # without a normal force nothing holds
        blocks = sliding.stiffness_blocks(
            knots, *state.geometry, state.stretched - state.slipped, self.stiffness,
            1.0 + whole,
        )  # fmt: skip
        blocks[loose] = 0.0
        return self._contact.on_points(state.contacts.stencils, blocks)

    def led(self, points: np.ndarray, state: Sticks) -> Sticks:
        """See `solve.problem.Lagging`: contacts beyond their limits have slipped."""
        if not len(state):
            return state
        knots = self._contact.surface.knots(points)
        trial = state.stretched + sliding.slides(knots, *state.geometry)
        slipped = trial - _shortened(trial, state.limit / self.stiffness)
        work = float(np.sum(state.limit * _length(slipped)))
        return replace(state, slipped=slipped, spent=state.spent + work)

    def evolved(self, points: np.ndarray, state: Sticks) -> Sticks:
        """See `solve.problem.Term`: what touches now, let down to what it is pressed by."""
        contacts = self._contact.pressing_at(points)
        if contacts is None or not (len(contacts) or len(state)):
            return state
        knots = self._contact.surface.knots(points)
        limit = self.coefficient * contacts.force
        stretched, spent = np.zeros((len(contacts), 3)), state.spent
        if len(state):
            before = self.led(points, state)
            springs = before.stretched + sliding.slides(knots, *before.geometry) - before.slipped
            here, there = _common(contacts.stencils, before.contacts.stencils)
            stretched[here] = sliding.carried(
                knots, before.contacts.stencils[there], before.contacts.sides[there],
                before.arms[there], springs[there],
            )  # fmt: skip
            across = np.sum(stretched * contacts.direction, axis=1)
            stretched -= across[:, None] * contacts.direction
            stretched = _shortened(stretched, limit / self.stiffness)
            let_go = 0.5 * self.stiffness * (np.sum(springs**2) - np.sum(stretched**2))
            spent = before.spent + max(0.0, float(let_go))  # below zero by rounding alone
        arms = _arms(knots, contacts)
        return Sticks(contacts, arms, stretched, limit, np.zeros_like(stretched), spent)

    def spent(self, state: Sticks) -> float:
        """See `solve.problem.Following`, J."""
        return state.spent

    def stick_forces(self, free: np.ndarray, state: Sticks) -> np.ndarray:
        """Forces of the springs in a small motion of the control points between the rings, N.

        Parameters
        ----------
        free : ndarray, shape (3, free rows, columns)
            m.
        state : Sticks
        """
        out = np.zeros_like(free)
        if not len(state):
            return out
        surface = self._contact.surface
        field = np.zeros(surface.patch.shape)
        field[:, RING_ROWS:-RING_ROWS] = free
        of, motion = state.contacts, surface.knots(field)
        # the turn of the patches is left out: it takes little off, and a bound is what is wanted
        slide = np.einsum("pi,pic->pc", of.weights, motion[of.stencils])
        slide -= np.sum(slide * of.direction, axis=1)[:, None] * of.direction
        forces = np.zeros_like(motion)
        pulls = self.stiffness * of.weights[:, :, None] * slide[:, None]
        np.add.at(forces, of.stencils[:, :4], pulls[:, :4])
        whole = np.empty(surface.patch.shape)
        surface.gathered(forces, whole)
        return np.ascontiguousarray(whole[:, RING_ROWS:-RING_ROWS])

    def numbers(self, state: Sticks) -> dict[str, float]:
        """Work spent, J, and share of the contacts that stand at their limit."""
        held = self.stiffness * _length(state.stretched - state.slipped)
        at_limit = held >= _AT_LIMIT * state.limit
        return {
            f"{self._name}_work": state.spent,
            f"{self._name}_slipping_share": float(at_limit.mean()) if len(state) else np.nan,
        }

    def recorded(self, state: Sticks) -> dict[str, np.ndarray]:
        """See `solve.problem.Lasting`."""
        of, vectors = state.contacts, state.stretched - state.slipped
        parts = of.stencils, of.sides, of.weights, of.direction, of.force[:, None], vectors
        arms = state.arms.reshape(len(state), 3 * sliding.POINTS)
        return {
            f"{self._name}_contacts": np.concatenate([*parts, arms], axis=1),
            f"{self._name}_work": np.float64(state.spent),
        }

    def restored(self, values: Mapping[str, np.ndarray]) -> Sticks:
        """See `solve.problem.Lasting`."""
        ends = np.cumsum([*3 * [sliding.POINTS], 3, 1, 3])
        parts = np.split(np.asarray(values[f"{self._name}_contacts"]), ends, axis=1)
        # contiguous, or every kernel would be compiled once more
        stencils, sides, weights, direction, force, stretched, arms = map(
            np.ascontiguousarray, parts
        )
        ids = stencils.astype(np.int64), sides.astype(np.int64)
        contacts = Pressing(*ids, weights, direction, force[:, 0])
        return Sticks(
            contacts,
            arms.reshape(-1, sliding.POINTS, 3),
            stretched,
            self.coefficient * contacts.force,
            np.zeros_like(stretched),
            float(values[f"{self._name}_work"]),
        )

    def split(self, state: Sticks) -> dict[str, np.ndarray]:
        """See `solve.problem.Lasting`.

        Raises
        ------
        Refusal
        """
        raise Refusal(
            "the contacts of a foil that rubs are those of its mesh; crumple on the mesh that is "
            "wanted, or set the friction to 0."
        )

    @property
    def _name(self) -> str:
        return f"{self._contact.name}_friction"


def _length(vectors: np.ndarray) -> np.ndarray:
    return np.sqrt(np.sum(vectors**2, axis=1))


def _shortened(vectors: np.ndarray, most: np.ndarray) -> np.ndarray:
    """Vectors of at most some lengths."""
    length = _length(vectors)
    share = np.divide(most, length, out=np.ones(len(vectors)), where=length > most)
    return share[:, None] * vectors


def _common(here: np.ndarray, there: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where either has the stencils that both have."""
    names = [
        np.ascontiguousarray(each).view([("", np.int64)] * sliding.POINTS).ravel()
        for each in (here, there)
    ]
    return np.intersect1d(*names, assume_unique=True, return_indices=True)[1:]


def _arms(knots: np.ndarray, contacts: Pressing) -> np.ndarray:
    arms = np.empty((len(contacts), sliding.POINTS, 3))
    sliding.all_centred(knots, contacts.stencils, contacts.sides, arms)
    return arms
