"""Where the linear elastic sheet would yield."""

from __future__ import annotations

import numpy as np

from foilstudy.shell import kernels
from foilstudy.shell.sheet_model import SheetModel


def von_mises_stress(sheet: SheetModel, points: np.ndarray) -> np.ndarray:
    """Larger von Mises stress of the two faces at the element middles.

    The strain at a face is e_ab +- (t/2) k_ab; its principal values are the eigenvalues of the
    mixed tensor A^ac e_cb, from which plane stress gives the principal stresses.

    Returns
    -------
    ndarray, shape (elements_along, elements_around)
        Pa.
    """
    patch, material = sheet.patch, sheet.material
    now = kernels.reference_geometry(
        points, patch.elements_around, patch.size_around, patch.size_along
    )
    change = now - sheet.geometry
    membrane = 0.5 * change[:, :3]
    bending = -change[:, 3:6]
    a11, a22, a12 = sheet.geometry[:, 0], sheet.geometry[:, 1], 0.5 * sheet.geometry[:, 2]
    det = a11 * a22 - a12**2
    modulus = material.youngs_modulus / (1 - material.poisson_ratio**2)
    stress = np.zeros(det.shape)
    for face in (-0.5, 0.5):
        strain = membrane + face * sheet.thickness * bending
        e11, e22, e12 = strain[:, 0], strain[:, 1], 0.5 * strain[:, 2]
        half_trace = 0.5 * (a22 * e11 + a11 * e22 - 2 * a12 * e12) / det
        determinant = (e11 * e22 - e12**2) / det
        spread = np.sqrt(np.maximum(half_trace**2 - determinant, 0.0))
        first, second = half_trace + spread, half_trace - spread
        s1 = modulus * (first + material.poisson_ratio * second)
        s2 = modulus * (second + material.poisson_ratio * first)
        stress = np.maximum(stress, np.sqrt(s1**2 - s1 * s2 + s2**2))
    return stress


def beyond_yield_share(sheet: SheetModel, points: np.ndarray) -> float:
    """Share of the stress-free area where a face exceeds the yield stress."""
    areas = sheet.element_areas()
    beyond = von_mises_stress(sheet, points) > sheet.material.yield_stress
    return float(areas[beyond].sum() / areas.sum())
