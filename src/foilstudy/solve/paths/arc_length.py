"""Arc length: the path is followed round its limit points, also where the rings have to recede."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.solve.continuation import ArcSteps
from foilstudy.solve.paths.continued import ContinuedPath


@dataclass(frozen=True)
class ArcLengthPath(ContinuedPath):
    """Steps of the arc length, which may turn back.

    Attributes
    ----------
    first_step, longest_step, budget, settling
        See `ContinuedPath`.
    surface : str
        On which a step ends: ``sphere`` and ``cylinder`` as with Crisfield, ``plane`` as with Riks.
    """

    kind = "arc_length"
    surface: str = "sphere"

    def rule(self) -> ArcSteps:
        """See `ContinuedPath`."""
        return ArcSteps(self.surface)
