"""Which elements a law with a memory has to look at once a shape has been reached.

After a look an element has room: its strains may change by so much before anything happens in it.
Most elements of a foil have room in most steps of a motion, and cost no more than the proof of it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np

from foilstudy.model.patch import Patch
from foilstudy.model.shell.elements import mean_kernel


class Watch(Protocol):
    """At work along one motion."""

    def beyond(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Elements whose strains have changed by more than they had room for at the last look.

        They count as looked at, without room.

        Returns
        -------
        elements : ndarray of int, shape (number,)
            Row times elements around plus column, rising.
        strains : ndarray, shape (number, 6)
            1 and 1/m; good until the next call.
        """
        ...

    def note(self, elements: np.ndarray, room: np.ndarray) -> None:
        """Elements have room; what is not a number is none."""
        ...

    def forget(self, elements: np.ndarray) -> None:
        """Elements have to be looked at."""
        ...


class EveryElement:
    """Looks at all of them each time.

    Parameters
    ----------
    strains : callable
        Of the control points, shape (elements_along, 6, elements_around).
    """

    def __init__(self, strains: Callable[[np.ndarray], np.ndarray]):
        self._strains = strains

    def beyond(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """See `Watch`."""
        strains = self._strains(points).transpose(0, 2, 1).reshape(-1, 6)
        return np.arange(len(strains)), strains

    def note(self, elements: np.ndarray, room: np.ndarray) -> None:
        """It is not used."""

    def forget(self, elements: np.ndarray) -> None:
        """They are looked at in any case."""


class CornerWatch:
    """That of the corner-sampled element, by a vectorised bound.

    How much a change counts is measured by one form for all elements, which is above that of each
    by a factor on its room. Between two layers the count is convex, so that the outermost ones
    are enough.

    Parameters
    ----------
    patch : Patch
    rest : ndarray, shape (elements_along, elements_around, 7)
        Of the stress-free shape: mean of a_11 / 2, a_22 / 2, a_12; b_11, b_22, 2 b_12; |a_1 x a_2|.
    forms, farthest
        See `SampledMeanStrains.watch`.
    """

    def __init__(self, patch: Patch, rest: np.ndarray, forms: np.ndarray, farthest: float):
        along, around, _ = rest.shape
        self._n_around, self._spacings = around, (patch.size_around, patch.size_along)
        self._rest = np.ascontiguousarray(rest[..., :6]).reshape(-1, 6)
        half = np.linalg.cholesky(forms.mean(axis=0))
        inverse = np.linalg.inv(half)
        largest = np.linalg.eigvalsh(inverse @ forms @ inverse.T)[:, -1]
        self._share = np.broadcast_to(1 / largest, along * around)
        self._norm = (*(float(half[c, r]) for r in range(3) for c in range(r, 3)), farthest)
        cuts = mean_kernel.pieces(around)
        kept = np.zeros((along, len(cuts), mean_kernel.BLOCK))
        by_value = kept.reshape(along, len(cuts), mean_kernel.VALUES, -1)
        for piece, (start, count) in enumerate(cuts):
            by_value[:, piece, mean_kernel.AREA, :count] = rest[:, start : start + count, 6]
        self._kept = kept.ravel()
        first = np.concatenate(
            [piece * mean_kernel.BLOCK + np.arange(count) for piece, (_, count) in enumerate(cuts)]
        )
        rows = np.arange(along)[:, None] * len(cuts) * mean_kernel.BLOCK
        self._room_at = (rows + first + mean_kernel.ROOM * by_value.shape[-1]).ravel()
        self._elements = np.empty(along * around, dtype=np.int64)
        self._strains = np.empty((along * around, 6))

    def beyond(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """See `Watch`."""
        number = mean_kernel.beyond(
            np.ascontiguousarray(points), self._n_around, self._spacings, self._rest, self._kept,
            self._norm, self._elements, self._strains,
        )  # fmt: skip
        return self._elements[:number].copy(), self._strains[:number]

    def note(self, elements: np.ndarray, room: np.ndarray) -> None:
        """See `Watch`."""
        self._kept[self._room_at[elements]] = np.maximum(room, 0.0) ** 2 * self._share[elements]

    def forget(self, elements: np.ndarray) -> None:
        """See `Watch`."""
        self._kept[self._room_at[elements]] = 0.0
