"""Linear elastic isotropic foil in plane stress (St. Venant-Kirchhoff)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from foilstudy.model.materials import Material, material


@dataclass(frozen=True)
class Elastic:
    """n^ab = E t / (1 - nu^2) [nu A^ab A^cd + (1 - nu)/2 (A^ac A^bd + A^ad A^bc)] e_cd.

    Times the area element sqrt(det A), in curvilinear Voigt components.

    Attributes
    ----------
    material : Material
        Or the name of a known one.
    """

    material: Material

    def __post_init__(self):
        object.__setattr__(self, "material", material(self.material))

    def terms(self, shell: Any) -> tuple[Any, ...]:
        """See `Law`: none."""
        return ()

    def membrane_stiffness(self, forms: np.ndarray, thickness: float) -> np.ndarray:
        """See `Law`."""
        nu = self.material.poisson_ratio
        a11, a22, a12 = forms[:, 0], forms[:, 1], 0.5 * forms[:, 2]
        det = a11 * a22 - a12**2
        i11, i22, i12 = a22 / det, a11 / det, -a12 / det
        scale = self.material.youngs_modulus * thickness / (1 - nu**2) * np.sqrt(det)
        shear = 0.5 * (1 - nu)
        stiffness = np.empty((forms.shape[0], 6, forms.shape[2]))
        stiffness[:, 0] = scale * i11**2
        stiffness[:, 1] = scale * i22**2
        stiffness[:, 2] = scale * (nu * i11 * i22 + (1 - nu) * i12**2)
        stiffness[:, 3] = scale * i11 * i12
        stiffness[:, 4] = scale * i22 * i12
        stiffness[:, 5] = scale * (nu * i12**2 + shear * (i11 * i22 + i12**2))
        return stiffness
