"""The reduced model for Abaqus: matrices at two nodes, one for each ring, and inner ones.

Keywords after the Abaqus Keywords Reference Guide 2016, *MATRIX INPUT and *MATRIX ASSEMBLE.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from foilstudy.export.contents import Contents
from foilstudy.export.decks import comment
from foilstudy.export.superelement import (
    BOTTOM,
    TOP,
    Place,
    entries,
    expected,
    inner_places,
)
from foilstudy.measure.dynamics.damping_matrix import damping_matrix
from foilstudy.measure.dynamics.structure import INTERFACE


def write(contents: Contents, path: Path) -> None:
    """Write stiffness, mass and viscous damping, to be included in a model.

    Raises
    ------
    Refusal
        If the damping is not viscous.
    """
    lines = [*_heading(contents), *_nodes(contents), *_matrices(contents)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _heading(contents: Contents) -> Iterator[str]:
    yield from comment(
        f"""
        Crumpled foil between two rigid rings as a superelement. Units: m, N, kg, s, rad.
        In the model, outside of any part: *INCLUDE, INPUT=superelement_abaqus.inp
        Node {BOTTOM} is the centre of the bottom ring, {TOP} that of the top ring, each with six
        motions: tie them to the structure. The other nodes carry generalised coordinates; leave
        them alone. The rings themselves weigh nothing. A matrix is linear: large translations
        are well, large rotations are not.
        {expected(contents)}
        """,
        contents.provenance,
    )


def _nodes(contents: Contents) -> Iterator[str]:
    low, high = contents.ring_heights
    yield from ("*NODE, NSET=FOIL_RINGS", f"{BOTTOM}, 0., 0., {low:.12e}")
    yield f"{TOP}, 0., 0., {high:.12e}"
    inner = {place.node for place in _places(contents)[INTERFACE:]}
    if inner:
        yield "*NODE, NSET=FOIL_INNER"
        yield from (f"{node}, 0., 0., {(low + high) / 2:.12e}" for node in sorted(inner))


def _matrices(contents: Contents) -> Iterator[str]:
    model = contents.model
    places = _places(contents)
    matrices = {
        "FOIL_K": model.stiffness,
        "FOIL_M": model.mass,
        "FOIL_C": damping_matrix(model, contents.damping),
    }
    for name, matrix in matrices.items():
        yield f"*MATRIX INPUT, NAME={name}, TYPE=SYMMETRIC"
        yield from entries(matrix, places)
    yield "*MATRIX ASSEMBLE, STIFFNESS=FOIL_K, MASS=FOIL_M, VISCOUS DAMPING=FOIL_C"


def _places(contents: Contents) -> list[Place]:
    rings = [Place(node, 1 + k) for node in (BOTTOM, TOP) for k in range(6)]
    return rings + inner_places(len(contents.model.stiffness) - INTERFACE)
