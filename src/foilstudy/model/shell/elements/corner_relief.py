"""Corner-sampled elements of which some have inelastic strains: by the kernel of elastic ones.

The kernel takes the stresses that such elements lack off those of their vertices and middles, and
knows the energies of the strains as they are. A sheet that has yielded costs hardly more than one
that has not, and only what has changed since the last state is written anew. As long as nothing
lacks any it is the kernel of elastic elements, to the same bits.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from foilstudy.model.shell.elements.corner_data import ElementPlaces
from foilstudy.model.shell.elements.corner_kernel import internal_force
from foilstudy.model.shell.section import Section


class CornerRelief:
    """Stresses that elements lack, kept up to date with their inelastic strains.

    Parameters
    ----------
    data : ndarray
        Of the elements, from `corner_data.pack`.
    section : Section
    bend : float
        t^2/12, m2.
    """

    def __init__(self, data: np.ndarray, section: Section, bend: float):
        patch = section.patch
        self._patch, self._data, self._bend = patch, data, bend
        self._places = ElementPlaces.of(patch.elements_around, patch.elements_along, patch.periodic)
        self._lacking, self._any = np.zeros(self._places.size), False
        # by element, as the few that change are scattered
        self._stiffness = section.stiffness.transpose(0, 2, 1).copy()

    def update(self, elements: np.ndarray, strains: np.ndarray) -> None:
        """Take the inelastic strains of some elements.

        Parameters
        ----------
        elements : ndarray of int, shape (number,)
            Row times elements around plus column.
        strains : ndarray, shape (number, 6)
        """
        some = _taken_off(
            elements, strains, self._stiffness, self._bend, self._places, self._lacking
        )
        self._any = some or bool(self._lacking.any())

    def force(self, points: np.ndarray, out: np.ndarray) -> np.ndarray:
        """See `ElementKernel`: the force of what is elastic, the energies of all strains."""
        patch = self._patch
        lacking = self._lacking if self._any else None
        return internal_force(
            points, patch.elements_around, self._data, lacking,
            (patch.size_around, patch.size_along), self._bend, out,
        )  # fmt: skip

    def work(self, strains: np.ndarray) -> float:
        """Of the stresses taken off on strains, J."""
        return _work(self._places, self._lacking, strains)


@njit(cache=True, error_model="numpy", forceinline=True)
def _times(law, e1, e2, e6):
    return (
        law[0] * e1 + law[2] * e2 + law[3] * e6,
        law[2] * e1 + law[1] * e2 + law[4] * e6,
        law[3] * e1 + law[4] * e2 + law[5] * e6,
    )


@njit(cache=True, error_model="numpy")
def _taken_off(elements, strains, stiffness, bend, places, lacking):
    """Write stresses of the inelastic strains of some elements; whether there are any."""
    around, some = stiffness.shape[1], False
    for n in range(len(elements)):
        j, k = elements[n] // around, elements[n] % around
        s, law = strains[n], stiffness[j, k]
        at = places.first[k] + j * places.row
        n1, n2, n6 = _times(law, s[0], s[1], s[2])
        m1, m2, m6 = _times(law, bend * s[3], bend * s[4], bend * s[5])
        lacking[at], lacking[at + places.value] = n1, n2
        lacking[at + 2 * places.value], lacking[at + 3 * places.value] = n6, m1
        lacking[at + 4 * places.value], lacking[at + 5 * places.value] = m2, m6
        some |= n1 != 0.0 or n2 != 0.0 or n6 != 0.0 or m1 != 0.0 or m2 != 0.0 or m6 != 0.0
    return some


@njit(cache=True, error_model="numpy")
def _work(places, lacking, strains):
    total = 0.0
    for j in range(strains.shape[0]):
        for part in range(strains.shape[1]):
            at = j * places.row + part * places.value
            for k in range(strains.shape[2]):
                total += lacking[places.first[k] + at] * strains[j, part, k]
    return total
