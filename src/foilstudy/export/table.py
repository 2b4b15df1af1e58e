"""The frequency responses as tables."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from foilstudy.export.contents import Contents
from foilstudy.export.motions import pairs
from foilstudy.measure.dynamics import DEFINITIONS, directional_stiffness
from foilstudy.measure.stiffness.directional import DIRECTIONS


def write(contents: Contents, path: Path) -> None:
    """Write the dynamic stiffness of every definition and direction, real and imaginary part."""
    stiffness = directional_stiffness(contents.dynamic_stiffness)
    header, columns = ["frequency (Hz)"], [contents.frequencies]
    for d, definition in enumerate(DEFINITIONS):
        for e, direction in enumerate(DIRECTIONS):
            for part in ("real", "imag"):
                header.append(f"{definition} {direction} {part} (N/m)")
                columns.append(getattr(stiffness[d, e], part))
    _write(path, header, columns)


def write_motion(contents: Contents, path: Path, *, quantity: str, condition: str) -> None:
    """Write receptance or accelerance of all pairs of motions, real and imaginary part."""
    header, columns = ["frequency (Hz)"], [contents.even_grid.frequencies]
    values = contents.motion_per_force(quantity, condition)
    for i, j, pair in pairs(condition):
        for part in ("real", "imag"):
            header.append(f"{pair.text} {part} ({pair.units(quantity)})")
            columns.append(getattr(values[:, i, j], part))
    _write(path, header, columns)


def _write(path: Path, header: list[str], columns: list[np.ndarray]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        writer.writerows([repr(float(x)) for x in row] for row in np.transpose(columns))
