"""Strain energy and strains element by element, with the sampling of the element itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.patch import Patch
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.model.shell.elements.full import Full
from foilstudy.model.shell.elements.one_point import OnePoint
from foilstudy.model.shell.elements.sampling import LAW_PAIRS, StrainSampling, corner
from foilstudy.model.shell.elements.sampling_tables import basis_weights
from foilstudy.model.shell.geometry import reference_geometry
from foilstudy.model.shell.shell import Shell


def element_energies(sheet: Shell, points: np.ndarray) -> np.ndarray:
    """Membrane, bending and stabilisation energy of every element.

    Parameters
    ----------
    sheet : Shell
    points : ndarray, shape (3, rows, columns)
        Control points, m.

    Returns
    -------
    ndarray, shape (3, elements_along, elements_around)
        J; their sums are `Shell.energies`.

    Raises
    ------
    ValueError
        If the element is not one of those that a study uses.
    """
    parts = (Shell(part, sheet.element) for part in sheet.section.even_parts())
    return np.sum([_even_energies(part, points) for part in parts], axis=0)


def _even_energies(sheet: Shell, points: np.ndarray) -> np.ndarray:
    """Of a sheet of one thickness."""
    element = sheet.element
    if isinstance(element, Corner):
        sampling = corner(element.share(sheet.section))
        return _sampled(sheet, points, sampling, _folded_bending(sheet, points))
    if isinstance(element, OnePoint):
        return _one_point(sheet, points, element.stabilisation)
    if isinstance(element, Full):
        return _sampled(sheet, points, element.sampling, _bending(sheet, points, element.sampling))
    raise ValueError(
        f"energies per element are known for the elements of a configuration, not for "
        f"{element.name}; add its formula here."
    )


def _quadratic(law: np.ndarray, strain: np.ndarray) -> np.ndarray:
    """1/2 e.C.e; law of shape (along, 6, around), strain (3, along, around)."""
    total = np.zeros(strain.shape[1:])
    for k, (a, b) in enumerate(LAW_PAIRS):
        total += (0.5 if a == b else 1.0) * law[:, k] * strain[a] * strain[b]
    return total


def _one_point(sheet: Shell, points: np.ndarray, stabilisation: float) -> np.ndarray:
    patch = sheet.patch
    now = _geometry(points, patch)
    change = now - _geometry(sheet.reference, patch)
    membrane = np.stack([0.5 * change[:, 0], 0.5 * change[:, 1], 0.5 * change[:, 2]])
    bending = -np.moveaxis(change[:, 3:6], 1, 0)
    first, second = np.moveaxis(change[:, 6:9], 1, 0), np.moveaxis(change[:, 9:12], 1, 0)
    control = patch.size_around**2 * _quadratic(sheet.section.stiffness, first)
    control += patch.size_along**2 * _quadratic(sheet.section.stiffness, second)
    return np.stack(
        [
            _quadratic(sheet.section.stiffness, membrane),
            sheet.thickness**2 / 12 * _quadratic(sheet.section.stiffness, bending),
            stabilisation / 12 * control,
        ]
    )


def _sampled(
    sheet: Shell, points: np.ndarray, sampling: StrainSampling, bending: np.ndarray
) -> np.ndarray:
    strain = _membrane_samples(points, sheet.patch, sampling)
    strain -= _membrane_samples(sheet.reference, sheet.patch, sampling)
    energies = np.empty((3, *strain.shape[1:]))
    for part, forms in ((0, sampling.forms), (2, sampling.control)):
        quadratic = np.einsum("kab,aji,bji->jki", forms, strain, strain, optimize=True)
        energies[part] = 0.5 * (sheet.section.stiffness * quadratic).sum(axis=1)
    energies[1] = bending
    return energies


def _folded_bending(sheet: Shell, points: np.ndarray) -> np.ndarray:
    change = _folded_curvature_change(sheet, points)
    return sheet.thickness**2 / 12 * _quadratic(sheet.section.stiffness, change)


def _bending(sheet: Shell, points: np.ndarray, sampling: StrainSampling) -> np.ndarray:
    """By the curvatures b_ab at the bending points of a sampling without a fold."""
    at, weights = [place[:2] for place in sampling.bending], [b[2] for b in sampling.bending]
    change = _curvatures(sheet.reference, sheet.patch, at) - _curvatures(points, sheet.patch, at)
    parts = [
        w * _quadratic(sheet.section.stiffness, each)
        for w, each in zip(weights, change, strict=True)
    ]
    return sheet.thickness**2 / 12 * np.sum(parts, axis=0)


def _curvatures(points: np.ndarray, patch: Patch, at: list[tuple[float, float]]) -> np.ndarray:
    """b_11, b_22 and twice b_12 at places of every element, shape (places, 3, along, around)."""
    weights = basis_weights(at, patch.size_around, patch.size_along)
    vectors = np.einsum("pnq,ncji->pqcji", weights, _stencils(points), optimize=True)
    normal = np.cross(vectors[:, 0], vectors[:, 1], axis=1)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    curvatures = np.einsum("pqcji,pcji->pqji", vectors[:, 2:], normal)
    return curvatures * np.array([1.0, 1.0, 2.0])[:, None, None]


def _membrane_samples(points: np.ndarray, patch: Patch, sampling: StrainSampling) -> np.ndarray:
    """a_11/2, a_22/2 and a_12 at the samples, shape (samples, along, around)."""
    at = [sample[1:] for sample in sampling.membrane]
    weights = basis_weights(at, patch.size_around, patch.size_along)[:, :, :2]
    vectors = np.einsum("pnq,ncji->pqcji", weights, _stencils(points), optimize=True)
    samples = np.empty((len(at), *vectors.shape[3:]))
    for s, (component, *_) in enumerate(sampling.membrane):
        first, second = vectors[s, 0], vectors[s, 1]
        pair = {0: (first, first), 1: (second, second), 2: (first, second)}[component]
        samples[s] = (1.0 if component == 2 else 0.5) * (pair[0] * pair[1]).sum(axis=0)
    return samples


def _stencils(points: np.ndarray) -> np.ndarray:
    """The nine control points of every element, shape (9, 3, along, around)."""
    along = points.shape[1] - 2
    return np.stack(
        [np.roll(points, -i, axis=2)[:, j : j + along] for j in range(3) for i in range(3)]
    )


def _geometry(points: np.ndarray, patch: Patch) -> np.ndarray:
    points = np.ascontiguousarray(points)
    return reference_geometry(points, patch.elements_around, patch.size_around, patch.size_along)


def _folded_curvature_change(sheet: Shell, points: np.ndarray) -> np.ndarray:
    """B_ab - b_ab J_0/J in the middle: what the corner element bends by; 11, 22, twice 12."""
    now = _geometry(points, sheet.patch)
    forms = sheet.section.forms
    jacobian = [np.sqrt(g[:, 0] * g[:, 1] - 0.25 * g[:, 2] ** 2) for g in (forms, now)]
    return np.moveaxis(forms[:, 3:6], 1, 0) - (jacobian[0] / jacobian[1]) * np.moveaxis(
        now[:, 3:6], 1, 0
    )


@dataclass(frozen=True)
class Strains:
    """Principal strains of every element, shape (elements_along, elements_around).

    Attributes
    ----------
    membrane_max, membrane_min : ndarray
        Principal membrane strains (Green), mean of the corners, 1.
    curvature : ndarray
        Principal change of curvature of the larger magnitude, 1/m.
    """

    membrane_max: np.ndarray
    membrane_min: np.ndarray
    curvature: np.ndarray


def principal_strains(sheet: Shell, points: np.ndarray) -> Strains:
    """Strains of a shape against the reference of the sheet."""
    samples = corner(0.0)
    corners = [_membrane_samples(p, sheet.patch, samples) for p in (points, sheet.reference)]
    difference = corners[0] - corners[1]
    membrane = difference[:12].reshape(4, 3, *difference.shape[1:]).mean(axis=0)
    high, low = _principal(sheet.section.forms, membrane)
    bent = np.moveaxis(sheet.section.forms[:, 3:6] - _geometry(points, sheet.patch)[:, 3:6], 1, 0)
    first, second = _principal(sheet.section.forms, bent)
    return Strains(high, low, np.where(np.abs(first) > np.abs(second), first, second))


def _principal(geometry: np.ndarray, strain: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues of the mixed tensor A^ac e_cb; strain 11, 22, twice 12."""
    a11, a22, a12 = geometry[:, 0], geometry[:, 1], 0.5 * geometry[:, 2]
    e11, e22, e12 = strain[0], strain[1], 0.5 * strain[2]
    determinant = a11 * a22 - a12**2
    mean = 0.5 * (a22 * e11 + a11 * e22 - 2 * a12 * e12) / determinant
    spread = np.sqrt(np.maximum(mean**2 - (e11 * e22 - e12**2) / determinant, 0.0))
    return mean + spread, mean - spread
