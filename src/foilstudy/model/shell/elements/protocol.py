"""What a sheet asks of its element."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from foilstudy.model.shell.elements.mean_strains import Inelastic, Rows
from foilstudy.model.shell.section import Section


class ElementKernel(Protocol):
    """Energy, force and tangent of one section."""

    def force(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        """Write the derivative of the strain energy; return its three parts, J.

        Membrane, bending, and the part that only holds the in-plane checkerboard.
        """
        ...

    def tangent_blocks(self, points: np.ndarray | None) -> np.ndarray:
        """Blocks of the tangent, shape (rows, columns, 5, 5, 3, 3): control point, neighbour.

        Neighbours from two rows and columns before to two after. Without points, the stiffness
        of the stress-free shape.
        """
        ...


class MeanStrains(Protocol):
    """Six strains of every element of a section, for a law with a memory; see `mean_strains`.

    Attributes
    ----------
    rows : Rows or None
        Where they can be had row by row.
    """

    rows: Rows | None

    def strains(self, points: np.ndarray) -> np.ndarray:
        """Membrane and bending strains, shape (elements_along, 6, elements_around), 1 and 1/m."""
        ...

    def force(self, points: np.ndarray, inelastic: Inelastic, out: np.ndarray) -> float:
        """Write the force, N, and return the work, J, of the stresses that the elements lack."""
        ...

    def tangent_blocks(self, points: np.ndarray, inelastic: Inelastic) -> np.ndarray:
        """The derivative of that force, as in `ElementKernel`."""
        ...


class Relief(Protocol):
    """A kernel that follows the inelastic strains of elements; see `corner_relief`."""

    def update(self, elements: np.ndarray, strains: np.ndarray) -> None:
        """Take the inelastic strains, shape (number, 6), of some elements."""
        ...

    def force(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        """As in `ElementKernel`: the force of what is elastic, the energies of all strains."""
        ...

    def work(self, strains: np.ndarray) -> float:
        """Of the stresses taken off on the strains of the elements, J."""
        ...


class Element(Protocol):
    """Where an element samples its strains."""

    name: str

    def kernel(self, section: Section) -> ElementKernel:
        """The element at work on a section."""
        ...

    def mean_strains(self, section: Section) -> MeanStrains:
        """What a law with a memory sees of it."""
        ...

    def relief(self, section: Section) -> Relief | None:
        """The kernel of a section some elements of which have inelastic strains, if it has one."""
        ...
