"""A crumpled shape as the later parts of a realisation read it back."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from foilstudy.model.foil import Foil
from foilstudy.model.patch import Patch, refine
from foilstudy.model.shell.elements import ELEMENTS
from foilstudy.model.shell.elements.protocol import Element
from foilstudy.model.shell.shell import Shell


@dataclass(frozen=True)
class Crumple:
    """A crumpled shape, SI.

    Attributes
    ----------
    foil : Foil
    patch : Patch
    points, reference : ndarray, shape (3, rows, columns)
        Control points of the crumpled and of the stress-free shape, m.
    element : Element
    """

    foil: Foil
    patch: Patch
    points: np.ndarray
    reference: np.ndarray
    element: Element

    @classmethod
    def recorded(cls, foil: Foil, values: dict, attributes: dict) -> Crumple:
        """From a record of `crumple`."""
        points = values["control_points"]
        _, rows, columns = points.shape
        along = rows - 2
        sizes = np.pi * foil.diameter / columns, foil.reference_height / along
        patch = Patch(columns, along, *sizes)
        reference = values["reference_control_points"]
        return cls(foil, patch, points, reference, ELEMENTS[attributes["element"]]())

    def sheet(self, reference: np.ndarray) -> Shell:
        """A sheet of this foil that is stress-free in the given shape."""
        foil = self.foil
        return Shell.elastic(self.patch, reference, foil.material, foil.thickness, self.element)

    def refined(self) -> Crumple:
        """The same shape with every element split in four."""
        return replace(
            self,
            patch=self.patch.refined(),
            points=refine(self.points),
            reference=refine(self.reference),
        )
