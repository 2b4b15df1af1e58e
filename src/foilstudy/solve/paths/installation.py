"""The path of a fitter: the ring goes further than the gap, or to and fro, before it stays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from foilstudy.base.costs import Cost, measured
from foilstudy.solve.equilibrium.settle import settle
from foilstudy.solve.paths import Arrival
from foilstudy.solve.paths.relaxation import RelaxationPath, arrived, ended
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.loop import History, Ramp, RelaxationResult, relax
from foilstudy.solve.relaxation.scheme import Motion

__all__ = ["InstallationPath"]


@dataclass(frozen=True)
class InstallationPath(RelaxationPath):
    """See `RelaxationPath`; the ring stops on the way, and the sheet comes near to rest there.

    Attributes
    ----------
    stages : tuple of float
        Where the ring stops before the gap, in turn, as shares of the shortening that closes it:
        1.25 is a quarter further than the gap. A part of the way takes that part of the steps.
    """

    kind = "installation"
    stages: tuple[float, ...] = ()

    def follow(
        self, problem: Problem, shortening: float, start: np.ndarray | None = None
    ) -> Arrival:
        """See `Path`."""
        motion = self.scheme.start(problem)
        with measured() as relaxing:
            done = self._staged(problem, motion, shortening, start)
        last = _joined(done)
        if last.status == "diverged":
            return ended(last, {"relaxing": relaxing})
        spent = done[-1].steps - self._steps(len(self.stages))
        left = self.settling.relaxation_steps_max - spent
        with measured() as cost:
            settled = settle(
                problem, motion, last.points, replace(self.settling, relaxation_steps_max=left)
            )
        return arrived(problem, settled, {"relaxing": relaxing, "settling": cost}, last)

    def push(self, problem: Problem, shortening: float, start: np.ndarray | None = None) -> Arrival:
        """See `Path`."""
        with measured() as cost:
            done = self._staged(problem, self.scheme.start(problem), shortening, start)
        costs: dict[str, Cost] = {"relaxing": cost}
        state = problem.state if problem.has_memory else ()
        return replace(ended(_joined(done), costs), state=state)

    def _staged(
        self, problem: Problem, motion: Motion, shortening: float, start: np.ndarray | None
    ) -> list[RelaxationResult]:
        """One result for each stop and the gap; the last one diverged if any did."""
        done: list[RelaxationResult] = []
        for k, part in enumerate(self._parts()):
            ramp = Ramp(part * shortening, self._steps(k))
            done.append(relax(problem, motion, ramp, self.stopping_rule(), start))
            start = done[-1].points
            if done[-1].status == "diverged":
                break
        return done

    def _parts(self) -> np.ndarray:
        """Of the shortening, from each stop to the next."""
        return np.diff([0.0, *self.stages, 1.0])

    def _steps(self, k: int) -> int:
        """Of the ramp to the k-th stop."""
        return max(1, round(self.ramp_steps * abs(self._parts()[k])))


def _joined(done: Sequence[RelaxationResult]) -> RelaxationResult:
    """The last one, with the steps and the history of all."""
    firsts = np.cumsum([0, *(each.steps for each in done)])
    moved = [
        replace(each.history, step=each.history.step + first) for each, first in zip(done, firsts)
    ]
    history = History(
        *(
            np.concatenate([getattr(part, name) for part in moved])
            for name in ("step", "height", "reaction_force")
        ),
        {
            name: np.concatenate([part.energies[name] for part in moved])
            for name in moved[0].energies
        },
        *(
            np.concatenate([getattr(part, name) for part in moved])
            for name in ("kinetic_energy", "residual")
        ),
    )
    return replace(done[-1], steps=int(firsts[-1]), history=history)
