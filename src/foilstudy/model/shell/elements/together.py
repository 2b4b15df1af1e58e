"""Sections that share their strains: a sheet whose thickness varies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.shell.elements.mean_strains import Inelastic
from foilstudy.model.shell.elements.protocol import Element, ElementKernel, MeanStrains, Relief
from foilstudy.model.shell.section import Section


@dataclass(frozen=True, eq=False)
class Together:
    """The sum of kernels on one patch, itself an `ElementKernel`.

    Attributes
    ----------
    kernels : tuple of ElementKernel
    """

    kernels: tuple[ElementKernel, ...]

    def force(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        """See `ElementKernel`."""
        first, *others = self.kernels
        energies, share = first.force(points, out).copy(), np.empty_like(out)
        for kernel in others:
            energies += kernel.force(points, share)
            out += share
        return energies

    def tangent_blocks(self, points: np.ndarray | None) -> np.ndarray:
        """See `ElementKernel`."""
        return sum(kernel.tangent_blocks(points) for kernel in self.kernels)


@dataclass(frozen=True, eq=False)
class MeanStrainsTogether:
    """Mean strains of a section that varies, and what inelastic ones do in all its parts.

    Attributes
    ----------
    parts : tuple of Section
    strained : tuple of MeanStrains
        Of the parts, which have all the same strains.
    """

    parts: tuple[Section, ...]
    strained: tuple[MeanStrains, ...]
    rows = None

    def strains(self, points: np.ndarray) -> np.ndarray:
        """See `MeanStrains`."""
        return self.strained[0].strains(points)

    def force(self, points: np.ndarray, inelastic: Inelastic, out: np.ndarray) -> float:
        """See `MeanStrains`."""
        out[:] = 0.0
        work, share = 0.0, np.empty_like(out)
        for part, strained in zip(self.parts, self.strained, strict=True):
            work += strained.force(points, Inelastic.of(part, inelastic.strains), share)
            out += share
        return work

    def tangent_blocks(self, points: np.ndarray, inelastic: Inelastic) -> np.ndarray:
        """See `MeanStrains`."""
        pairs = zip(self.parts, self.strained, strict=True)
        return sum(
            strained.tangent_blocks(points, Inelastic.of(part, inelastic.strains))
            for part, strained in pairs
        )


@dataclass(frozen=True, eq=False)
class ReliefTogether:
    """The sum of reliefs on one patch, itself a `Relief`.

    Attributes
    ----------
    reliefs : tuple of Relief
    """

    reliefs: tuple[Relief, ...]

    def update(self, elements: np.ndarray, strains: np.ndarray) -> None:
        """See `Relief`."""
        for relief in self.reliefs:
            relief.update(elements, strains)

    def force(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        """See `Relief`."""
        return Together(self.reliefs).force(points, out)

    def work(self, strains: np.ndarray) -> float:
        """See `Relief`."""
        return sum(relief.work(strains) for relief in self.reliefs)


def kernel_of(element: Element, section: Section) -> ElementKernel:
    """The element at work on a section that may vary."""
    kernels = tuple(element.kernel(part) for part in section.even_parts())
    return kernels[0] if len(kernels) == 1 else Together(kernels)


def mean_strains_of(element: Element, section: Section) -> MeanStrains:
    """What a law with a memory sees of it."""
    parts = section.even_parts()
    strained = tuple(element.mean_strains(part) for part in parts)
    return strained[0] if len(parts) == 1 else MeanStrainsTogether(parts, strained)


def relief_of(element: Element, section: Section) -> Relief | None:
    """The kernel of it some elements of which have inelastic strains, if the element has one."""
    reliefs = tuple(element.relief(part) for part in section.even_parts())
    if len(reliefs) == 1 or None in reliefs:
        return reliefs[0]
    return ReliefTogether(reliefs)
