"""Where a march stands."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.solve.continuation.constraints import Increment
from foilstudy.solve.continuation.corrector import Corrected
from foilstudy.solve.continuation.linearised import Tangent


@dataclass(frozen=True, eq=False)
class Place:
    """An equilibrium with its tangent.

    Attributes
    ----------
    found : Corrected
    tangent : Tangent
    last : Increment
        The step that led there, or the direction to begin with.
    leapt : bool
        Whether that step left the path.
    """

    found: Corrected
    tangent: Tangent
    last: Increment
    leapt: bool = False

    @property
    def factor(self) -> float:
        """At the equilibrium."""
        return self.found.factor

    @property
    def negative_eigenvalues(self) -> int:
        """Of the tangent."""
        return self.tangent.negative_eigenvalues

    @property
    def base(self) -> Increment:
        """Unknowns and factor."""
        return Increment(self.found.q, self.found.factor)

    def to(self, found: Corrected) -> Increment:
        """From here to there."""
        return Increment(found.q - self.found.q, found.factor - self.factor)
