"""Force on the top ring of a crumple against its motion, about the state of rest."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_count, require_number
from foilstudy.linalg import SolveError
from foilstudy.measure.amplitude.curve import LINEAR_SHARE, ForceCurve, Side
from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.measure.stiffness.directional import MOTIONS as AXES
from foilstudy.measure.stiffness.stress_removal import Residual
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.solve.equilibrium.swept import RingMotion, SweepOptions, Swept, swept
from foilstudy.solve.problem import Problem

MOTIONS = {"radial_x": 0, "radial_y": 1, "axial": 2, "tilt_x": 3, "tilt_y": 4, "twist": 5}
"""Motions of the top ring, the bottom one held, in the order of the interface."""


@dataclass(frozen=True)
class SweepPlan:
    """How far a ring is moved and in what steps.

    Attributes
    ----------
    amplitude : float
        Of the motion to either side, m; of a rotation it is the way of the rim.
    steps : int
        Equal ones to the amplitude.
    smallest : float
        Before the first of these are steps that double, of which the first is at least this, m.
    stressed : bool
        About the crumple as it is; else about the same shape free of stress.
    until : float or None
        Change of the secant stiffness at which a side may end before the amplitude.
    solver : SweepOptions
    """

    amplitude: float = 1e-3
    steps: int = 8
    smallest: float = 1e-6
    stressed: bool = True
    until: float | None = None
    solver: SweepOptions = SweepOptions()

    def __post_init__(self) -> None:
        require_number("amplitude of a sweep", self.amplitude, "m", above=0)
        require_count("number of steps of a sweep", self.steps, 1)
        require_number("smallest step of a sweep", self.smallest, "m", above=0)

    @property
    def ways(self) -> np.ndarray:
        """From rest to the amplitude, m."""
        first = self.amplitude / self.steps
        halvings = max(0, int(np.floor(np.log2(first / self.smallest))))
        small = first / 2.0 ** np.arange(halvings, 0, -1)
        return np.concatenate([small, first * np.arange(1, self.steps + 1)])


def ring_sweep(crumpled: Crumpled, motion: str, plan: SweepPlan | None = None) -> ForceCurve:
    """Move the top ring there and, from rest again, back, and note the force at every step.

    Rotations are counted by the way of the rim: motions are in m, forces in N and stiffness in N/m
    for them, too. About a crumple that is free of stress the force at rest is zero. Of a foil with
    a memory, such as a plastic one, either side is a path of loading from the state in which it
    has arrived.

    Parameters
    ----------
    crumpled : Crumpled
    motion : str
        One of `MOTIONS`.
    plan : SweepPlan, optional

    Returns
    -------
    ForceCurve
        Never raises for a foil that finds no equilibrium on the way: the status of its steps and
        the message say so.

    Raises
    ------
    Refusal
        If there is no such motion, or the removal of the stress leaves some of it.
    """
    plan = plan or SweepPlan()
    if motion not in MOTIONS:
        raise Refusal(f"a ring has no motion {motion!r}; give one of {', '.join(MOTIONS)}.")
    sides, rest, reasons = [], None, []
    for sign in (1, -1):
        try:
            found = _side(
                crumpled, RingMotion(MOTIONS[motion], crumpled.foil.diameter / 2), sign, plan
            )
        except SolveError as error:
            return ForceCurve(np.nan, (), str(error))
        rest, *steps = found
        if rest.status != "converged":
            return ForceCurve(rest.tangent, (), rest.message)
        sides.append(_measured(rest, steps))
        reasons += _reasons(steps)
    return ForceCurve(rest.tangent, tuple(sides), "; ".join(reasons))


def linear_amplitude(crumpled: Crumpled, direction: str, plan: SweepPlan | None = None) -> float:
    """Smallest amplitude at which the secant stiffness of a direction has changed by 1 %, m.

    Of the radial direction that of the two axes that comes first. Infinite where the sweep shows
    less of a change, NaN where it ended for want of an equilibrium.

    Parameters
    ----------
    crumpled : Crumpled
    direction : str
        ``axial`` or ``radial``.
    plan : SweepPlan, optional
    """
    if direction not in DIRECTIONS:
        raise Refusal(f"there is no direction {direction!r}; give {' or '.join(DIRECTIONS)}.")
    plan = replace(plan or SweepPlan(), until=LINEAR_SHARE)
    names = [name for name, axis in MOTIONS.items() if axis in AXES[direction]]
    return float(np.min([ring_sweep(crumpled, name, plan).linear_amplitude() for name in names]))


def problem_about(crumpled: Crumpled, stressed: bool) -> Problem:
    if stressed:
        return crumpled.problem()
    relieved = crumpled.relieved()
    if isinstance(relieved, Residual):
        raise Refusal(
            "a stress removal that leaves stress has no shape at rest to sweep about; use `reset`, "
            "or sweep the stressed crumple."
        )
    return Problem(relieved)


def _side(crumpled: Crumpled, motion: RingMotion, sign: int, plan: SweepPlan) -> list[Swept]:
    """Rest and the steps to one side, ended where the plan lets them."""
    problem = problem_about(crumpled, plan.stressed)
    found: list[Swept] = []
    for each in swept(problem, crumpled.points, motion, sign * plan.ways, plan.solver):
        found.append(each)
        if plan.until and each.way:
            secant = (each.force - found[0].force) / each.way
            if abs(secant / found[0].tangent - 1) > plan.until:
                break
    return found


def _measured(rest: Swept, steps: list[Swept]) -> Side:
    def column(name: str) -> np.ndarray:
        good = [each.status in ("converged", "snapped") for each in steps]
        values = np.array([getattr(each, name) for each in steps], dtype=float)
        return np.where(good, values, np.nan)

    return Side(
        np.array([each.way for each in steps]),
        column("force") - rest.force,
        column("tangent"),
        column("energy") - rest.energy,
        column("released"),
        tuple(each.status for each in steps),
    )


def _reasons(steps: list[Swept]) -> list[str]:
    """What there is to say of the steps of a side."""
    reasons = [
        f"snapped before {1e3 * each.way:+.3g} mm, which set {each.released:.2g} J free"
        for each in steps
        if each.status == "snapped"
    ]
    last = steps[-1]
    if last.status not in ("converged", "snapped"):
        reasons.append(f"no equilibrium at {1e3 * last.way:+.3g} mm: {last.message}")
    return reasons
