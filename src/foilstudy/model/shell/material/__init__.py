"""Material laws of the shell: one file each, all of the protocol `Law`."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from foilstudy.base.registry import Choice, Registry
from foilstudy.model.materials import Material

__all__ = ["LAWS", "Law"]


class Law(Protocol):
    """How a section of a given thickness resists strain and curvature.

    Made of a `Material`. An elastic law is all in its stiffness; one with a memory adds terms to
    the energy (`foilstudy.solve.problem.Term`), which hold the state.

    Attributes
    ----------
    material : Material
    """

    material: Material

    def terms(self, shell: Any) -> tuple[Any, ...]:
        """What a problem has to add to the elastic shell of this law."""
        ...

    def membrane_stiffness(self, forms: np.ndarray, thickness: float) -> np.ndarray:
        """Stiffness against the membrane strain per unit of parameter area.

        Parameters
        ----------
        forms : ndarray, shape (elements_along, 6, elements_around)
            First and second fundamental form of the stress-free shape, see `section.Section`.
        thickness : float
            m.

        Returns
        -------
        ndarray, shape (elements_along, 6, elements_around)
            Coefficients 11-11, 22-22, 11-22, 11-12, 22-12, 12-12 against (e_11, e_22, 2 e_12),
            N/m; against curvature they are the same times t^2/12.
        """
        ...


LAWS = Registry(
    "material law",
    {
        "elastic": Choice("model.shell.material.elastic:Elastic", "linear elastic and isotropic"),
        "plastic": Choice(
            "model.shell.material.plastic:Plastic",
            "elastic up to the yield stress, then von Mises plasticity with linear hardening",
        ),
    },
)
