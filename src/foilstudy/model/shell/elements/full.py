"""An element that fails: full integration, which locks.

Membrane strains are those of the displacements, taken at 3 x 3 points. A fold that is narrower than
a few elements cannot bend without them, so that thin foil is far too stiff; kept to show why the
others sample fewer strains.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from foilstudy.model.shell.elements.sampled import Sampled
from foilstudy.model.shell.elements.sampling import StrainSampling, gauss


@dataclass(frozen=True)
class Full(Sampled):
    """Gauss points of the full integral, by the general kernel."""

    sampling: StrainSampling = field(default_factory=lambda: gauss(3), repr=False)
    name: ClassVar[str] = "full"
