"""Block rational Krylov reduction: moments of the ring motions at a few frequencies.

The interior, moved by the rings at a frequency, is (K - omega2 M)^-1 times the inertia of the
constraint modes. A basis of its derivatives (moments) at a shift matches the dynamic stiffness
there to twice their order: E. J. Grimme, Krylov projection methods for model reduction, PhD thesis,
University of Illinois, 1997.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from foilstudy.linalg import BlockKrylov, projected, shifted
from foilstudy.measure.dynamics.accuracy import CHECKS, Wanted, with_estimate
from foilstudy.measure.dynamics.reduction import ReducedModel, project
from foilstudy.measure.dynamics.response import dynamic_stiffness, relative_error
from foilstudy.measure.dynamics.structure import INTERFACE, Structure

_FIRST_SHIFT = 0.6
"""Share of the highest frequency. With equally many vectors one shift is as accurate as two to
five (docs/dynamics.md), which cost a factorisation each."""
_MODES_SHARE, _CHECK_EVERY = 1.5, 2 * INTERFACE
"""When to check: vectors over modes below the shift, and after so many more. The error falls by a
factor of about ten meanwhile."""
_APART = 0.05
"""By how much a new shift differs from all others: the loads of the first block at a shift that has
served already are known."""


@dataclass(frozen=True)
class RationalKrylov:
    """Add moments, then shifts, until the dynamic stiffness no longer changes.

    Attributes
    ----------
    wanted : Wanted
        The error estimate is the change by the last moments, so of the model without them.
    moments_per_shift : int
        Blocks of 12 vectors before a new shift is set, where the change is largest.
    shifts_max : int
    """

    wanted: Wanted = field(default_factory=Wanted)
    moments_per_shift: int = 128
    shifts_max: int = 6

    @classmethod
    def for_band(cls, wanted: Wanted, cutoff_hz: float | None = None) -> RationalKrylov:
        """See `Reduction`; there is no cut-off."""
        return cls(wanted)

    def reduce(self, structure: Structure) -> ReducedModel:
        """Reduced model of the structure; its estimate says whether it meets the tolerance.

        Raises
        ------
        SolveError
            If a factorisation fails.
        """
        wanted = self.wanted
        frequencies = wanted.checked_at(CHECKS)
        space = _Space(structure)
        before, change = None, np.full(CHECKS, np.inf)
        shifts = [_FIRST_SHIFT * wanted.highest_hz]
        while True:
            for more in space.moments(shifts[-1], self.moments_per_shift):
                if not more:
                    # of the first shift: the space holds all that the rings can move
                    change = change if shifts[1:] else np.zeros(CHECKS)
                    return with_estimate(space.model(), wanted, frequencies, change)
                now = dynamic_stiffness(space.model(), frequencies, wanted.damping)
                if before is not None:
                    change = relative_error(before, now).reshape(-1, CHECKS).max(axis=0)
                if change.max() <= wanted.tolerance:
                    return with_estimate(space.model(), wanted, frequencies, change)
                before = now
            if len(shifts) == self.shifts_max:
                return with_estimate(space.model(), wanted, frequencies, change)
            shifts.append(_new_shift(shifts, frequencies, change))


def _new_shift(shifts: list[float], frequencies: np.ndarray, change: np.ndarray) -> float:
    """Where the change is largest; without one, or near another shift, the farthest from these."""
    distance = np.abs(np.subtract.outer(frequencies, shifts)).min(axis=1) / frequencies[-1]
    largest = change.argmax()
    if np.isfinite(change).all() and distance[largest] > _APART:
        return float(frequencies[largest])
    return float(frequencies[distance.argmax()])


class _Space:
    """Interior basis of the moments, and stiffness and inertia projected onto it as it grows."""

    def __init__(self, structure: Structure):
        self._structure = structure
        mass = structure.mass.interior
        self._krylov = BlockKrylov(mass)
        self._inertia = mass @ structure.static.constraint_modes + structure.mass.coupling
        self._stiffness, self._coupling = np.empty((0, 0)), np.empty((0, INTERFACE))
        nothing = np.empty((mass.shape[0], 0))
        self._static = project(structure, nothing, "rational_krylov")

    def moments(self, shift_hz: float, count: int) -> Iterator[bool]:
        """Add moments at a frequency; yields False where there is nothing left to add.

        Now and then, but at first not before there are more vectors than modes below the shift.
        """
        k, m = self._structure.stiffness.interior, self._structure.mass.interior
        inverse, _ = shifted(k, m, (2 * np.pi * shift_hz) ** 2)
        load, check_at = self._inertia, _MODES_SHARE * inverse.negative_eigenvalues
        for moment in range(1, count + 1):
            load = self._krylov.append(inverse, load)
            if not load.shape[1]:
                yield False
                return
            if moment == count or self._krylov.size >= check_at:
                check_at = self._krylov.size + _CHECK_EVERY
                yield True

    def model(self) -> ReducedModel:
        """Reduced model with the vectors so far."""
        self._project()
        static, basis = self._static, self._krylov.vectors
        size = INTERFACE + basis.shape[1]
        stiffness, mass = np.zeros((size, size)), np.eye(size)
        stiffness[:INTERFACE, :INTERFACE] = static.stiffness
        stiffness[INTERFACE:, INTERFACE:] = self._stiffness
        mass[:INTERFACE, :INTERFACE] = static.mass
        mass[INTERFACE:, :INTERFACE] = self._coupling
        mass[:INTERFACE, INTERFACE:] = self._coupling.T
        return replace(static, stiffness=stiffness, mass=mass, basis=basis)

    def _project(self) -> None:
        """Take the newest vectors into the projected matrices."""
        basis, old = self._krylov.vectors, self._stiffness.shape[0]
        self._stiffness = projected(self._structure.stiffness.interior, basis, self._stiffness)
        self._coupling = np.vstack([self._coupling, basis[:, old:].T @ self._inertia])
