"""The path of a fitter: the ring goes too far, turns, or goes to and fro, before it stays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from foilstudy.base.costs import Cost, measured
from foilstudy.base.errors import Refusal
from foilstudy.model.patch import RING_ROWS
from foilstudy.model.supports.moves import IN_PLACE, Move, Pose, poses
from foilstudy.solve.equilibrium.settle import settle
from foilstudy.solve.paths import Arrival
from foilstudy.solve.paths.relaxation import RelaxationPath, arrived, ended
from foilstudy.solve.paths.release import Release, let_go
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.loop import History, Ramp, RelaxationResult, relax
from foilstudy.solve.relaxation.scheme import Motion
from foilstudy.solve.relaxation.turning import Turning

__all__ = ["InstallationPath"]


@dataclass(frozen=True)
class InstallationPath(RelaxationPath):
    """See `RelaxationPath`; the ring moves on the way, and the sheet comes near to rest there.

    Attributes
    ----------
    moves : tuple of Move
        In turn, before the ring comes to the gap and stands straight. The ring keeps the pace of
        the ramp: a part of the way takes that part of the steps.
    """

    kind = "installation"
    moves: tuple[Move, ...] = ()

    def follow(
        self, problem: Problem, shortening: float, start: np.ndarray | None = None
    ) -> Arrival:
        """See `Path`.

        Raises
        ------
        Refusal
            If a move takes the rings out of their range, or the way is to begin elsewhere than at
            the cylinder.
        """
        motion = self.scheme.start(problem)
        with measured() as relaxing:
            done = self._fitted(problem, motion, shortening, start)
        last = _joined(done.results)
        if last.status == "diverged":
            return replace(ended(last, {"relaxing": relaxing}), free_heights=done.free_heights)
        left = self.settling.relaxation_steps_max - done.relaxation_steps
        with measured() as cost:
            settled = settle(
                problem, motion, last.points, replace(self.settling, relaxation_steps_max=left)
            )
        arrival = arrived(problem, settled, {"relaxing": relaxing, "settling": cost}, last)
        return replace(arrival, free_heights=done.free_heights)

    def push(self, problem: Problem, shortening: float, start: np.ndarray | None = None) -> Arrival:
        """See `Path`."""
        with measured() as cost:
            done = self._fitted(problem, self.scheme.start(problem), shortening, start)
        costs: dict[str, Cost] = {"relaxing": cost}
        state = problem.state if problem.has_memory else ()
        arrival = ended(_joined(done.results), costs)
        return replace(arrival, state=state, free_heights=done.free_heights)

    def _fitted(
        self, problem: Problem, motion: Motion, shortening: float, start: np.ndarray | None
    ) -> _Fitting:
        """One result for each part of the way; the last one diverged if any did."""
        if start is not None:
            raise Refusal(
                "method.path: installation fits a cylinder; take relaxation from elsewhere."
            )
        radius, height = _dimensions(problem)
        refuse_out_of_range(self.moves, radius, height, height - shortening)
        done, here = _Fitting(), Pose()
        for _, there in [*poses(self.moves), (len(self.moves), IN_PLACE)]:
            if there is None:
                pace = self.ramp_steps / shortening
                release = Release(motion, self.stopping_rule(), pace, height)
                gone = let_go(problem, release, done.points)
                done.results += gone.results
                done.free_heights += (gone.free_height,)
                here = Pose((height - gone.height) / shortening, here.attitude)
            elif there != here:
                ramp = self._way(here, there, shortening, radius)
                done.results.append(relax(problem, motion, ramp, self.stopping_rule(), done.points))
                done.relaxation_steps = done.results[-1].steps - ramp.steps
                here = there
            if done.results and done.results[-1].status == "diverged":
                break
        return done

    def _way(self, here: Pose, there: Pose, shortening: float, radius: float) -> Ramp:
        part = there.shorten - here.shorten
        turning, turned = None, 0.0
        if here.attitude != there.attitude:
            turning = Turning(here.attitude, there.attitude)
            turned = here.attitude.way(there.attitude, radius) / shortening
        steps = max(1, round(self.ramp_steps * max(abs(part), turned)))
        return Ramp(part * shortening, steps, turning=turning)


@dataclass
class _Fitting:
    """What was done on the way.

    Attributes
    ----------
    relaxation_steps : int
        After the last ramp.
    """

    results: list[RelaxationResult] = field(default_factory=list)
    free_heights: tuple[float, ...] = ()
    relaxation_steps: int = 0

    @property
    def points(self) -> np.ndarray | None:
        return self.results[-1].points if self.results else None


def refuse_out_of_range(moves: Sequence[Move], radius: float, height: float, gap: float) -> None:
    """See `Pose.beyond`.

    Raises
    ------
    Refusal
        Of the first move that is.
    """
    for number, pose in poses(moves):
        if pose and (reason := pose.beyond(radius, height, gap)):
            raise Refusal(f"move {number + 1} of the installation {reason}.")


def _dimensions(problem: Problem) -> tuple[float, float]:
    """Radius of the rings and height of the uncrumpled sheet, m."""
    ring = problem.reference[:, -RING_ROWS:]
    height = float(problem.patch.size_along * (problem.reference.shape[1] - 2))
    return float(np.hypot(ring[0], ring[1]).mean()), height


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
