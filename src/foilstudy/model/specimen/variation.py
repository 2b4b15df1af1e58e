"""Seam and uneven thickness as factors on the elements of a patch."""

from __future__ import annotations

import numpy as np

from foilstudy.model.patch import Patch
from foilstudy.model.random_field import SmoothField
from foilstudy.model.shell.variation import Variation
from foilstudy.model.specimen import CUT, Seam, Specimen, Unevenness

_STREAM = 7919
"""Tells the random numbers of the thickness from those of the imperfection."""


def variation_of(specimen: Specimen, patch: Patch, cylinder: np.ndarray) -> Variation | None:
    """What the elements of a specimen have for thickness and modulus; None if all have the same.

    Parameters
    ----------
    specimen : Specimen
    patch : Patch
        Closed around.
    cylinder : ndarray, shape (3, rows, columns)
        Control points of the uncrumpled foil about the axis z, m: splitting the elements of a
        patch moves its first column.
    """
    if specimen.even:
        return None
    begun = first_arc(patch, cylinder)
    seam, covered = specimen.seam, seam_share(specimen.seam, patch, begun)
    even = np.ones((patch.elements_along, patch.elements_around))
    thickness = even * (1 + (seam.thickness_factor - 1) * covered)
    if specimen.unevenness.deviation:
        thickness = thickness * thickness_field(specimen.unevenness, patch, begun)
    return Variation(thickness, even * (1 + (seam.modulus_factor - 1) * covered))


def first_arc(patch: Patch, cylinder: np.ndarray) -> float:
    """Arc from the x axis to the first control column, m."""
    x, y, _ = cylinder[:, 0, 0]
    return float(np.arctan2(y, x)) * patch.elements_around * patch.size_around / (2 * np.pi)


def seam_share(seam: Seam, patch: Patch, begun: float = 0.0) -> np.ndarray:
    """Share of every element around that the seam covers, shape (elements_around,).

    `begun` is the arc of the first control column, m.
    """
    size, count = patch.size_around, patch.elements_around
    # element i reaches from half a size past control column i on, the seam to both sides of 0
    start = begun + size * (np.arange(count) + 0.5)
    start = np.where(start > 0.5 * count * size, start - count * size, start)
    half = 0.5 * seam.width
    covered = np.zeros(count)
    for turn in (-count * size, 0.0, count * size):
        low, high = start + turn, start + turn + size
        covered += np.clip(np.minimum(high, half) - np.maximum(low, -half), 0, None)
    return np.minimum(covered / size, 1.0)


def thickness_field(unevenness: Unevenness, patch: Patch, begun: float = 0.0) -> np.ndarray:
    """Factor on the thickness in the middle of every element, (elements_along, elements_around).

    `begun` is the arc of the first control column, m.
    """
    rng = np.random.default_rng([unevenness.seed, _STREAM])
    circumference = patch.elements_around * patch.size_around
    height = patch.elements_along * patch.size_along
    field = SmoothField.drawn(rng, circumference, height, unevenness.correlation_length)
    around = begun + patch.size_around * (np.arange(patch.elements_around) + 1.0)
    along = patch.size_along * (np.arange(patch.elements_along) + 0.5)
    return 1 + unevenness.deviation * np.clip(field(around, along)[0], -CUT, CUT)
