"""The fictitious dynamics of a relaxation: as a specification, and at work on one sheet."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.base.spec import choice_field
from foilstudy.solve.choices import DAMPINGS, MASSES
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.damping import Damper, Damping
from foilstudy.solve.relaxation.damping.adaptive_viscous import AdaptiveViscousDamping
from foilstudy.solve.relaxation.mass import Mass, MassScaling
from foilstudy.solve.relaxation.mass.spectral import SpectralMassScaling
from foilstudy.solve.relaxation.mass.touching import TouchingMass, minding_contact


@dataclass(frozen=True)
class Scheme:
    """A mass scaling, and a damping for each of the two phases; nothing in it changes.

    Attributes
    ----------
    mass : MassScaling
    ramp_damping, relaxation_damping : Damping
    """

    mass: MassScaling = choice_field(MASSES, SpectralMassScaling)
    ramp_damping: Damping = choice_field(DAMPINGS, AdaptiveViscousDamping.for_ramp)
    relaxation_damping: Damping = choice_field(DAMPINGS, AdaptiveViscousDamping.for_relaxation)

    @classmethod
    def named(cls, mass: str, damping: str) -> Scheme:
        """From the names of `foilstudy.solve.choices`, with the numbers of a study."""
        kind = DAMPINGS[damping]
        return cls(MASSES[mass](), kind.for_ramp(), kind.for_relaxation())

    def start(self, problem: Problem) -> Motion:
        """Fresh mass and dampers for one run."""
        return Motion(
            minding_contact(self.mass.start(problem), problem),
            self.ramp_damping.start(),
            self.relaxation_damping.start(),
        )


@dataclass(eq=False)
class Motion:
    """A scheme at work. Its dampers remember, so that one run goes on where it was left.

    Attributes
    ----------
    mass : Mass
    ramp_damper, relaxation_damper : Damper
    """

    mass: Mass
    ramp_damper: Damper
    relaxation_damper: Damper

    @property
    def shortened_steps(self) -> int:
        """Steps that were shortened so far, lest parts of the sheet cross."""
        return self.mass.shortened if isinstance(self.mass, TouchingMass) else 0
