"""What a law with a memory sees of an element: its mean strains, and what stresses on them do.

Six strains of each element, e_11, e_22, 2 e_12 (mean over the membrane samples) and k_11, k_22,
2 k_12 (over the bending samples, with the fold measure of the element), relative to the shape that
is free of stress. An inelastic part of them, uniform over the element, takes the same off every
sample: what the samples differ by stays elastic.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from foilstudy.model.shell.elements import mean_kernel, sampled_kernel
from foilstudy.model.shell.elements.sampling import LAW_PAIRS, StrainSampling
from foilstudy.model.shell.elements.sampling_tables import tables
from foilstudy.model.shell.section import Section


@dataclass(frozen=True, eq=False)
class Inelastic:
    """Mean strains that cost no elastic stress, and the stress that they take off.

    Attributes
    ----------
    strains : ndarray, shape (elements_along, 6, elements_around)
        1 and 1/m.
    stresses : ndarray, same shape
        Conjugate to the strains, times the areas of the elements, N m and N m2.
    """

    strains: np.ndarray
    stresses: np.ndarray

    @classmethod
    def of(cls, section: Section, strains: np.ndarray) -> Inelastic:
        """By the elastic stiffness of a section."""
        c11, c22, c12, c16, c26, c66 = section.stiffness.transpose(1, 0, 2)
        stresses = np.empty_like(strains)
        for first, factor in ((0, 1.0), (3, section.local_thickness**2 / 12)):
            e1, e2, e6 = strains[:, first : first + 3].transpose(1, 0, 2)
            stresses[:, first] = factor * (c11 * e1 + c12 * e2 + c16 * e6)
            stresses[:, first + 1] = factor * (c12 * e1 + c22 * e2 + c26 * e6)
            stresses[:, first + 2] = factor * (c16 * e1 + c26 * e2 + c66 * e6)
        return cls(strains, stresses)


class Rows(NamedTuple):
    """What `mean_kernel` takes the strains of one row of elements after the other from.

    Attributes
    ----------
    rest : ndarray
        See `mean_kernel.packed`.
    spacings : tuple of float
        Element lengths around and along, m.
    """

    rest: np.ndarray
    spacings: tuple[float, float]


class SampledMeanStrains:
    """Those of any strain sampling, from two evaluations of the general kernel.

    Parameters
    ----------
    section : Section
    sampling : StrainSampling

    Attributes
    ----------
    rows : Rows or None
        None: it knows no other way than all strains at once.
    """

    rows: Rows | None = None

    def __init__(self, section: Section, sampling: StrainSampling):
        patch = section.patch
        self._section = section
        self._tables = tables(sampling, patch.size_around, patch.size_along)
        self._component = self._tables.component
        own = {pair[0]: k for k, pair in enumerate(LAW_PAIRS) if pair[0] == pair[1]}
        share = np.array([sampling.forms[own[c], s, s] for s, c in enumerate(self._component)])
        self._mean = share * (self._component == np.arange(3)[:, None])
        self._mean /= self._mean.sum(axis=1, keepdims=True)
        self._samples = self._sampled(section.reference)

    def strains(self, points: np.ndarray) -> np.ndarray:
        """Of every element, shape (elements_along, 6, elements_around), 1 and 1/m."""
        now, rest, members = self._sampled(points), self._samples, self._component.size
        fold, weights = self._tables.fold, self._tables.bending_weight
        membrane = (now - rest)[..., :members] @ self._mean.T
        bent, bent_rest = (s[..., members:].reshape(*s.shape[:2], -1, 4) for s in (now, rest))
        measure = 1 - fold + fold * bent_rest[..., 3:] / bent[..., 3:]
        bending = weights @ (bent_rest[..., :3] - measure * bent[..., :3])
        return np.concatenate([membrane, bending], axis=2).transpose(0, 2, 1).copy()

    def force(self, points: np.ndarray, inelastic: Inelastic, out: np.ndarray) -> float:
        """Write the force, N, and return the work, J, of the stresses that the elements lack.

        The work is -stresses . strains, the force its derivative.

        Parameters
        ----------
        points, out : ndarray, shape (3, rows, columns)
        inelastic : Inelastic
        """
        elastic = np.empty_like(out)
        sampled_kernel.force(points, *self._arguments(self._samples), elastic)
        sampled_kernel.force(points, *self._arguments(self._relieved(inelastic)), out)
        out -= elastic
        return -float(np.sum(inelastic.stresses * self.strains(points)))

    def tangent_blocks(self, points: np.ndarray, inelastic: Inelastic) -> np.ndarray:
        """The derivative of that; blocks as in `ElementKernel.tangent_blocks`."""
        points = np.ascontiguousarray(points)
        blocks = sampled_kernel.assemble(points, *self._arguments(self._relieved(inelastic)), True)
        blocks -= sampled_kernel.assemble(points, *self._arguments(self._samples), True)
        return blocks

    def _sampled(self, points: np.ndarray) -> np.ndarray:
        return sampled_kernel.reference_samples(
            np.ascontiguousarray(points), self._section.patch.elements_around, self._tables
        )

    def _relieved(self, inelastic: Inelastic) -> np.ndarray:
        """Samples of the stress-free shape, moved by inelastic strains."""
        samples, members = self._samples.copy(), self._component.size
        by_element = inelastic.strains.transpose(0, 2, 1)
        samples[..., :members] += by_element[..., self._component]
        for first in range(members, samples.shape[2], 4):
            samples[..., first : first + 3] -= by_element[..., 3:]
        return samples

    def _arguments(self, samples: np.ndarray) -> tuple:
        section = self._section
        bend = section.thickness**2 / 12
        return section.patch.elements_around, section.stiffness, bend, samples, self._tables


class CornerMeanStrains(SampledMeanStrains):
    """The same of `sampling.corner`, with vectorised strains."""

    def __init__(self, section: Section, sampling: StrainSampling):
        super().__init__(section, sampling)
        patch = section.patch
        members = self._component.size
        rest = [self._samples[..., :members] @ self._mean.T, self._samples[..., members:]]
        rest = np.concatenate(rest, axis=2).transpose(0, 2, 1)
        self.rows = Rows(mean_kernel.packed(rest), (patch.size_around, patch.size_along))

    def strains(self, points: np.ndarray) -> np.ndarray:
        """See `SampledMeanStrains`."""
        out = np.empty(self._section.stiffness.shape)
        rest, spacings = self.rows
        mean_kernel.strains(np.ascontiguousarray(points), spacings, rest, out)
        return out
