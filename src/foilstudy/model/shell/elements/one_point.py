"""The element with one strain point, held by the strain gradient times a factor chi."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from foilstudy.model.patch import Patch
from foilstudy.model.shell.elements import one_point_kernel
from foilstudy.model.shell.elements.mean_strains import SampledMeanStrains
from foilstudy.model.shell.elements.sampling import one_point
from foilstudy.model.shell.geometry import reference_geometry
from foilstudy.model.shell.section import Section

_VALUE = np.array([0.125, 0.75, 0.125])
_SLOPE = np.array([-0.5, 0.0, 0.5])
_CURVE = np.array([1.0, -2.0, 1.0])
_REACH = 5


@dataclass(frozen=True)
class OnePoint:
    """Strains at the element middle only; folds within an element read as stretching.

    Attributes
    ----------
    stabilisation : float
        Factor chi on the first-order variation of the membrane strain within an element; 1 is the
        full integral (which locks), 0 leaves the in-plane checkerboard free.
    """

    stabilisation: float = 0.05
    name: str = "one_point"

    def kernel(self, section: Section) -> _Kernel:
        return _Kernel(section, self.stabilisation)

    def mean_strains(self, section: Section) -> SampledMeanStrains:
        return SampledMeanStrains(section, one_point(self.stabilisation))

    def relief(self, section: Section) -> None:
        """Its force knows none; the stresses taken off are a force of their own."""


class _Kernel:
    def __init__(self, section: Section, stabilisation: float):
        self._section = section
        patch = section.patch
        # with the first derivatives of the membrane strain, which the stabilisation needs
        self._geometry = reference_geometry(
            section.reference, patch.elements_around, patch.size_around, patch.size_along
        )
        self._elements = one_point_kernel.pack(self._geometry, section.stiffness)
        self._scales = one_point_kernel.scales(section.patch, section.thickness, stabilisation)

    def force(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        return one_point_kernel.internal_force(
            points, self._section.patch.elements_around, self._elements, *self._scales, out
        )

    def tangent_blocks(self, points: np.ndarray | None) -> np.ndarray:
        section = self._section
        around, _ = self._scales
        shape = section.reference if points is None else points
        return _assemble(
            np.ascontiguousarray(shape), section.patch.elements_around, self._geometry,
            section.stiffness, _stencil(section.patch), around[2:], points is not None,
        )  # fmt: skip


def _stencil(patch: Patch) -> np.ndarray:
    """Weights of the nine control points in a_1, a_2, a_11, a_22, a_12, shape (9, 5)."""
    h1, h2 = patch.size_around, patch.size_along
    pairs = (
        (_VALUE, _SLOPE / h1),
        (_SLOPE / h2, _VALUE),
        (_VALUE, _CURVE / h1**2),
        (_CURVE / h2**2, _VALUE),
        (_SLOPE / h2, _SLOPE / h1),
    )
    return np.stack([np.outer(along, around).ravel() for along, around in pairs], axis=1)


@njit(cache=True, error_model="numpy", forceinline=True)
def _hessian(a, law, reference, factors, stressed, hessian, strain_rows):
    """Hessian of the energy of one element with respect to (a_1, a_2, a_11, a_22, a_12).

    `a` has shape (5, 3); `hessian` (15, 15) is overwritten. With `stressed` false only the
    material part at zero strain is formed (the stiffness of the shape taken as stress-free).
    """
    bend, grad1, grad2 = factors
    a1, a2, a11, a22, a12 = a[0], a[1], a[2], a[3], a[4]
    normal = np.cross(a1, a2)
    det = np.sum(normal * normal)
    normal = normal / np.sqrt(det)
    m11, m22, m12 = np.sum(a1 * a1), np.sum(a2 * a2), np.sum(a1 * a2)
    c1 = (m22 * a1 - m12 * a2) / det  # contravariant base
    c2 = (m11 * a2 - m12 * a1) / det
    b = strain_rows
    b[:] = 0.0
    for c in range(3):
        # membrane strains e_11, e_22, 2 e_12
        b[0, c] = a1[c]
        b[1, 3 + c] = a2[c]
        b[2, c] = a2[c]
        b[2, 3 + c] = a1[c]
        # first-order variation in direction 1, then 2
        b[6, c] = a11[c]
        b[6, 6 + c] = a1[c]
        b[7, 3 + c] = a12[c]
        b[7, 12 + c] = a2[c]
        b[8, c] = a12[c]
        b[8, 3 + c] = a11[c]
        b[8, 6 + c] = a2[c]
        b[8, 12 + c] = a1[c]
        b[9, c] = a12[c]
        b[9, 12 + c] = a1[c]
        b[10, 3 + c] = a22[c]
        b[10, 9 + c] = a2[c]
        b[11, c] = a22[c]
        b[11, 3 + c] = a12[c]
        b[11, 9 + c] = a1[c]
        b[11, 12 + c] = a2[c]
    for k in range(3):
        second, factor = a[2 + k], 1.0 if k < 2 else 2.0
        g1, g2 = np.sum(second * c1), np.sum(second * c2)
        for c in range(3):
            b[3 + k, 6 + 3 * k + c] = -factor * normal[c]
            b[3 + k, c] = factor * g1 * normal[c]
            b[3 + k, 3 + c] = factor * g2 * normal[c]
    elastic = np.empty((3, 3))
    elastic[0, 0], elastic[1, 1], elastic[2, 2] = law[0], law[1], law[5]
    elastic[0, 1] = elastic[1, 0] = law[2]
    elastic[0, 2] = elastic[2, 0] = law[3]
    elastic[1, 2] = elastic[2, 1] = law[4]
    hessian[:] = 0.0
    for block in range(4):
        scale = (1.0, bend, grad1, grad2)[block]
        rows = b[3 * block : 3 * block + 3]
        hessian += rows.T @ (scale * elastic @ rows)
    if not stressed:
        return
    strain = np.empty(12)
    strain[0] = 0.5 * (m11 - reference[0])
    strain[1] = 0.5 * (m22 - reference[1])
    strain[2] = m12 - 0.5 * reference[2]
    strain[3] = reference[3] - np.sum(a11 * normal)
    strain[4] = reference[4] - np.sum(a22 * normal)
    strain[5] = reference[5] - 2.0 * np.sum(a12 * normal)
    strain[6] = np.sum(a11 * a1) - reference[6]
    strain[7] = np.sum(a12 * a2) - reference[7]
    strain[8] = np.sum(a11 * a2) + np.sum(a12 * a1) - reference[8]
    strain[9] = np.sum(a12 * a1) - reference[9]
    strain[10] = np.sum(a22 * a2) - reference[10]
    strain[11] = np.sum(a12 * a2) + np.sum(a22 * a1) - reference[11]
    n = elastic @ strain[0:3]
    m = bend * (elastic @ strain[3:6])
    s = grad1 * (elastic @ strain[6:9])
    r = grad2 * (elastic @ strain[9:12])
    for k in range(3):
        hessian[k, k] += n[0]
        hessian[3 + k, 3 + k] += n[1]
        _couple(hessian, k, 3 + k, n[2])
        _couple(hessian, 6 + k, k, s[0])
        _couple(hessian, 12 + k, 3 + k, s[1] + r[2])
        _couple(hessian, 6 + k, 3 + k, s[2])
        _couple(hessian, 12 + k, k, s[2] + r[0])
        _couple(hessian, 9 + k, 3 + k, r[1])
        _couple(hessian, 9 + k, k, r[2])
    # second variation of the normal: d2n = 2 (a^c.d_d)(n.d_c) a^d - a^cd (n.d_c)(n.d_d) n
    p = m[0] * a11 + m[1] * a22 + 2.0 * m[2] * a12
    pn = np.sum(p * normal)
    contra = np.empty((2, 3))
    contra[0], contra[1] = c1, c2
    for c_ in range(2):
        for k in range(3):
            weight = m[k] if k < 2 else 2.0 * m[2]
            for i in range(3):
                for j in range(3):
                    value = weight * contra[c_, i] * normal[j]
                    hessian[6 + 3 * k + i, 3 * c_ + j] += value
                    hessian[3 * c_ + j, 6 + 3 * k + i] += value
        for d in range(2):
            pd = np.sum(p * contra[d])
            metric = np.sum(contra[c_] * contra[d]) * pn
            for i in range(3):
                for j in range(3):
                    value = pd * contra[c_, i] * normal[j]
                    hessian[3 * d + i, 3 * c_ + j] -= value
                    hessian[3 * c_ + j, 3 * d + i] -= value
                    hessian[3 * c_ + i, 3 * d + j] += metric * normal[i] * normal[j]


@njit(cache=True, forceinline=True)
def _couple(hessian, i, j, value):
    hessian[i, j] += value
    hessian[j, i] += value


@njit(cache=True, error_model="numpy")
def _assemble(x, n_around, geometry, law, weights, factors, stressed):
    """Blocks of the tangent, shape (rows, columns, 5, 5, 3, 3): control point, neighbour."""
    rows, columns = x.shape[1], x.shape[2]
    n_along = rows - 2
    blocks = np.zeros((rows, columns, _REACH, _REACH, 3, 3))
    a = np.empty((5, 3))
    hessian = np.empty((15, 15))
    strain_rows = np.empty((12, 15))
    spread = np.empty((5, 3, 3))
    for j in range(n_along):
        for i in range(n_around):
            a[:] = 0.0
            for node in range(9):
                column = (i + node % 3) % columns
                for c in range(3):
                    value = x[c, j + node // 3, column]
                    for p in range(5):
                        a[p, c] += weights[node, p] * value
            _hessian(
                a, law[j, :, i], geometry[j, :, i], factors, stressed, hessian,
                strain_rows,
            )  # fmt: skip
            for other in range(9):
                for p in range(5):
                    for c in range(3):
                        for d in range(3):
                            total = 0.0
                            for q in range(5):
                                total += hessian[3 * p + c, 3 * q + d] * weights[other, q]
                            spread[p, c, d] = total
                for node in range(9):
                    column = (i + node % 3) % columns
                    down = other // 3 - node // 3 + 2
                    across = other % 3 - node % 3 + 2
                    block = blocks[j + node // 3, column, down, across]
                    for p in range(5):
                        w = weights[node, p]
                        for c in range(3):
                            for d in range(3):
                                block[c, d] += w * spread[p, c, d]
    return blocks
