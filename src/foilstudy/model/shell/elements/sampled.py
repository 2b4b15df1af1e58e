"""Sheet elements with any strain sampling, by one general kernel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.shell.elements import sampled_kernel
from foilstudy.model.shell.elements.mean_strains import SampledMeanStrains
from foilstudy.model.shell.elements.sampling import StrainSampling, staggered
from foilstudy.model.shell.elements.sampling_tables import tables
from foilstudy.model.shell.section import Section


@dataclass(frozen=True)
class Sampled:
    """Any strain sampling, by the general (not vectorised) kernel.

    Attributes
    ----------
    sampling : StrainSampling
    """

    sampling: StrainSampling

    @property
    def name(self) -> str:
        return self.sampling.name

    def kernel(self, section: Section) -> SampledKernel:
        return SampledKernel(section, self.sampling)

    def mean_strains(self, section: Section) -> SampledMeanStrains:
        return SampledMeanStrains(section, self.sampling)

    def relief(self, section: Section) -> None:
        """Its force knows none; the stresses taken off are a force of their own."""


class SampledKernel:
    """Energy, force and tangent of one section with a strain sampling."""

    def __init__(self, section: Section, sampling: StrainSampling):
        patch = section.patch
        self._section = section
        self._tables = tables(sampling, patch.size_around, patch.size_along)
        self._samples = sampled_kernel.reference_samples(
            section.reference, patch.elements_around, self._tables
        )

    def force(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        return sampled_kernel.force(points, *self._arguments(), out)

    def tangent_blocks(self, points: np.ndarray | None) -> np.ndarray:
        shape = self._section.reference if points is None else points
        return sampled_kernel.assemble(
            np.ascontiguousarray(shape), *self._arguments(), points is not None
        )

    def _arguments(self) -> tuple:
        section = self._section
        bend = section.thickness**2 / 12
        return (
            section.patch.elements_around,
            section.stiffness,
            bend,
            self._samples,
            self._tables,
        )


STAGGERED = Sampled(staggered())
"""A second discretisation for the error of a given shape's stiffness; no vectorised kernel."""
