"""What one element does with a given shape or a given path."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from foilstudy.study.elements.bending import SLENDERNESS, ring_error, roll_up_error
from foilstudy.study.elements.buckled import buckled
from foilstudy.study.elements.frozen import FrozenShape, frozen_errors
from foilstudy.study.elements.plan import Frozen
from foilstudy.study.elements.variants import VARIANTS
from foilstudy.study.kernel import Record


@dataclass(frozen=True)
class VariantErrors:
    """Relative errors of one variant; NaN where it found no answer.

    Attributes
    ----------
    ring : dict of str to float
        By slenderness t/h.
    roll_up : float
    frozen : dict of str to (axial, radial)
        By thickness in micrometres; 5 mm mesh against refined.
    buckled : float
        Energy of the post-buckled panel, 5 mm mesh, J.
    """

    ring: dict[str, float]
    roll_up: float
    frozen: dict[str, tuple[float, float]]
    buckled: float


def variant_errors(name: str, frozen: Mapping[Frozen, Record]) -> VariantErrors:
    """Measure one variant against theory, frozen shapes and the post-buckled panel."""
    variant = VARIANTS[name]
    shapes = {
        str(case.thickness_um): FrozenShape(
            record.result["thickness"],
            record.result["points"],
            np.array(record.result["referees"], float),
        )
        for case, record in frozen.items()
    }
    return VariantErrors(
        {f"{s:g}": ring_error(variant, s) for s in SLENDERNESS},
        roll_up_error(variant),
        {thickness: frozen_errors(variant, shape) for thickness, shape in shapes.items()},
        buckled(variant).energy,
    )
