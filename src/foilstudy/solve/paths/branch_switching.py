"""Arc length that leaves its path at bifurcations, along the lowest mode."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.solve.continuation import ArcSteps, Switching
from foilstudy.solve.paths.continued import ContinuedPath


@dataclass(frozen=True)
class BranchSwitchingPath(ContinuedPath):
    """Like `ArcLengthPath` on a sphere, and onto the branch where stability is lost.

    A foil with an imperfection has limit points in place of bifurcations, and is followed as by arc
    length alone.

    Attributes
    ----------
    first_step, longest_step, budget, settling
        See `ContinuedPath`.
    bisections : int
        Of the step in which stability is lost.
    """

    kind = "branch_switching"
    bisections: int = 5

    def rule(self) -> ArcSteps:
        """See `ContinuedPath`."""
        return ArcSteps(switching=Switching(self.bisections))
