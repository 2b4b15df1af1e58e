"""A model that is too little: a membrane that bears no compression and does not bend.

Where it would be compressed it wrinkles at no cost (tension field): the energy is relaxed over all
wrinkles [Pipkin, IMA J. Appl. Math. 36, 85, 1986]. By the mixed criterion a point is taut where
the lower principal stress pulls, slack where no principal strain is positive, and else wrinkled,
under uniaxial tension.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.patch import Patch
from foilstudy.model.shell.elements.assembly import Groups, no_blocks
from foilstudy.model.shell.elements.sampling import gauss
from foilstudy.model.shell.elements.sampling_tables import basis_weights
from foilstudy.model.shell.section import Section

_POINTS = 2
"""Gauss points of an element, in either direction."""


@dataclass(frozen=True)
class TensionField:
    """Relaxed membrane energy at 2 x 2 Gauss points."""

    name: str = "tension_field"

    def kernel(self, section: Section) -> TensionFieldKernel:
        return TensionFieldKernel(section)


class TensionFieldKernel:
    """Energy, force and tangent of one section; see `ElementKernel`."""

    def __init__(self, section: Section):
        self._section, self._elements = section, _elements(section.patch)
        h1, h2 = section.patch.size_around, section.patch.size_along
        places = gauss(_POINTS).bending
        self._slopes = basis_weights([place[:2] for place in places], h1, h2)[:, :, :2]
        bases = self._bases(section.reference)
        self._rest = _metric(bases)
        self._frames, areas = _frames(self._rest)
        self._areas = areas * h1 * h2 * np.array([place[2] for place in places])

    def force(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        bases = self._bases(points)
        density, stress = self._relaxed(bases)[:2]
        s11, s22, s12 = np.moveaxis(stress * self._areas[..., None], -1, 0)[..., None]
        a1, a2 = bases[:, :, 0], bases[:, :, 1]
        pulls = np.stack([s11 * a1 + s12 * a2, s12 * a1 + s22 * a2], axis=2)
        out[:] = 0.0
        self._elements.add_force(np.einsum("pna,epac->enc", self._slopes, pulls), out)
        return np.array([np.sum(density * self._areas), 0.0, 0.0])

    def tangent_blocks(self, points: np.ndarray | None) -> np.ndarray:
        bases = self._bases(self._section.reference if points is None else points)
        _, stress, modulus = self._relaxed(bases)
        w1, w2 = np.moveaxis(self._slopes, -1, 0)
        a1, a2 = bases[:, :, None, 0], bases[:, :, None, 1]
        w1, w2 = w1[None, :, :, None], w2[None, :, :, None]
        rows = np.stack([w1 * a1, w2 * a2, w1 * a2 + w2 * a1], axis=2)
        count = len(rows)
        rows = rows.reshape(count, -1, 3, 27)
        weighted = modulus * self._areas[..., None, None]
        material = np.einsum("epkx,epkl,eply->exy", rows, weighted, rows, optimize=True)
        tensor = stress[..., [[0, 2], [2, 1]]] * self._areas[..., None, None]
        slopes = self._slopes
        spread = np.einsum("pna,epab,pmb->enm", slopes, tensor, slopes, optimize=True)
        hessian = material.reshape(count, 9, 3, 9, 3)
        hessian += spread[:, :, None, :, None] * np.eye(3)[:, None]
        blocks = no_blocks(self._section.patch)
        self._elements.add_blocks(hessian, blocks)
        return blocks

    def _bases(self, points: np.ndarray) -> np.ndarray:
        """a_1 and a_2 at the Gauss points, shape (elements, points, 2, 3)."""
        return np.einsum("pna,enc->epac", self._slopes, self._elements.gathered(points))

    def _relaxed(self, bases: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Energy density, J/m2, its derivative by (e_11, e_22, 2 e_12), and the second one."""
        material, frames = self._section.law.material, self._frames
        strain = np.array([0.5, 0.5, 1.0]) * (_metric(bases) - self._rest)
        local = np.einsum("epkl,epl->epk", frames, strain)
        stretch = material.youngs_modulus * self._section.thickness
        density, stress, modulus = _relaxed(local, stretch, material.poisson_ratio)
        return (
            density,
            np.einsum("epkl,epk->epl", frames, stress),
            np.einsum("epki,epkl,eplj->epij", frames, modulus, frames, optimize=True),
        )


def _elements(patch: Patch) -> Groups:
    """The nine control points of every element."""
    row, column = np.indices((patch.elements_along, patch.elements_around)).reshape(2, -1, 1)
    node = np.arange(9)
    return Groups(patch, row + node // 3, column + node % 3)


def _metric(bases: np.ndarray) -> np.ndarray:
    """a_11, a_22 and a_12."""
    a1, a2 = bases[..., 0, :], bases[..., 1, :]
    return np.stack([np.sum(a * b, axis=-1) for a, b in ((a1, a1), (a2, a2), (a1, a2))], axis=-1)


def _frames(metric: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What turns (e_11, e_22, 2 e_12) into those of an orthonormal frame; square root of det."""
    a11, a22, a12 = np.moveaxis(metric, -1, 0)
    area = np.sqrt(a11 * a22 - a12**2)
    m11, m21, m22 = 1 / np.sqrt(a11), -a12 / np.sqrt(a11) / area, np.sqrt(a11) / area
    none = np.zeros_like(area)
    frames = [
        [m11**2, none, none],
        [m21**2, m22**2, m21 * m22],
        [2 * m11 * m21, none, m11 * m22],
    ]
    return np.moveaxis(np.array(frames), (0, 1), (-2, -1)), area


def _relaxed(
    strain: np.ndarray, stretch: float, poisson_ratio: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The relaxed energy in an orthonormal frame, with its derivatives.

    Parameters
    ----------
    strain : ndarray, shape (..., 3)
        11, 22 and twice 12.
    stretch, poisson_ratio : float
        E t, N/m, and nu.
    """
    nu = poisson_ratio
    mean, half = 0.5 * (strain[..., 0] + strain[..., 1]), 0.5 * (strain[..., 0] - strain[..., 1])
    spread = np.hypot(half, 0.5 * strain[..., 2])
    high, low = mean + spread, mean - spread
    plane = np.array([[1, nu, 0], [nu, 1, 0], [0, 0, 0.5 * (1 - nu)]]) * stretch / (1 - nu**2)
    stress = strain @ plane
    density = 0.5 * np.sum(stress * strain, axis=-1)
    modulus = np.broadcast_to(plane, (*strain.shape, 3)).copy()
    wrinkled, slack = (high > 0) & (low + nu * high < 0), high <= 0
    h, gap = high[wrinkled], 2 * spread[wrinkled]
    cosine, sine = 2 * half[wrinkled] / gap, strain[wrinkled, 2] / gap  # of twice the angle
    along = np.stack([0.5 * (1 + cosine), 0.5 * (1 - cosine), 0.5 * sine], axis=-1)
    turn = np.stack([-sine, sine, cosine], axis=-1)  # of the shear in the principal frame
    density[wrinkled], stress[wrinkled] = 0.5 * stretch * h**2, stretch * h[:, None] * along
    pair = along[:, :, None] * along[:, None]
    shear = (0.5 * h / gap)[:, None, None] * turn[:, :, None] * turn[:, None]
    modulus[wrinkled] = stretch * (pair + shear)
    density[slack], stress[slack], modulus[slack] = 0.0, 0.0, 0.0
    # a frame at rest is at the corner of all three: it is left taut
    rest = ~strain.any(axis=-1)
    modulus[rest] = plane
    return density, stress, modulus
