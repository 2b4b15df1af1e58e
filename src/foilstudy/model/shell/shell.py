"""The shell: a section at work in elements, a term of the energy of a sheet."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sparse

from foilstudy.model.materials import Material
from foilstudy.model.patch import Patch
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.model.shell.elements.protocol import Element, ElementKernel
from foilstudy.model.shell.elements.together import kernel_of
from foilstudy.model.shell.material.elastic import Elastic
from foilstudy.model.shell.section import Section
from foilstudy.model.shell.tangent import block_matrix


@dataclass(frozen=True)
class Energies:
    """Strain energy of the shell, J."""

    membrane: float
    bending: float
    stabilisation: float

    def __repr__(self) -> str:
        parts = f"{self.membrane:.4g}, {self.bending:.4g}, {self.stabilisation:.4g}"
        return f"<Energies: membrane, bending, stabilisation {parts} J>"

    @property
    def total(self) -> float:
        return self.membrane + self.bending + self.stabilisation


class Shell:
    """Strain energy of a section, and its derivatives.

    A term of a `solve.problem.Problem`. An elastic shell has no memory: its state is None.

    Parameters
    ----------
    section : Section
    element : Element
        Where the elements sample their strains; the default one if left out.
    """

    energy_names = ("membrane", "bending", "stabilisation")

    def __init__(self, section: Section, element: Element | None = None):
        self.section = section
        self.element = Corner() if element is None else element

    @cached_property
    def _kernel(self) -> ElementKernel:
        """Made when it is needed: what a shell is relieved from is often not asked anything."""
        return kernel_of(self.element, self.section)

    def __repr__(self) -> str:
        return f"<Shell: {self.section}, {self.element.name}>"

    @classmethod
    def elastic(
        cls,
        patch: Patch,
        reference: np.ndarray,
        material: Material | str,
        thickness: float,
        element: Element | None = None,
    ) -> Shell:
        """A linear elastic shell that is stress-free in the shape `reference`."""
        return cls(Section(patch, reference, thickness, Elastic(material)), element)

    @property
    def patch(self) -> Patch:
        """That of the section."""
        return self.section.patch

    @property
    def reference(self) -> np.ndarray:
        """Control points of the stress-free shape, shape (3, rows, columns), m."""
        return self.section.reference

    @property
    def thickness(self) -> float:
        """m."""
        return self.section.thickness

    @property
    def material(self) -> Material:
        """That of the law."""
        return self.section.law.material

    def start(self) -> None:
        """State of the untouched shell: an elastic one has none."""

    def evolved(self, points: np.ndarray, state: None) -> None:
        """State after a shape has been reached: an elastic shell has none."""

    def force(self, points: np.ndarray, out: np.ndarray, state: None = None) -> np.ndarray:
        """Internal force (derivative of the strain energy) at the given shape.

        Parameters
        ----------
        points : ndarray, shape (3, rows, columns)
            Control points, m.
        out : ndarray, same shape
            Receives the force on every control point, N.

        Returns
        -------
        ndarray, shape (3,)
            Membrane, bending and stabilisation energy, J.
        """
        return self._kernel.force(points, out)

    def tangent(self, points: np.ndarray | None = None, state: None = None) -> sparse.csr_matrix:
        """Derivative of the force on all control points, ordered row, column, component.

        Parameters
        ----------
        points : ndarray, shape (3, rows, columns), optional
            Deformed control points. Without them the shell is in its stress-free shape.

        Returns
        -------
        csr_matrix
            Symmetric, N/m.

        Raises
        ------
        ValueError
            If there are fewer than five control points around.
        """
        return block_matrix(self.patch, self.tangent_blocks(points))

    def tangent_blocks(self, points: np.ndarray | None = None) -> np.ndarray:
        """The same by control point and neighbour, shape (rows, columns, 5, 5, 3, 3)."""
        return self._kernel.tangent_blocks(points)

    def energies(self, points: np.ndarray) -> Energies:
        """Strain energies at the given shape."""
        return Energies(*self.force(points, np.empty_like(points)))
