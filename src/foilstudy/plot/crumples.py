"""What the figures read from crumple.nc files."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foilstudy.base.outcome import USABLE
from foilstudy.base.record import read_attributes, read_record
from foilstudy.model.patch import knot_points

_TOLD = {
    "thickness_um": float,
    "overlength_percent": float,
    "reference_height_mm": float,
    "seed": int,
    "status": str,
    "message": str,
}
"""Attributes of a record that the figures go by."""


@dataclass(frozen=True)
class RecordedCrumple:
    """One realisation on disk."""

    path: Path
    thickness_um: float
    overlength_percent: float
    reference_height_mm: float
    seed: int
    status: str
    message: str

    @property
    def has_shape(self) -> bool:
        """Whether the file holds a crumpled shape."""
        return self.status in USABLE


@dataclass(frozen=True)
class Surface:
    """A crumpled surface.

    Attributes
    ----------
    control_points : ndarray, shape (3, rows, columns), m
    radius : float
        Radius of the reference cylinder, m.
    """

    control_points: np.ndarray
    radius: float


def catalogue(paths: Iterable) -> list[RecordedCrumple]:
    """Return the realisations in `paths`, sorted by thickness, overlength and seed."""
    found = []
    for path in map(Path, paths):
        attributes = read_attributes(path)
        found.append(
            RecordedCrumple(path, **{name: kind(attributes[name]) for name, kind in _TOLD.items()})
        )
    return sorted(found, key=lambda c: (c.thickness_um, c.overlength_percent, c.seed))


def read_shape(crumple: RecordedCrumple) -> Surface:
    """Read the crumpled surface of a realisation that has one."""
    values, _ = read_record(crumple.path)
    reference = knot_points(values["reference_control_points"])
    return Surface(values["control_points"], float(np.hypot(reference[0], reference[1]).mean()))


def read_history(crumple: RecordedCrumple) -> dict[str, np.ndarray]:
    """Read the history of a realisation; keys without the prefix ``history_``, SI units."""
    values, _ = read_record(crumple.path)
    return {
        name.removeprefix("history_"): column
        for name, column in values.items()
        if name.startswith("history_")
    }


def typical_configuration(crumples: list[RecordedCrumple]) -> list[RecordedCrumple]:
    """Return all realisations of the thickest foil at its middle overlength with a shape.

    Falls back on thinner foils and other overlengths where realisations failed; empty if no
    realisation has a shape.
    """
    usable = [c for c in crumples if c.has_shape]
    if not usable:
        return []
    thickness = max(c.thickness_um for c in usable)
    overlengths = sorted({c.overlength_percent for c in usable if c.thickness_um == thickness})
    middle = overlengths[len(overlengths) // 2]
    return [c for c in usable if c.thickness_um == thickness and c.overlength_percent == middle]
