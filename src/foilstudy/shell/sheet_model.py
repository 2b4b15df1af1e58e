"""The elastic sheet on a patch: packed element data and calls into the kernels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.patch import Patch
from foilstudy.sheet import Material
from foilstudy.shell import kernels


@dataclass(frozen=True)
class Energies:
    """Strain energy of the sheet, J."""

    membrane: float
    bending: float
    stabilisation: float

    @property
    def total(self) -> float:
        return self.membrane + self.bending + self.stabilisation


def plane_stress_law(geometry: np.ndarray, material: Material, thickness: float) -> np.ndarray:
    """Membrane stiffness per unit of parameter area, in curvilinear Voigt components.

    n^ab = E t / (1 - nu^2) [nu A^ab A^cd + (1 - nu)/2 (A^ac A^bd + A^ad A^bc)] e_cd, times the
    area element sqrt(det A) (St. Venant-Kirchhoff, plane stress). The bending law is the same
    times t^2/12.

    Parameters
    ----------
    geometry : ndarray, shape (elements_along, 12, elements_around)
        As returned by `kernels.reference_geometry`.

    Returns
    -------
    ndarray, shape (elements_along, 6, elements_around)
        Coefficients 11-11, 22-22, 11-22, 11-12, 22-12, 12-12 against (e_11, e_22, 2 e_12), N/m.
    """
    nu = material.poisson_ratio
    a11, a22, a12 = geometry[:, 0], geometry[:, 1], 0.5 * geometry[:, 2]
    det = a11 * a22 - a12**2
    i11, i22, i12 = a22 / det, a11 / det, -a12 / det
    scale = material.youngs_modulus * thickness / (1 - nu**2) * np.sqrt(det)
    shear = 0.5 * (1 - nu)
    law = np.empty((geometry.shape[0], 6, geometry.shape[2]))
    law[:, 0] = scale * i11**2
    law[:, 1] = scale * i22**2
    law[:, 2] = scale * (nu * i11 * i22 + (1 - nu) * i12**2)
    law[:, 3] = scale * i11 * i12
    law[:, 4] = scale * i22 * i12
    law[:, 5] = scale * (nu * i12**2 + shear * (i11 * i22 + i12**2))
    return law


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
    stabilisation : float
        Factor chi on the first-order variation of the membrane strain within an element; 1 is the
        full integral (which locks), 0 leaves the in-plane checkerboard free.
    """

    def __init__(
        self,
        patch: Patch,
        reference: np.ndarray,
        material: Material,
        thickness: float,
        stabilisation: float,
    ):
        if reference.shape != patch.shape:
            raise ValueError(
                f"control points have shape {reference.shape}, the patch needs {patch.shape}"
            )
        self.patch = patch
        self.reference = np.ascontiguousarray(reference)
        self.material = material
        self.thickness = thickness
        self.stabilisation = stabilisation
        self.geometry = kernels.reference_geometry(
            self.reference, patch.elements_around, patch.size_around, patch.size_along
        )
        area = patch.size_around * patch.size_along
        self.law = area * plane_stress_law(self.geometry, material, thickness)
        self._elements = kernels.pack(self.geometry, self.law)
        self._scales = kernels.scales(patch, thickness, stabilisation)

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
        return kernels.internal_force(
            points, self.patch.elements_around, self._elements, *self._scales, out
        )

    def energies(self, points: np.ndarray) -> Energies:
        """Strain energies at the given shape."""
        return Energies(*self.force(points, np.empty_like(points)))
