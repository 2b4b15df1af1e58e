"""How high a foil springs once its ring is let go."""

from __future__ import annotations

from dataclasses import dataclass, replace

from foilstudy.base.errors import Refusal
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.one_sided import ring_force
from foilstudy.solve.equilibrium.settle import settle
from foilstudy.solve.paths.relaxation import RelaxationPath, arrived
from foilstudy.solve.paths.release import Release, let_go


@dataclass(frozen=True, eq=False, repr=False)
class SpringBack:
    """A foil whose top ring is free along its axis.

    Attributes
    ----------
    height : float
        To which it has sprung, m.
    force_left : float
        On the ring there, over that in the gap.
    foil : Crumpled
        At rest there.
    """

    height: float
    force_left: float
    foil: Crumpled

    @property
    def status(self) -> str:
        """That of the foil at rest."""
        return self.foil.status

    def __repr__(self) -> str:
        return f"<SpringBack: to {1e3 * self.height:.4g} mm, {self.status}>"


def sprung_back(crumpled: Crumpled) -> SpringBack:
    """Let go of the ring of a foil in its gap, and let the foil settle where that leads.

    Parameters
    ----------
    crumpled : Crumpled
        At rest; it is left as it is.

    Returns
    -------
    SpringBack
        Never raises for a foil that does not settle: the status says so.

    Raises
    ------
    Refusal
        If the foil was not crumpled by relaxation.
    """
    path, foil = crumpled.method.path, crumpled.foil
    if not isinstance(path, RelaxationPath):
        raise Refusal(f"a foil that springs back is followed by relaxation, not by {path.kind}.")
    problem = crumpled.problem()
    motion, before = path.scheme.start(problem), ring_force(problem, crumpled.points)[2]
    pace = path.ramp_steps / foil.shortening
    release = Release(motion, path.stopping_rule(), pace, foil.reference_height)
    ways = let_go(problem, release, crumpled.points).results
    last = ways[-1] if ways else None
    settled = settle(problem, motion, last.points if last else crumpled.points, path.settling)
    arrival = arrived(problem, settled, {}, last)
    free = replace(crumpled, points=arrival.points, arrival=arrival)
    problem = free.problem()
    force = ring_force(problem, free.points)[2]
    return SpringBack(problem.ring_height(free.points), float(force / before), free)
