"""The frequency response as a Universal File: dataset 58, function at nodal DOF.

Structural Dynamics Research Laboratory, University of Cincinnati, Universal File Formats for Modal
Analysis Testing. Nodes 1 and 2 are the centres of the bottom and of the top ring.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyuff

from foilstudy.export.contents import Contents
from foilstudy.measure.dynamics import DEFINITIONS, directional_stiffness
from foilstudy.measure.stiffness import DOF_NAMES
from foilstudy.measure.stiffness.directional import DIRECTIONS

_FREQUENCY_RESPONSE = 4
_FREQUENCY, _DISPLACEMENT, _FORCE = 18, 8, 13
"""Specific data types of an axis."""


def write(contents: Contents, path: Path) -> None:
    """Write force on one motion per another, for all 144 pairs, and the named stiffnesses.

    The named ones (definition and direction) are scalars: node 0, direction 0, as the radial one
    belongs to no single pair.
    """
    file = pyuff.UFF(str(path))
    sets = [_units(), _nodes(contents)]
    full = contents.dynamic_stiffness
    for i, force in enumerate(DOF_NAMES):
        for j, motion in enumerate(DOF_NAMES):
            units = f"{'N' if i % 6 < 3 else 'N m'}/{'m' if j % 6 < 3 else 'rad'}"
            place = {
                "rsp_node": 1 + i // 6, "rsp_dir": 1 + i % 6,
                "ref_node": 1 + j // 6, "ref_dir": 1 + j % 6,
            }  # fmt: skip
            name = f"dynamic stiffness: force on {force} per motion {motion}"
            sets.append(_function(contents, name, units, full[:, i, j]) | place)
    directional = directional_stiffness(full)
    nowhere = dict.fromkeys(("rsp_node", "rsp_dir", "ref_node", "ref_dir"), 0)
    for d, definition in enumerate(DEFINITIONS):
        for e, direction in enumerate(DIRECTIONS):
            name = f"{definition} {direction} dynamic stiffness"
            sets.append(_function(contents, name, "N/m", directional[d, e]) | nowhere)
    file.write_sets(sets, "overwrite")


def _units() -> dict:
    return pyuff.prepare_164(
        units_code=1, units_description="SI: m, N", temp_mode=1,
        length=1.0, force=1.0, temp=1.0, temp_offset=0.0,
    )  # fmt: skip


def _nodes(contents: Contents) -> dict:
    return pyuff.prepare_15(
        node_nums=[1, 2], def_cs=[0, 0], disp_cs=[0, 0], color=[1, 1],
        x=[0.0, 0.0], y=[0.0, 0.0], z=list(contents.ring_heights),
    )  # fmt: skip


def _function(contents: Contents, name: str, units: str, values: np.ndarray) -> dict:
    """One function; where it belongs is added by the caller."""
    return {
        "type": 58,
        "func_type": _FREQUENCY_RESPONSE,
        "binary": 0,
        "id1": name,
        "id2": "force per motion, all other motions of both rings held",
        "id3": contents.provenance.get("created", "NONE")[:80],
        "id4": str(contents.damping)[:80],
        "id5": "node 1 bottom ring centre, node 2 top ring centre",
        "x": contents.frequencies,
        "data": values,
        "abscissa_spacing": 0,
        "abscissa_spec_data_type": _FREQUENCY,
        "abscissa_axis_lab": "Frequency",
        "abscissa_axis_units_lab": "Hz",
        "ordinate_spec_data_type": _FORCE,
        "ordinate_axis_lab": "Dynamic stiffness",
        "ordinate_axis_units_lab": units,
        "orddenom_spec_data_type": _DISPLACEMENT,
    }
