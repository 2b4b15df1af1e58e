"""Whether a foil becomes elastic once its ring has gone to and fro a few times.

The ring moves at the pace of the ramp that crumpled the foil, which settles at both ends and back
in its gap. What plastic flow uses up in a cycle tells how far from elastic it was.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_count, require_number
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.one_sided import dissipated_work, ring_force
from foilstudy.solve.equilibrium.settle import settle
from foilstudy.solve.paths.relaxation import RelaxationPath, arrived
from foilstudy.solve.relaxation.loop import Ramp, relax

_STEPS_MIN = 200
"""Of a ramp, however short its way."""


@dataclass(frozen=True, eq=False, repr=False)
class Shakedown:
    """Cycles of the top ring about the gap.

    Attributes
    ----------
    status : str
        ``converged``: the last cycle used up next to nothing and led back to the same force;
        ``not_converged``: none of those allowed did; else that of the way on which the foil was
        lost.
    message : str
        One sentence on the status.
    amplitude : float
        m.
    dissipated : ndarray, shape (cycles,)
        Work that plastic flow used up in each cycle, J; never negative.
    reactions : ndarray, shape (cycles + 1,)
        Axial force on the top ring in the gap, before the first cycle and after each, N.
    foil : Crumpled
        After the last cycle, back in its gap.
    """

    status: str
    message: str
    amplitude: float
    dissipated: np.ndarray
    reactions: np.ndarray
    foil: Crumpled

    @property
    def cycles(self) -> int:
        """How many were completed."""
        return self.dissipated.size

    def __repr__(self) -> str:
        return f"<Shakedown: {self.status}, {self.message}>"


def shaken_down(
    crumpled: Crumpled, amplitude: float, share: float = 1e-3, cycles_max: int = 10
) -> Shakedown:
    """Cycle the top ring until nothing more is used up: first together, then apart, then back.

    Parameters
    ----------
    crumpled : Crumpled
        At rest in its gap; it is left as it is.
    amplitude : float
        m; less than half the gap, and less than what crumpling has shortened the foil by.
    share : float
        Of the elastic energy in the foil that a cycle may use up, and of the force on the ring by
        which it may change, for the foil to count as elastic. Elastic foil that snaps to another
        equilibrium in its gap uses up nothing, but its force changes.
    cycles_max : int

    Returns
    -------
    Shakedown
        Never raises for a foil that is lost on the way: the status says so.

    Raises
    ------
    Refusal
        If the rings would leave their range, or the foil was not crumpled by relaxation.
    """
    foil, path = crumpled.foil, crumpled.method.path
    if not isinstance(path, RelaxationPath):
        raise Refusal(f"cycles of the ring are followed by relaxation, not by {path.kind}.")
    limit = min(foil.gap_height / 2, foil.shortening)
    require_number("amplitude of a cycle", amplitude, "m", above=0, below=limit)
    require_number("share of the energy in a cycle", share, above=0)
    require_count("number of cycles", cycles_max, 1)
    problem = crumpled.problem()
    enough = share * problem.value(crumpled.points)
    dissipated, reactions = [], [_reaction(crumpled)]
    for cycle in range(1, cycles_max + 1):
        before = dissipated_work(problem)
        for way in (amplitude, -2 * amplitude, amplitude):
            crumpled = _moved(crumpled, path, way)
            if crumpled.status != "converged":
                message = f"cycle {cycle}: {crumpled.message}"
                return _ended(crumpled.status, message, amplitude, dissipated, reactions, crumpled)
        problem = crumpled.problem()
        dissipated.append(dissipated_work(problem) - before)
        reactions.append(_reaction(crumpled))
        change = abs(reactions[-1] - reactions[-2])
        if dissipated[-1] <= enough and change <= share * abs(reactions[-1]):
            message = f"elastic in cycle {cycle}, which used up {dissipated[-1]:.2g} J"
            return _ended("converged", message, amplitude, dissipated, reactions, crumpled)
    message = (
        f"cycle {cycles_max} still used up {dissipated[-1]:.2g} J and changed the force on the "
        f"ring by {change:.2g} N"
    )
    return _ended("not_converged", message, amplitude, dissipated, reactions, crumpled)


def _ended(status, message, amplitude, dissipated, reactions, foil) -> Shakedown:
    return Shakedown(status, message, amplitude, np.array(dissipated), np.array(reactions), foil)


def _moved(crumpled: Crumpled, path: RelaxationPath, shortening: float) -> Crumpled:
    """The ring moved at the pace of the ramp, and the foil settled there."""
    problem = crumpled.problem()
    motion = path.scheme.start(problem)  # its mass minds the contact of the same problem
    pace = path.ramp_steps / crumpled.foil.shortening
    ramp = Ramp(shortening, max(_STEPS_MIN, round(pace * abs(shortening))))
    relaxed = relax(problem, motion, ramp, path.stopping_rule(), crumpled.points)
    settled = settle(problem, motion, relaxed.points, path.settling)
    arrival = arrived(problem, settled, {}, relaxed)
    return replace(crumpled, points=arrival.points, arrival=arrival)


def _reaction(crumpled: Crumpled) -> float:
    return -float(ring_force(crumpled.problem(), crumpled.points)[2])
