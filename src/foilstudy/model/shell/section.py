"""What an element is given of a sheet: patch, stress-free shape, thickness and material law."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from foilstudy.base.ranges import require_number
from foilstudy.model.patch import Patch
from foilstudy.model.shell.geometry import reference_geometry
from foilstudy.model.shell.material import Law
from foilstudy.model.shell.variation import Variation


@dataclass(frozen=True, eq=False)
class Section:
    """A patch with a stress-free shape and a law; it knows nothing of any element.

    Attributes
    ----------
    patch : Patch
    reference : ndarray, shape (3, rows, columns)
        Control points of the stress-free shape, m.
    thickness : float
        m; of a section that varies, what its factors count from.
    law : Law
    variation : Variation or None
        None where thickness and modulus are the same everywhere.

    Raises
    ------
    ValueError
        If the control points do not fit the patch, or the thickness is not positive.
    """

    patch: Patch
    reference: np.ndarray
    thickness: float
    law: Law
    variation: Variation | None = None

    def __post_init__(self) -> None:
        require_number("thickness of a shell", self.thickness, "m", above=0)
        if self.reference.shape != self.patch.shape:
            raise ValueError(
                f"control points have shape {self.reference.shape}, the patch needs "
                f"{self.patch.shape}"
            )
        object.__setattr__(self, "reference", np.ascontiguousarray(self.reference))

    def __repr__(self) -> str:
        around, along = self.patch.elements_around, self.patch.elements_along
        return (
            f"<Section: {1e6 * self.thickness:g} µm, {around} x {along} elements, "
            f"{type(self.law).__name__}>"
        )

    @cached_property
    def forms(self) -> np.ndarray:
        """Fundamental forms at the element middles, shape (elements_along, 6, elements_around).

        a_11, a_22, 2 a_12 (m2 per unit of parameter), b_11, b_22, 2 b_12.
        """
        patch = self.patch
        return reference_geometry(
            self.reference, patch.elements_around, patch.size_around, patch.size_along
        )[:, :6]

    @cached_property
    def stiffness(self) -> np.ndarray:
        """Membrane stiffness times the parameter area of an element, see `Law`, N m.

        Shape (elements_along, 6, elements_around).
        """
        area = self.patch.size_around * self.patch.size_along
        stiffness = area * self.law.membrane_stiffness(self.forms, self.thickness)
        if self.variation is not None:
            stiffness *= self.variation.membrane[:, None]
        return stiffness

    @property
    def local_thickness(self) -> float | np.ndarray:
        """Thickness, m; of shape (elements_along, elements_around) where it varies."""
        if self.variation is None:
            return self.thickness
        return self.thickness * self.variation.thickness

    @property
    def volumes(self) -> np.ndarray:
        """Of the elements, shape (elements_along, elements_around), m3."""
        return self.areas * self.local_thickness

    @property
    def thickest(self) -> float:
        """Largest thickness, m."""
        return float(np.max(self.local_thickness))

    @property
    def stiffest(self) -> float:
        """Largest membrane stiffness over that of the thickness and the modulus of the foil."""
        return 1.0 if self.variation is None else float(self.variation.membrane.max())

    @property
    def masses(self) -> np.ndarray:
        """Of the elements, shape (elements_along, elements_around), kg."""
        return self.law.material.density * self.local_thickness * self.areas

    def even_parts(self) -> tuple[Section, ...]:
        """Sections of one thickness each, whose energies add up to that of this one."""
        if self.variation is None:
            return (self,)
        ones = np.ones_like(self.variation.thickness)
        return tuple(
            replace(self, thickness=factor * self.thickness, variation=Variation(ones, modulus))
            for factor, modulus in self.variation.even_parts()
        )

    @property
    def areas(self) -> np.ndarray:
        """Stress-free area of each element, shape (elements_along, elements_around), m2."""
        g = self.forms
        det = g[:, 0] * g[:, 1] - 0.25 * g[:, 2] ** 2
        return np.sqrt(det) * self.patch.size_around * self.patch.size_along
