"""Stiffness and energy of shapes drawn by hand."""

from __future__ import annotations

import numpy as np

from foilstudy.measure.localisation import localisation
from foilstudy.model.patch import Patch
from foilstudy.pipeline.drawn import Concertina, Meridian, Pleats, drawn
from foilstudy.study.published import GAP_HEIGHT, foil
from foilstudy.study.specimen.plan import THICKNESS_UM, Drawn

_AROUND = 72
"""Elements: the shapes are axisymmetric, and the motions of the rings have one wave around."""


def meridian_of(name: str) -> Meridian:
    """The line of a drawn shape."""
    return {
        "pleat": Pleats(1),
        "two_pleats": Pleats(2),
        "three_pleats": Pleats(3),
        "concertina": Concertina(6),
    }[name]


def measure(case: Drawn) -> dict:
    """Stress-free stiffness of the shape, and its elastic energy from the straight cylinder."""
    sheet = foil(THICKNESS_UM, 1e3 * GAP_HEIGHT * (1 + case.overlength_percent / 100))
    along = round(sheet.reference_height / (case.size_mm * 1e-3))
    spacings = np.pi * sheet.diameter / _AROUND, sheet.reference_height / along
    shape = drawn(sheet, Patch(_AROUND, along, *spacings), meridian_of(case.meridian))
    energies = shape.energies()
    return {
        "stiffness": [float(value) for value in shape.stiffness()],
        "energy": energies.total,
        "membrane_energy": energies.membrane,
        "bending_energy": energies.bending,
        **localisation(shape.patch, shape.points),
    }
