"""What one element does with a given shape or a given path."""

from __future__ import annotations

from collections.abc import Mapping

from foilstudy.study.elements.bending import SLENDERNESS, ring_error, roll_up_error
from foilstudy.study.elements.buckled import buckled
from foilstudy.study.elements.frozen import frozen_errors
from foilstudy.study.elements.plan import Frozen
from foilstudy.study.elements.variants import VARIANTS
from foilstudy.study.kernel.plan import Record


def variant_errors(name: str, frozen: Mapping[Frozen, Record]) -> dict:
    """Measure one variant against theory, frozen shapes and the post-buckled panel.

    Returns
    -------
    dict
        Relative errors, NaN where it found no answer: ``ring`` by slenderness t/h, ``roll_up``, and
        ``frozen``, axial and radial by thickness in micrometres, 5 mm mesh against refined.
        ``buckled`` is the energy of the post-buckled panel, 5 mm mesh, J.
    """
    variant = VARIANTS[name]
    return {
        "ring": {f"{s:g}": ring_error(variant, s) for s in SLENDERNESS},
        "roll_up": roll_up_error(variant),
        "frozen": {
            str(case.thickness_um): frozen_errors(variant, case, record.result)
            for case, record in frozen.items()
        },
        "buckled": buckled(variant.element).energy,
    }
