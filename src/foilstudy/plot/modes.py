"""What the figures and the page read about modes from response.nc files."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foilstudy.base.record import read_record
from foilstudy.plot.crumples import RecordedCrumple


@dataclass(frozen=True)
class RecordedModes:
    """First modes of one realisation with both rings held.

    Attributes
    ----------
    frequencies : ndarray, shape (modes,)
        Hz.
    shapes : ndarray, shape (modes, 3, node rows, node columns)
        Mass-normalised displacement of the surface at the knots, m/sqrt(kg m2).
    """

    frequencies: np.ndarray
    shapes: np.ndarray


def recorded_modes(
    crumples: Iterable[RecordedCrumple], response_paths: Iterable
) -> dict[Path, RecordedModes]:
    """Modes of those realisations that have some, by the path of their crumple.

    Parameters
    ----------
    crumples
        Realisations on disk.
    response_paths : paths of response.nc files
        The one in the folder of a crumple is its own.

    Returns
    -------
    dict
        Without realisations that failed, or whose study keeps no mode shapes.
    """
    responses = {Path(path).parent: Path(path) for path in response_paths}
    found = {}
    for crumple in crumples:
        response = responses.get(crumple.path.parent)
        modes = read_modes(response) if response is not None and crumple.has_shape else None
        if modes is not None:
            found[crumple.path] = modes
    return found


def read_modes(path: Path) -> RecordedModes | None:
    """Modes in a response.nc whose shape and frequency are known; None if it has none."""
    values, _ = read_record(path)
    if "mode_shape" not in values:
        return None
    shapes = values["mode_shape"].astype(float)
    frequencies = values["eigenfrequency"][: len(shapes)]
    shapes = shapes[: len(frequencies)]
    known = np.isfinite(frequencies) & np.isfinite(shapes).all(axis=(1, 2, 3))
    return RecordedModes(frequencies[known], shapes[known]) if known.any() else None
