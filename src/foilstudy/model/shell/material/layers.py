"""The layers of a foil that have yielded: many states share what they have in common.

What the layers of one element have become stands in a slot; a state is the slots of its elements.
So the state of a shape takes room and time only for the elements that have flowed on since the one
before, and older ones stay what they were. Slots that no state refers to any more are used again.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any, Self
from weakref import WeakSet, ref

import numpy as np

from foilstudy.model.shell.elements.mean_kernel import STRIDE, WIDTH
from foilstudy.model.shell.elements.mean_strains import Rows
from foilstudy.model.shell.material.return_map import (
    LAYERS_MAX,
    LOOKED,
    ROOM,
    Flow,
    energies,
    flow_on,
    norm_of,
    sum_up,
)

_SUMS = 6
_COLLECTED, _ROOM = 1, 2
"""Slots taken, for each element, before unused ones are sought, and free ones that there are then
at least. The fewer are taken, the more of them stay in the fast caches."""


class Layers:
    """Room for the layers of all states of a foil.

    Parameters
    ----------
    frame : ndarray, shape (elements_along, 7, elements_around)
        See `return_map.flow_on`.
    heights : ndarray, shape (layers,)
        Above the middle surface, m.
    flow : Flow

    Raises
    ------
    ValueError
        If there are more than `return_map.LAYERS_MAX` layers.

    Attributes
    ----------
    made_of : tuple
        The parameters.
    values : ndarray, shape (slots, 4, layers)
        Plastic strains 11, 22, 2 12 in Cartesian axes, the first along the first coordinate of the
        element, and the accumulated one, which never falls. Slot 0 is that of foil that has not
        yielded.
    sums : ndarray, shape (slots, 6)
        Of each slot the mean of its plastic strains and their curvature, in the coordinates of the
        element.
    """

    def __init__(self, frame: np.ndarray, heights: np.ndarray, flow: Flow):
        if heights.size > LAYERS_MAX:
            raise ValueError(f"a foil has {LAYERS_MAX} layers at most, not {heights.size}")
        _, self._heights, self.flow = self.made_of = frame, heights, flow
        self.frame = np.ascontiguousarray(frame.transpose(0, 2, 1))
        self.shape = frame.shape[0], frame.shape[2]
        self._size = frame.shape[0] * frame.shape[2]
        self._states: WeakSet[PlasticState] = WeakSet()
        self.values, self.sums = np.zeros((1, 4, heights.size)), np.zeros((1, _SUMS))
        self._free, self._taken = np.empty(0, dtype=np.int64), 0
        self._grow()

    @cached_property
    def _norm(self) -> tuple[float, ...]:
        """Made when something may flow: what is only asked for its tangent needs none."""
        return norm_of(self.frame, self._heights, self.flow)

    def untouched(self) -> PlasticState:
        """The state in which nothing has yielded."""
        return self._noted(np.zeros(self.shape, dtype=np.int64))

    def filled(self, values: np.ndarray) -> PlasticState:
        """The state of given layers, shape (elements_along, layers, 4, elements_around)."""
        slots = np.zeros(self.shape, dtype=np.int64)
        yielded = np.any(values != 0, axis=(1, 2))
        self._collect()
        taken, self._free = np.split(self._free, [np.count_nonzero(yielded)])
        self._taken = len(taken)
        slots[yielded] = taken
        self.values[taken] = values.transpose(0, 3, 2, 1)[yielded]
        sum_up(self.values, slots, self._heights, self.frame, self.sums)
        return self._noted(slots)

    def flowed(
        self, shape: np.ndarray, rows: Rows | None, before: PlasticState, look: Look
    ) -> PlasticState:
        """The state that a shape leads to; see `return_map.flow_on`.

        Parameters
        ----------
        shape : ndarray
            Control points, or mean strains where there are no `rows`.
        rows : Rows or None
        before : PlasticState
        look : Look
            Taken note of.
        """
        if self._taken > _COLLECTED * self._size:
            self._collect()
        look.see(before)
        slots, changed = before.slots.copy(), np.empty(self._size, dtype=np.int64)
        rest, spacings = rows or (None, None)
        used = flow_on(
            shape, rest, spacings, self.frame, self._heights, self.flow, self._norm,
            self.values, self.sums, look.values, slots, self._free, changed,
        )  # fmt: skip
        look.last = before
        if not used:
            return before
        self._free, self._taken = self._free[used:], self._taken + used
        state = self._noted(slots)
        state.since = ref(before), changed[:used]
        look.last = state
        return state

    def _noted(self, slots: np.ndarray) -> PlasticState:
        state = PlasticState(self, slots)
        self._states.add(state)
        return state

    def _collect(self) -> None:
        """Find the slots that no state refers to."""
        used = np.zeros(len(self.values), dtype=bool)
        used[0] = True
        for state in self._states:
            used[state.slots] = True
        self._free, self._taken = np.flatnonzero(~used), 0
        if len(self._free) < _ROOM * self._size:
            self._grow()

    def _grow(self) -> None:
        kept, more = len(self.values), _ROOM * self._size
        self.values = np.concatenate([self.values, np.empty((more, *self.values.shape[1:]))])
        self.sums = np.concatenate([self.sums, np.empty((more, _SUMS))])
        self._free = np.concatenate([self._free, np.arange(kept, kept + more)])


class Look:
    """What was seen of the elements when their layers were looked at last.

    Attributes
    ----------
    values : ndarray
        See `return_map.flow_on`.
    last : PlasticState or None
        The state in which they were left.
    """

    def __init__(self, shape: tuple[int, int]):
        along, around = shape
        self._around = around
        self.values = np.zeros((-(-around // WIDTH), along, LOOKED, STRIDE))
        self.last: PlasticState | None = None

    def see(self, state: PlasticState) -> None:
        """Have what is not as it was left looked at again."""
        elements = differing(state, self.last)
        if len(elements):
            row, column = np.divmod(elements, self._around)
            self.values[column // WIDTH, row, ROOM, column % WIDTH] = -np.inf


class PlasticState:
    """What plasticity has left in a foil; never changes.

    Parameters
    ----------
    foil : Layers
    slots : ndarray of int, shape (elements_along, elements_around)

    Attributes
    ----------
    foil : Layers
    slots : ndarray of int
        Where the layers of each element are.
    since : tuple or None
        The state that it came from, if that is still known, and the elements that have flowed.
    """

    def __init__(self, foil: Layers, slots: np.ndarray):
        self.foil, self.slots = foil, slots
        self.since: tuple[ref[PlasticState], np.ndarray] | None = None

    def __repr__(self) -> str:
        return f"<PlasticState: up to {self.accumulated.max():.3g}>"

    def __copy__(self) -> Self:
        """Itself: another one's slots would be used again, as its foil would not know of it."""
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled with its own layers alone, to be the state of a foil of its own."""
        return _alone, (*self.foil.made_of, self.layers)

    @property
    def layers(self) -> np.ndarray:
        """See `Layers.values`; shape (elements_along, layers, 4, elements_around)."""
        return np.ascontiguousarray(self.foil.values[self.slots].transpose(0, 3, 2, 1))

    @property
    def accumulated(self) -> np.ndarray:
        """Accumulated plastic strain, shape (elements_along, layers, elements_around)."""
        return self.layers[:, :, 3]

    @property
    def strains(self) -> np.ndarray:
        """Mean of the plastic strains and curvature, shape (elements_along, 6, elements_around)."""
        return np.ascontiguousarray(self.foil.sums[self.slots, :6].transpose(0, 2, 1))

    def strains_of(self, elements: np.ndarray) -> np.ndarray:
        """The same of some elements, shape (elements, 6)."""
        return self.foil.sums[self.slots.ravel()[elements], :6]

    @property
    def energy(self) -> float:
        """Elastic energy that the plastic strains alone would have, J."""
        return float(self._energies[0])

    @property
    def dissipated(self) -> float:
        """Work that plastic flow has used up, J: all but what kinematic hardening keeps."""
        return float(self._energies[1])

    @property
    def kept(self) -> float:
        """What kinematic hardening keeps, J."""
        return float(self._energies[2])

    @cached_property
    def _energies(self) -> np.ndarray:
        out, foil = np.empty(3), self.foil
        energies(foil.values, self.slots, foil.frame, foil.flow, out)
        return out


def _alone(frame: np.ndarray, heights: np.ndarray, flow: Flow, layers: np.ndarray) -> PlasticState:
    return Layers(frame, heights, flow).filled(layers)


def differing(state: PlasticState, other: PlasticState | None) -> np.ndarray:
    """Elements, row times elements around plus column, that are not the same in two states."""
    if state is other:
        return np.empty(0, dtype=np.int64)
    if other is None or state.foil is not other.foil:
        return np.arange(state.slots.size)
    if state.since and state.since[0]() is other:
        return state.since[1]
    return np.flatnonzero(state.slots != other.slots)
