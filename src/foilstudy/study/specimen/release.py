"""A band crumpled between clamped ends, joined to a straight rest, and let go."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from foilstudy.model.foil import Foil
from foilstudy.model.patch import Patch
from foilstudy.pipeline.crumpled import Crumpled


def joined(band: Crumpled, whole: Foil) -> Crumpled:
    """The band at the bottom, and above it the rest of a foil as it was rolled.

    Parameters
    ----------
    band : Crumpled
        Of a height that goes into that of the whole foil a whole number of times.
    whole : Foil

    Returns
    -------
    Crumpled
        At the state of the band, as yet not in equilibrium where the two meet.
    """
    patch = band.patch
    along = patch.elements_along * round(whole.reference_height / band.foil.reference_height)
    of_whole = Patch(patch.elements_around, along, patch.size_around, patch.size_along)
    added = of_whole.rows - patch.rows
    reference = _continued(band.reference, added, patch.size_along)
    points = _continued(band.points, added, patch.size_along)
    values = {
        name: np.concatenate([value, np.zeros((added, *value.shape[1:]))])
        for name, value in band.problem().recorded().items()
    }
    shape = replace(band, foil=whole, patch=of_whole, points=points, reference=reference)
    return shape._remembering(replace(shape, arrival=None).problem(), values)


def _continued(points: np.ndarray, rows: int, size: float) -> np.ndarray:
    """Further rows above the ring, straight up, m."""
    ring = points[:, -1:]
    more = np.repeat(ring, rows, axis=1)
    more[2] += size * np.arange(1, rows + 1)[:, None]
    return np.ascontiguousarray(np.concatenate([points, more], axis=1))
