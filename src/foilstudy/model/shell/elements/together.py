"""Sections that share their strains: a sheet whose thickness varies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.shell.elements.protocol import ElementKernel


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
