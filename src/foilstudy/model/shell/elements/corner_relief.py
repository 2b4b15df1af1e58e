"""Corner-sampled elements of which some have inelastic strains: by the kernel of elastic ones.

Inelastic strains of elements move the shape in which they are free of stress. Where four elements
meet, what moves it for their common vertex is the strain that the stresses on all of them would
cause there; with the control moved along, and a constant added to the energy, that is the same
potential. So a sheet that has yielded costs no more than one that has not, and one that has not is
evaluated to the same bits; only what has changed since the last state is moved anew.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from foilstudy.model.shell.elements.corner_data import VertexPlaces, vertex_laws
from foilstudy.model.shell.elements.corner_kernel import LANES, STEPS, internal_force
from foilstudy.model.shell.section import Section

_PLACES = LANES * (STEPS + 1)
_EDGE_ALONG, _EDGE_AROUND, _BENDING = 11, 9, 13
"""Values of the data: metrics in the middle of edges, and the first curvature."""
# What is kept of a vertex: three metrics and those of the edges that begin there, without inelastic
# strains; by how much 11 and 22 are moved; and the energy of that. Of an element: three curvatures
# without, six stresses, the energy.
_ALONG, _AROUND, _SHIFT, _OF_VERTEX = 3, 4, 5, 8
_STRESS, _OF_ELEMENT = 3, 10
_SPARE = -1


class CornerRelief:
    """Data of the kernel, kept up to date with the inelastic strains of the elements.

    Parameters
    ----------
    data : ndarray
        Of the elements without inelastic strains, from `corner_data.pack`.
    section : Section
    bend : float
        t^2/12, m2.

    Attributes
    ----------
    data : ndarray
    """

    def __init__(self, data: np.ndarray, section: Section, bend: float):
        patch = section.patch
        self._patch, self._bend = patch, bend
        self.data = data.copy()
        self._places = VertexPlaces.of(patch.elements_around, patch.elements_along, patch.periodic)
        # by element and by vertex, as the few that change are scattered
        self._stiffness = section.stiffness.transpose(0, 2, 1).copy()
        laws = vertex_laws(section.stiffness, patch.periodic)
        self._flexibility = _inverses(laws).transpose(0, 2, 1).copy()
        self._vertices = np.zeros((*self._flexibility.shape[:2], _OF_VERTEX))
        self._elements = np.zeros((*self._stiffness.shape[:2], _OF_ELEMENT))
        _noted(data, self._places, self._vertices, self._elements)
        self._met = np.zeros(self._vertices.shape[:2], dtype=np.bool_)

    def update(self, elements: np.ndarray, strains: np.ndarray) -> None:
        """Take the inelastic strains of some elements.

        Parameters
        ----------
        elements : ndarray of int, shape (number,)
            Row times elements around plus column.
        strains : ndarray, shape (number, 6)
        """
        _bent(
            elements, strains, self._stiffness, self._bend, self.data, self._places, self._elements
        )
        _stretched(
            elements, self._patch.periodic, self._flexibility, self.data, self._places,
            self._elements, self._vertices, self._met,
        )  # fmt: skip

    def force(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        """See `ElementKernel`: of what is elastic of the strains."""
        patch = self._patch
        return internal_force(
            points, patch.elements_around, self.data, (patch.size_around, patch.size_along),
            self._bend, out,
        )  # fmt: skip

    def spare(self) -> tuple[float, float]:
        """Elastic membrane and bending energy of the inelastic strains, as means of elements, J."""
        return float(self._vertices[..., _SPARE].sum()), float(self._elements[..., _SPARE].sum())

    def work(self, strains: np.ndarray) -> tuple[float, float]:
        """Of the stresses taken off, on membrane and on bending strains, J."""
        return _works(self._elements, strains)


def _inverses(laws: np.ndarray) -> np.ndarray:
    """Of symmetric matrices by coefficients 11, 22, 12, 16, 26, 66, shape (rows, 6, lines)."""
    c11, c22, c12, c16, c26, c66 = laws.transpose(1, 0, 2)
    inverse = np.stack(
        [
            c22 * c66 - c26**2, c11 * c66 - c16**2, c16 * c26 - c12 * c66,
            c12 * c26 - c16 * c22, c12 * c16 - c11 * c26, c11 * c22 - c12**2,
        ],
        axis=1,
    )  # fmt: skip
    determinant = (c11 * inverse[:, 0] + c12 * inverse[:, 2] + c16 * inverse[:, 3])[:, None]
    # a part of a section that varies is not everywhere: what has no stiffness is not moved
    return np.divide(inverse, determinant, out=np.zeros_like(inverse), where=determinant != 0)


@njit(cache=True, error_model="numpy", forceinline=True)
def _times(law, e1, e2, e6):
    return (
        law[0] * e1 + law[2] * e2 + law[3] * e6,
        law[2] * e1 + law[1] * e2 + law[4] * e6,
        law[3] * e1 + law[4] * e2 + law[5] * e6,
    )


@njit(cache=True, error_model="numpy")
def _noted(data, places, vertices, elements):
    """Metrics and curvatures without inelastic strains."""
    for r in range(vertices.shape[0]):
        for v in range(vertices.shape[1]):
            at = places.owned[v] + r * places.row
            for part in range(3):
                vertices[r, v, part] = data[at + part * _PLACES]
            vertices[r, v, _ALONG] = data[at + _EDGE_ALONG * _PLACES]
            vertices[r, v, _AROUND] = data[at + _EDGE_AROUND * _PLACES]
    for j in range(elements.shape[0]):
        for k in range(elements.shape[1]):
            at = places.owned[k] + j * places.row + _BENDING * _PLACES
            for part in range(3):
                elements[j, k, part] = data[at + part * _PLACES]


@njit(cache=True, error_model="numpy")
def _bent(elements, strains, stiffness, bend, data, places, of_element):
    """Stresses of some elements; curvatures at rest moved by the inelastic ones."""
    around = stiffness.shape[1]
    for n in range(len(elements)):
        j, k = elements[n] // around, elements[n] % around
        s, law, own = strains[n], stiffness[j, k], of_element[j, k]
        own[_STRESS], own[_STRESS + 1], own[_STRESS + 2] = _times(law, s[0], s[1], s[2])
        m1, m2, m6 = _times(law, bend * s[3], bend * s[4], bend * s[5])
        own[_STRESS + 3], own[_STRESS + 4], own[_STRESS + 5] = m1, m2, m6
        own[_SPARE] = 0.5 * (m1 * s[3] + m2 * s[4] + m6 * s[5])
        at = places.owned[k] + j * places.row + _BENDING * _PLACES
        for part in range(3):
            data[at + part * _PLACES] = own[part] - s[3 + part]


@njit(cache=True, error_model="numpy")
def _stretched(elements, periodic, flexibility, data, places, of_element, of_vertex, met):
    """Metrics at rest of the vertices of some elements, and of their edges, moved."""
    along, around, _ = of_element.shape
    lines = of_vertex.shape[1]
    vertices = np.empty((4 * len(elements), 2), dtype=np.int64)
    number = 0
    for n in range(len(elements)):
        j, k = elements[n] // around, elements[n] % around
        for r in range(j, j + 2):
            for v in range(k, k + 2):
                line = v if v < lines else 0
                if not met[r, line]:
                    met[r, line] = True
                    vertices[number, 0], vertices[number, 1] = r, line
                    number += 1
    for n in range(number):
        r, v = vertices[n, 0], vertices[n, 1]
        met[r, v] = False
        s1 = s2 = s6 = 0.0
        for j in range(max(r - 1, 0), min(r + 1, along)):
            for side in range(2):
                k = v - side
                if k < 0 and periodic:
                    k += around
                if 0 <= k < around:
                    stress = of_element[j, k]
                    s1 += 0.25 * stress[_STRESS]
                    s2 += 0.25 * stress[_STRESS + 1]
                    s6 += 0.25 * stress[_STRESS + 2]
        d1, d2, d6 = _times(flexibility[r, v], s1, s2, s6)
        own = of_vertex[r, v]
        own[_SHIFT], own[_SHIFT + 1] = d1, d2
        own[_SPARE] = 0.5 * (s1 * d1 + s2 * d2 + s6 * d6)
        for place in range(places.starts[v], places.starts[v + 1]):
            at = places.all[place] + r * places.row
            data[at], data[at + _PLACES] = own[0] + d1, own[1] + d2
            data[at + 2 * _PLACES] = own[2] + d6
    for n in range(number):
        r, v = vertices[n, 0], vertices[n, 1]
        for j in range(max(r - 1, 0), min(r + 1, along)):
            low, high = of_vertex[j, v], of_vertex[j + 1, v]
            at = places.owned[v] + j * places.row + _EDGE_ALONG * _PLACES
            data[at] = low[_ALONG] + 0.5 * (low[_SHIFT] + high[_SHIFT])
        for side in range(2):
            k = v - side
            if k < 0 and periodic:
                k += around
            if 0 <= k < around:
                left, right = of_vertex[r, k], of_vertex[r, k + 1 if k + 1 < lines else 0]
                at = places.owned[k] + r * places.row + _EDGE_AROUND * _PLACES
                data[at] = left[_AROUND] + 0.5 * (left[_SHIFT + 1] + right[_SHIFT + 1])


@njit(cache=True, error_model="numpy")
def _works(of_element, strains):
    membrane = bending = 0.0
    for j in range(strains.shape[0]):
        for k in range(strains.shape[2]):
            own = of_element[j, k]
            for part in range(3):
                membrane += own[_STRESS + part] * strains[j, part, k]
                bending += own[_STRESS + 3 + part] * strains[j, 3 + part, k]
    return membrane, bending
