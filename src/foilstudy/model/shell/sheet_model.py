"""The elastic sheet on a patch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.foil import Material
from foilstudy.model.patch import Patch
from foilstudy.model.shell.elements import DEFAULT_ELEMENT, Element
from foilstudy.model.shell.geometry import plane_stress_law, reference_geometry


@dataclass(frozen=True)
class Energies:
    """Strain energy of the sheet, J."""

    membrane: float
    bending: float
    stabilisation: float

    @property
    def total(self) -> float:
        return self.membrane + self.bending + self.stabilisation


class SheetModel:
    """A sheet whose stress-free shape is given by control points.

    Parameters
    ----------
    patch : Patch
    reference : ndarray, shape (3, rows, columns)
        Control points of the stress-free shape, m.
    material : Material
    thickness : float
        m.
    element : Element
        Where the elements sample their strains.

    Attributes
    ----------
    geometry : ndarray, shape (elements_along, 12, elements_around)
        Of the stress-free shape, see `reference_geometry`.
    law : ndarray, shape (elements_along, 6, elements_around)
        Membrane stiffness times the area of the element, see `plane_stress_law`.
    """

    def __init__(
        self,
        patch: Patch,
        reference: np.ndarray,
        material: Material,
        thickness: float,
        element: Element = DEFAULT_ELEMENT,
    ):
        if reference.shape != patch.shape:
            raise ValueError(
                f"control points have shape {reference.shape}, the patch needs {patch.shape}"
            )
        self.patch = patch
        self.reference = np.ascontiguousarray(reference)
        self.material = material
        self.thickness = thickness
        self.element = element
        self.geometry = reference_geometry(
            self.reference, patch.elements_around, patch.size_around, patch.size_along
        )
        area = patch.size_around * patch.size_along
        self.law = area * plane_stress_law(self.geometry, material, thickness)
        self._kernel = element.kernel(self)

    def element_areas(self) -> np.ndarray:
        """Stress-free area of each element, shape (elements_along, elements_around), m2."""
        g = self.geometry
        det = g[:, 0] * g[:, 1] - 0.25 * g[:, 2] ** 2
        return np.sqrt(det) * self.patch.size_around * self.patch.size_along

    def force(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
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

    def tangent_blocks(self, points: np.ndarray | None) -> np.ndarray:
        """Derivative of the force, see `ElementKernel.tangent_blocks`."""
        return self._kernel.tangent_blocks(points)

    def energies(self, points: np.ndarray) -> Energies:
        """Strain energies at the given shape."""
        return Energies(*self.force(points, np.empty_like(points)))
