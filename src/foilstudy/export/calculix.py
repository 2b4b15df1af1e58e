"""An input deck for CalculiX, so that stiffness and eigenfrequencies can be checked independently.

Keywords after G. Dhondt, CalculiX CrunchiX User's Manual, version 2.20.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foilstudy.export.contents import Contents, surface_grid
from foilstudy.export.decks import comment
from foilstudy.measure.stiffness import fixed_stiffness
from foilstudy.measure.stiffness.directional import MOTIONS

UNIT_MOTION = 1e-3
"""m; the steps are linear, so that it only scales the forces."""
_EIGENFREQUENCIES = 20
_AXES = "xyz"
_NUMBERS_PER_LINE = 8


@dataclass(frozen=True)
class _Rings:
    """Reference node (translations) and rotation node of each ring."""

    bottom: tuple[int, int]
    top: tuple[int, int]

    def held(self) -> list[str]:
        """Both rings at rest, and the slope of the foil with them."""
        nodes = [f"{node}, 1, 3, 0." for node in (*self.bottom, *self.top)]
        return [*nodes, "BOTTOM, 4, 6, 0.", "TOP, 4, 6, 0."]


def write(contents: Contents, path: Path) -> None:
    """Write a frequency step and one static step per direction."""
    contents.crumple.foil.specimen.require_even("the CalculiX deck")
    grid = surface_grid(contents.crumple.points)
    rows, columns, _ = grid.shape
    last = rows * columns
    rings = _Rings((last + 1, last + 2), (last + 3, last + 4))
    lines = [
        *_heading(contents),
        *_nodes(contents, grid, rings),
        *_elements(rows, columns),
        *_section(contents, rings),
    ]
    lines += _frequency_step()  # first: the forces asked for below would be printed per mode
    for directions in MOTIONS.values():
        for axis in directions:
            lines += _static_step(rings, axis)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _heading(contents: Contents) -> Iterator[str]:
    axial, radial = fixed_stiffness(contents.model.static_stiffness)
    frequencies = ", ".join(f"{f:.2f}" for f in contents.eigenfrequencies[:6])
    yield from comment(
        f"""
        Crumpled foil between two rigid rings, free of stress in this shape. Units: m, N, kg, s.
        Run: ccx NAME (without .inp); the results are in NAME.dat (forces) and NAME.frd (modes).

        One S8R element per element of foilstudy: its nodes lie on the quadratic B-spline surface.
        The model of foilstudy holds position and slope of the foil at the rings. A rigid body of
        the edge's nodes holds their position alone, as a hinge does (CalculiX takes the middle of
        the thickness); the slope is held by their rotations 4 to 6. A ring that is to turn needs
        these turned with it, beside its rotation node.

        Static steps: the bottom ring moves by {UNIT_MOTION:g} m in the direction of the step,
        every other motion of both rings is held. The total force on the nodes of TOP over
        -{UNIT_MOTION:g} m is the transfer stiffness. (The reference nodes carry no reaction in
        CalculiX: forces of rigid bodies appear at their nodes.) Radial is the mean of x and y.

        Expected, foilstudy on this mesh: axial {axial:.6g} N/m, radial {radial:.6g} N/m,
        eigenfrequencies with both rings held
        {frequencies} Hz.
        The two codes agree as the mesh is refined (foilstudy export --refinements), and differ on
        a given one by their mesh errors.
        """,
        contents.provenance,
    )


def _nodes(contents: Contents, grid: np.ndarray, rings: _Rings) -> Iterator[str]:
    rows, columns, _ = grid.shape
    used = np.ones((rows, columns), dtype=bool)
    used[1::2, 1::2] = False  # S8R has no node in its middle
    yield "*NODE, NSET=ALL"
    for node, (x, y, z) in zip(np.flatnonzero(used) + 1, grid[used], strict=True):
        yield f"{node}, {x:.12e}, {y:.12e}, {z:.12e}"
    for pair, height in zip((rings.bottom, rings.top), contents.ring_heights, strict=True):
        for node in pair:
            yield f"{node}, 0., 0., {height:.12e}"
    numbers = np.arange(1, rows * columns + 1).reshape(rows, columns)
    for name, row in (("BOTTOM", numbers[0]), ("TOP", numbers[-1])):
        yield f"*NSET, NSET={name}"
        for start in range(0, columns, _NUMBERS_PER_LINE):
            yield ", ".join(map(str, row[start : start + _NUMBERS_PER_LINE]))


def _elements(rows: int, columns: int) -> Iterator[str]:
    numbers = np.arange(1, rows * columns + 1).reshape(rows, columns)
    yield "*ELEMENT, TYPE=S8R, ELSET=FOIL"
    element = 0
    for row in range(0, rows - 1, 2):
        for column in range(0, columns, 2):
            element += 1
            left, middle, right = (numbers[row : row + 3, (column + k) % columns] for k in range(3))
            corners = left[0], right[0], right[2], left[2]
            yield ", ".join(map(str, (element, *corners, middle[0], right[1], middle[2], left[1])))


def _section(contents: Contents, rings: _Rings) -> Iterator[str]:
    foil = contents.crumple.foil
    yield from (
        "*MATERIAL, NAME=FOIL",
        "*ELASTIC",
        f"{foil.material.youngs_modulus:g}, {foil.material.poisson_ratio:g}",
        "*DENSITY",
        f"{foil.material.density:g}",
        "*SHELL SECTION, ELSET=FOIL, MATERIAL=FOIL",
        f"{foil.thickness:g}",
    )
    for name, (reference, turning) in (("BOTTOM", rings.bottom), ("TOP", rings.top)):
        yield f"*RIGID BODY, NSET={name}, REF NODE={reference}, ROT NODE={turning}"
    yield "*BOUNDARY"
    yield from rings.held()


def _static_step(rings: _Rings, axis: int) -> Iterator[str]:
    yield from comment(f"unit motion of the bottom ring along {_AXES[axis]}")
    # all else stays held from the model; taking conditions back and giving them again (OP=NEW)
    # makes version 2.20 lose the rotations of the edges
    yield from ("*STEP", "*STATIC", "*BOUNDARY")
    for other in range(3):
        motion = UNIT_MOTION if other == axis else 0.0
        yield f"{rings.bottom[0]}, {other + 1}, {other + 1}, {motion:g}"
    for name in ("BOTTOM", "TOP"):
        yield from (f"*NODE PRINT, NSET={name}, TOTALS=ONLY", "RF")
    yield "*END STEP"


def _frequency_step() -> Iterator[str]:
    yield from comment("eigenfrequencies with both rings held")
    yield from ("*STEP", "*FREQUENCY", f"{_EIGENFREQUENCIES}", "*NODE FILE", "U", "*END STEP")
