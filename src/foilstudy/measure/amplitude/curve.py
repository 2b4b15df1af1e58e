"""Force over motion about a state: secant and tangent, the linear range, even and odd content."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

LINEAR_SHARE = 0.01
"""Change of the secant stiffness that ends the linear range."""

GOOD = ("converged", "snapped")
"""Statuses of a step that has come to rest; what has snapped did so on another path."""


@dataclass(frozen=True, eq=False)
class Side:
    """Equilibria of a ring moved one way from the state of rest, in the order in which it went.

    Attributes
    ----------
    motion, force, tangent, energy : ndarray, shape (steps,)
        Way from rest, m, of one sign; force that moves the ring beyond what holds it at rest, N;
        its derivative by the motion, N/m; energy beyond that at rest, J. NaN where a step has not
        come to rest.
    released : ndarray, shape (steps,)
        Work of the ring on the step less what the foil has stored of it, J: zero on a path, what a
        snap sets free, or what plastic flow has used up.
    status : tuple of str
        ``converged``, ``snapped``, or why the minimum was not found; the side ends there.
    """

    motion: np.ndarray
    force: np.ndarray
    tangent: np.ndarray
    energy: np.ndarray
    released: np.ndarray
    status: tuple[str, ...]

    @property
    def found(self) -> np.ndarray:
        """Which steps have come to rest."""
        return np.array([each in GOOD for each in self.status], dtype=bool)

    @property
    def secant(self) -> np.ndarray:
        """Force over motion, N/m."""
        return self.force / self.motion

    def reaches(self, stiffness: float, share: float, values: np.ndarray | None = None) -> float:
        """First way, without its sign, at which the secant differs from a stiffness by a share.

        A power law of the change between two steps, which is exact where a change begins; from a
        step without a change of that sign, as from rest, on a straight line. Infinite where no
        step differs so much, m.

        Parameters
        ----------
        stiffness, share : float
        values : ndarray, optional
            Others than the secant, one for each step, N/m.
        """
        ways = np.abs(self.motion[self.found])
        change = (self.secant if values is None else values)[self.found] / stiffness - 1
        beyond = np.flatnonzero(np.abs(change) >= share)
        if not beyond.size:
            return np.inf
        k = int(beyond[0])
        if not k:
            return float(ways[0] * share / np.abs(change[0]))
        before, after = change[k - 1 : k + 1]
        wanted = np.copysign(share, after)
        if before * after > 0:
            place = np.log(wanted / before) / np.log(after / before)
            return float(ways[k - 1] * (ways[k] / ways[k - 1]) ** place)
        place = (wanted - before) / (after - before)
        return float(ways[k - 1] + place * (ways[k] - ways[k - 1]))


@dataclass(frozen=True, eq=False)
class ForceCurve:
    """Both sides of a sweep about a state.

    Attributes
    ----------
    stiffness : float
        Tangent at rest, N/m; NaN where there is none.
    sides : tuple of Side
        Towards positive and negative motion, or one of them.
    message : str
        What there is to say of the sweep; empty if nothing.
    """

    stiffness: float
    sides: tuple[Side, ...]
    message: str = ""

    def __repr__(self) -> str:
        ways = [f"{1e3 * w:+.3g}" for s in self.sides for w in s.motion[s.found][-1:]]
        steps = sum(len(side.motion) for side in self.sides)
        said = f"; {self.message}" if self.message else ""
        return (
            f"<ForceCurve: {self.stiffness:.4g} N/m at rest, {steps} steps to "
            f"{' and '.join(ways) or '0'} mm{said}>"
        )

    def linear_amplitude(self, share: float = LINEAR_SHARE) -> float:
        """Smallest amplitude at which the secant stiffness has changed by a share, m.

        That of the side where it comes first. Infinite where the whole sweep stays within it, NaN
        where a side ended earlier for want of an equilibrium.
        """
        return self._least([side.reaches(self.stiffness, share) for side in self.sides])

    def tangent_amplitude(self, share: float = LINEAR_SHARE) -> float:
        """The same of the tangent, which is what a small motion about a moved ring meets, m."""
        ways = [side.reaches(self.stiffness, share, side.tangent) for side in self.sides]
        return self._least(ways)

    def _least(self, ways: list[float]) -> float:
        least = min(ways, default=np.nan)
        cut = [np.abs(s.motion[s.found]).max(initial=0.0) for s in self.sides if not s.found.all()]
        return float(np.nan if any(least > way for way in cut) else least)

    def parts(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Amplitudes that both sides have reached, there the odd and the even part of the force.

        The odd part keeps its size when the motion turns round, as that of a spring; the even one
        its sign: a mean force.

        Returns
        -------
        amplitudes, odd, even : ndarray
            m, N, N.

        Raises
        ------
        ValueError
            If the sweep has one side only.
        """
        if len(self.sides) != 2:
            raise ValueError("even and odd parts of a force need both sides of the sweep")
        ahead, behind = self.sides
        steps = min(int(side.found.sum()) for side in self.sides)
        odd = (ahead.force[:steps] - behind.force[:steps]) / 2
        return ahead.motion[:steps], odd, (ahead.force[:steps] + behind.force[:steps]) / 2
