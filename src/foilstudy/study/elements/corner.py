"""The default's sampling by the general kernel, with any treatment of bending."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.model.shell.elements import sampling
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.model.shell.elements.sampled import SampledKernel
from foilstudy.model.shell.section import Section


@dataclass(frozen=True)
class CornerSampled:
    """The default's sampling and checkerboard control, but for the treatment of bending."""

    fold: float
    bending_points: int = 1
    name: str = "corner, sampled"

    def kernel(self, section: Section) -> SampledKernel:
        """The general kernel; its control of the checkerboard depends on the section."""
        share = Corner().share(section)
        return SampledKernel(section, sampling.corner(share, self.fold, self.bending_points))
