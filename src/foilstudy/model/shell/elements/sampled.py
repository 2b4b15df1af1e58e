"""Sheet elements with any strain sampling, by one general kernel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.shell.elements import sampled_kernel
from foilstudy.model.shell.elements.sampling import StrainSampling, staggered
from foilstudy.model.shell.section import Section

_BASIS = 5
"""a_1, a_2, a_11, a_22, a_12."""


def basis_weights(at: np.ndarray, h1: float, h2: float) -> np.ndarray:
    """Weights of the nine control points in a_1, a_2, a_11, a_22, a_12, shape (points, 9, 5)."""

    def line(x, h):
        value = np.array([(1 - x) ** 2 / 2, 0.5 + x - x**2, x**2 / 2])
        slope = np.array([x - 1, 1 - 2 * x, x]) / h
        return value, slope, np.array([1.0, -2.0, 1.0]) / h**2

    weights = np.empty((len(at), 9, _BASIS))
    for p, (x, y) in enumerate(at):
        v1, s1, c1 = line(x, h1)
        v2, s2, c2 = line(y, h2)
        pairs = ((v2, s1), (s2, v1), (v2, c1), (c2, v1), (s2, s1))
        for q, (along, around) in enumerate(pairs):
            weights[p, :, q] = np.outer(along, around).ravel()
    return weights


def tables(sampling: StrainSampling, h1: float, h2: float) -> sampled_kernel.Tables:
    """A strain sampling as arrays for the kernels, on elements of h1 around and h2 along."""
    at = sorted({m[1:] for m in sampling.membrane} | {b[:2] for b in sampling.bending})
    place = {point: p for p, point in enumerate(at)}
    bending = np.array([place[b[:2]] for b in sampling.bending])
    pairs, factors = [], []
    for part, forms in ((0, sampling.forms), (2, sampling.control)):
        for k, a, b in zip(*np.nonzero(forms), strict=True):
            if a <= b:
                pairs.append((a, b, k, part))
                factors.append(forms[k, a, b])
    return sampled_kernel.Tables(
        weights=basis_weights(at, h1, h2),
        # a_1 and a_2 are enough where only membrane strain is sampled
        needs=np.where(np.isin(np.arange(len(at)), bending), _BASIS, 2),
        component=np.array([component for component, *_ in sampling.membrane]),
        position=np.array([place[m[1:]] for m in sampling.membrane]),
        pairs=np.array(pairs),
        pair_weight=np.array(factors),
        bending_position=bending,
        bending_weight=np.array([b[2] for b in sampling.bending]),
        fold=sampling.fold,
    )


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
