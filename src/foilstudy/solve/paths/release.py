"""A ring that is let go: it follows the foil along the axis until nothing pushes it any more."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from foilstudy.model.patch import RING_ROWS
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.loop import Ramp, RelaxationResult, StoppingRule, relax
from foilstudy.solve.relaxation.scheme import Motion

FORCE_LEFT = 1e-2
"""Of the force on the ring before it was let go, at which it counts as free."""
_WAYS_MAX = 40
_FIRST, _LONGEST = 0.02, 0.2
"""The first way of the ring and the longest, over the distance to the height of the foil."""
_STEPS_MIN = 100
_ROUNDING = 1e-9
_REST_STEPS = 1000
"""After each way at most: a foil without force has nothing to measure its residual by."""


@dataclass(frozen=True)
class Release:
    """How a ring is let go.

    Attributes
    ----------
    motion : Motion
        Of the relaxation.
    rule : StoppingRule
        When the sheet counts as at rest on the way.
    pace : float
        Steps of a ramp for each metre.
    highest : float
        Height of the foil before it was crumpled, beyond which the ring does not go, m.
    """

    motion: Motion
    rule: StoppingRule
    pace: float
    highest: float


@dataclass(frozen=True, eq=False)
class LetGo:
    """Where a ring has come to that was let go.

    Attributes
    ----------
    results : list of RelaxationResult
        One for each way; the last one diverged if any did.
    height : float
        m.
    free : bool
        Whether nothing pushes it there any more, or the foil is as high as it was made.
    """

    results: list[RelaxationResult]
    height: float
    free: bool

    @property
    def free_height(self) -> float:
        """The height, NaN where the ring did not come free."""
        return self.height if self.free else np.nan


def let_go(problem: Problem, release: Release, points: np.ndarray | None) -> LetGo:
    """Follow the ring up, or down where the foil pulls it, by secants of its force.

    The other motions of the ring are held.

    Parameters
    ----------
    problem : Problem
        Its state follows.
    release : Release
    points : ndarray, shape (3, rows, columns), or None
        Where the ring is let go, near rest, m; a foil that nobody has touched stays as it is.
    """
    if points is None:
        return LetGo([], release.highest, free=True)
    done: list[RelaxationResult] = []
    stored = problem.shell.energies(points).total
    height, force = _ring(problem, points)
    most = min(release.rule.relaxation_steps_max, _REST_STEPS)
    rule = replace(release.rule, relaxation_steps_max=most, energy=stored)
    enough, longest = FORCE_LEFT * abs(force), _LONGEST * (release.highest - height)
    way = np.copysign(_FIRST * (release.highest - height), force)
    while abs(force) > enough and len(done) < _WAYS_MAX:
        way = min(way, release.highest - height)
        if release.highest - height <= _ROUNDING * height and force > 0:  # as high as it can be
            break
        ramp = Ramp(-way, max(_STEPS_MIN, round(release.pace * abs(way))))
        done.append(relax(problem, release.motion, ramp, rule, points))
        points = done[-1].points
        if done[-1].status == "diverged":
            break
        before, (height, force) = force, _ring(problem, points)
        stiffness = (before - force) / way
        # where it does not soften as it goes, the force tells the direction alone
        wanted = force / stiffness if stiffness > 0 else np.copysign(longest, force)
        way = float(np.clip(wanted, -longest, longest))
    at_end = release.highest - height <= _ROUNDING * height
    return LetGo(done, height, bool(abs(force) <= enough or at_end))


def _ring(problem: Problem, points: np.ndarray) -> tuple[float, float]:
    """Height of the top ring, m, and the axial force by which the sheet pushes it up, N."""
    force = np.empty_like(points)
    problem.force(points, force)
    return problem.ring_height(points), -float(force[2, -RING_ROWS:].sum())
