"""Where the linear elastic sheet would yield."""

from __future__ import annotations

import numpy as np

from foilstudy.model.patch import Patch
from foilstudy.model.shell.geometry import reference_geometry
from foilstudy.model.shell.shell import Shell


def von_mises_stress(sheet: Shell, points: np.ndarray) -> np.ndarray:
    """Larger von Mises stress of the two faces at the element middles.

    The strain at a face is e_ab +- (t/2) k_ab, with the membrane strain as the mean of the element
    corners: in the middle of an element a fold reads as stretching. Its principal values are the
    eigenvalues of the mixed tensor A^ac e_cb, from which plane stress gives the principal stresses.

    Returns
    -------
    ndarray, shape (elements_along, elements_around)
        Pa.
    """
    patch, material = sheet.patch, sheet.material
    now = reference_geometry(points, patch.elements_around, patch.size_around, patch.size_along)
    forms = sheet.section.forms
    bending = forms[:, 3:6] - now[:, 3:6]
    membrane = 0.5 * (
        _corner_mean_metric(points, patch) - _corner_mean_metric(sheet.reference, patch)
    )
    a11, a22, a12 = forms[:, 0], forms[:, 1], 0.5 * forms[:, 2]
    det = a11 * a22 - a12**2
    modulus = material.youngs_modulus / (1 - material.poisson_ratio**2)
    if sheet.section.variation is not None:
        modulus = modulus * sheet.section.variation.modulus
    # beside the strains (along, 3, around)
    thickness = np.broadcast_to(sheet.section.local_thickness, det.shape)[:, None]
    stress = np.zeros(det.shape)
    for face in (-0.5, 0.5):
        strain = membrane + face * thickness * bending
        e11, e22, e12 = strain[:, 0], strain[:, 1], 0.5 * strain[:, 2]
        half_trace = 0.5 * (a22 * e11 + a11 * e22 - 2 * a12 * e12) / det
        determinant = (e11 * e22 - e12**2) / det
        spread = np.sqrt(np.maximum(half_trace**2 - determinant, 0.0))
        first, second = half_trace + spread, half_trace - spread
        s1 = modulus * (first + material.poisson_ratio * second)
        s2 = modulus * (second + material.poisson_ratio * first)
        stress = np.maximum(stress, np.sqrt(s1**2 - s1 * s2 + s2**2))
    return stress


def _corner_mean_metric(points: np.ndarray, patch: Patch) -> np.ndarray:
    """a_11, a_22, 2 a_12 averaged over the corners of each element, shape (along, 3, around)."""
    right = np.roll(points, -1, axis=2) if patch.periodic else points[:, :, 1:]
    left = points if patch.periodic else points[:, :, :-1]
    around = (right - left) / patch.size_around
    across = 0.5 * (right + left)
    a1 = 0.5 * (around[:, :-1] + around[:, 1:])
    a2 = (across[:, 1:] - across[:, :-1]) / patch.size_along
    metric = np.stack([(a1 * a1).sum(0), (a2 * a2).sum(0), 2 * (a1 * a2).sum(0)], axis=1)
    along = 0.5 * (metric[:-1] + metric[1:])
    if patch.periodic:
        return 0.5 * (along + np.roll(along, -1, axis=2))
    return 0.5 * (along[:, :, :-1] + along[:, :, 1:])


def beyond_yield_share(sheet: Shell, points: np.ndarray) -> float:
    """Share of the stress-free area where a face exceeds the yield stress."""
    areas, limit = sheet.section.areas, sheet.material.yield_stress
    if sheet.section.variation is not None:
        limit = limit * sheet.section.variation.modulus
    beyond = von_mises_stress(sheet, points) > limit
    return float(areas[beyond].sum() / areas.sum())
