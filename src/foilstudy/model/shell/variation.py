"""Thickness and modulus that differ from element to element."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Variation:
    """Factors on thickness and modulus of a section, shape (elements_along, elements_around).

    Attributes
    ----------
    thickness, modulus : ndarray
        Positive, but a modulus may be zero. It is a factor on all stresses at given strains: what
        yields does so at the same strains.
    """

    thickness: np.ndarray
    modulus: np.ndarray

    @property
    def membrane(self) -> np.ndarray:
        """Factor on the membrane stiffness."""
        return self.modulus * self.thickness

    def even_parts(self) -> tuple[tuple[float, np.ndarray], ...]:
        """Factors of even thicknesses, and moduli at them, that together are the same.

        Membrane stiffness is linear in modulus times thickness, and bending stiffness is that times
        the square of the thickness. So an element is a mixture of a thin and a thick one, which
        share their strains: both stiffnesses of the two add up to its own.
        """
        square = self.thickness**2
        thin, thick = square.min(), square.max()
        if thick == thin:
            return ((float(np.sqrt(thin)), self.modulus),)
        share = (square - thin) / (thick - thin)
        return tuple(
            (float(np.sqrt(of)), self.membrane * part / np.sqrt(of))
            for of, part in ((thin, 1 - share), (thick, share))
        )
