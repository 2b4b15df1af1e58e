"""The reduced model for CalculiX: a substructure, of which its matrices are files of their own.

Keywords after the CalculiX CrunchiX user's manual, *MATRIX ASSEMBLE and "Substructure
(Superelement)": symmetric, at most 256 nodes with translations alone. A ring is therefore three
nodes on it, that move as a rigid body of a reference and a rotation node.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.export.contents import Contents
from foilstudy.export.decks import comment
from foilstudy.export.superelement import (
    BOTTOM,
    INNER,
    TOP,
    Place,
    entries,
    expected,
    inner_places,
)
from foilstudy.measure.dynamics.structure import INTERFACE
from foilstudy.measure.stiffness.rings import rigid_motion

ROTATIONS = {BOTTOM: BOTTOM + 2, TOP: TOP + 2}
"""Nodes of which the translations 1 to 3 are the rotations of a ring."""
CORNERS = {BOTTOM: (9005, 9006, 9007), TOP: (9008, 9009, 9010)}
"""Nodes on the rings, evenly around."""
_NODES_MAX = 256


def write(contents: Contents, path: Path) -> None:
    """Write what is to be included in a deck; the matrices are the formats of the same name.

    Raises
    ------
    Refusal
        If the model has more coordinates than a substructure can hold.
    """
    lines = [*_heading(contents), *_nodes(contents), *_element(contents)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_stiffness(contents: Contents, path: Path) -> None:
    """Write the stiffness matrix; see `write`."""
    _write_matrix(contents, contents.model.stiffness, path)


def write_mass(contents: Contents, path: Path) -> None:
    """Write the mass matrix; see `write`."""
    _write_matrix(contents, contents.model.mass, path)


def _write_matrix(contents: Contents, matrix: np.ndarray, path: Path) -> None:
    places = _places(contents)
    spread = _spread(contents)
    lines = entries(spread.T @ matrix @ spread, places)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _heading(contents: Contents) -> Iterator[str]:
    yield from comment(
        f"""
        Crumpled foil between two rigid rings as a superelement. Units: m, N, kg, s, rad.
        In the deck, before its steps: *INCLUDE, INPUT=superelement.inp, with superelement.stiff
        and superelement.mass in the same folder. It takes a version whose manual has *MATRIX
        ASSEMBLE (2.17 has not); *STATIC, *FREQUENCY and *DYNAMIC; without damping, which a
        substructure cannot have.
        Ring centres: translations 1 to 3 of node {BOTTOM} (bottom) and {TOP} (top), rotations as
        degrees of freedom 1 to 3 of nodes {ROTATIONS[BOTTOM]} and {ROTATIONS[TOP]}. Tie them to
        the structure. Nodes from {INNER} on carry generalised coordinates; leave them alone. The
        rings themselves weigh nothing.
        {expected(contents)}
        """,
        contents.provenance,
    )


def _nodes(contents: Contents) -> Iterator[str]:
    yield "*NODE, NSET=FOIL_ALL"
    for ring, height in zip((BOTTOM, TOP), contents.ring_heights):
        for node in (ring, ROTATIONS[ring]):
            yield f"{node}, 0., 0., {height:.12e}"
        for node, corner in zip(CORNERS[ring], _corners(contents)):
            x, y, z = corner + [0, 0, height]
            yield f"{node}, {x:.12e}, {y:.12e}, {z:.12e}"
    middle = float(np.mean(contents.ring_heights))
    for node in sorted({place.node for place in _places(contents)[18:]}):
        yield f"{node}, 0., 0., {middle:.12e}"


def _element(contents: Contents) -> Iterator[str]:
    files = "STIFFNESS FILE=superelement.stiff, MASS FILE=superelement.mass"
    yield f"*MATRIX ASSEMBLE, NAME=FOIL, {files}"
    for name, ring in (("BOTTOM", BOTTOM), ("TOP", TOP)):
        yield f"*NSET, NSET=FOIL_{name}"
        yield ", ".join(map(str, CORNERS[ring]))
        yield f"*RIGID BODY, NSET=FOIL_{name}, REF NODE={ring}, ROT NODE={ROTATIONS[ring]}"
    last = _places(contents)[-1]
    if last.node >= INNER and last.freedom < 3:
        yield from comment("translations of the last node that carry no coordinate")
        yield from ("*BOUNDARY", f"{last.node}, {last.freedom + 1}, 3")


def _places(contents: Contents) -> list[Place]:
    inner = inner_places(len(contents.model.stiffness) - INTERFACE)
    corners = [
        Place(node, 1 + k) for ring in (BOTTOM, TOP) for node in CORNERS[ring] for k in range(3)
    ]
    count = len({place.node for place in [*corners, *inner]})
    if count > _NODES_MAX:
        raise Refusal(
            f"the reduced model takes {count} nodes, and a substructure of CalculiX may have "
            f"{_NODES_MAX}; reduce it for a lower band (dynamics.shown_max_hz)."
        )
    return corners + inner


def _spread(contents: Contents) -> np.ndarray:
    """Coordinates of the reduced model per translation of the nodes.

    The rigid motion that comes closest to that of three corners: exact where they move as a rigid
    body does.
    """
    turned = np.linalg.pinv(rigid_motion(_corners(contents)).reshape(9, 6))
    inner = len(contents.model.stiffness) - INTERFACE
    out = np.zeros((INTERFACE + inner, 18 + inner))
    out[:6, :9] = out[6:INTERFACE, 9:18] = turned
    out[INTERFACE:, 18:] = np.eye(inner)
    return out


def _corners(contents: Contents) -> np.ndarray:
    """Of a ring about its centre, m, shape (3, 3)."""
    angles = 2 * np.pi * np.arange(3) / 3
    radius = contents.crumple.foil.diameter / 2
    return radius * np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
