"""Elements under test, and the order that theory promises each of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.materials import Material
from foilstudy.model.patch import Patch
from foilstudy.model.shell.elements import ELEMENTS
from foilstudy.model.shell.elements.protocol import Element
from foilstudy.model.shell.shell import Shell


@dataclass(frozen=True)
class Candidate:
    """An element under test.

    Attributes
    ----------
    edge_order : float
        Order of convergence where a free edge decides and the mesh does not resolve its boundary
        layer, which is about sqrt(R t) wide.
    """

    name: str
    element: Element
    edge_order: float

    def sheet(
        self, patch: Patch, reference: np.ndarray, material: Material, thickness: float
    ) -> Shell:
        """A sheet of this element; thickness in m."""
        return Shell.elastic(patch, reference, material, thickness, self.element)

    def order(self, free_edge: bool = False) -> float:
        """Order in the element size of energies and of what equals one, see `linear`.

        2 (p + 1 - m) = 2 for quadratic splines (p = 2) in a problem of fourth order (m = 2)
        [G. Strang, G. Fix, An Analysis of the Finite Element Method, 1973, theorem 3.7].
        """
        return self.edge_order if free_edge else 2.0


CANDIDATES = {
    # its samples on a free edge stand for half an element, in which the strain changes
    "corner": Candidate("corner", ELEMENTS["corner"](), edge_order=1.0),
    "one_point": Candidate("one_point", ELEMENTS["one_point"](), edge_order=2.0),
}
"""By name; the default element of the studies is the first."""
