"""Frequency responses as Universal Files: dataset 58, function at nodal DOF.

Structural Dynamics Research Laboratory, University of Cincinnati, Universal File Formats for Modal
Analysis Testing. Nodes 1 and 2 are the centres of the bottom and of the top ring.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import pyuff

from foilstudy.export.contents import Contents
from foilstudy.export.motions import QUANTITIES, Pair, pairs
from foilstudy.measure.dynamics import DEFINITIONS, directional_stiffness
from foilstudy.measure.stiffness.directional import DIRECTIONS

_FREQUENCY_RESPONSE = 4
_COMPLEX_SINGLE = 5
_FREQUENCY = 18
_ID_LENGTH = 80


@dataclass(frozen=True)
class _Axis:
    """Numerator or denominator: specific data type and label.

    Units exponents are the format's own for each type and direction; only a function that belongs
    to no direction has to give them.
    """

    data_type: int
    label: str

    def fields(self, record: str, unit: str) -> dict:
        return {
            f"{record}_spec_data_type": self.data_type,
            f"{record}_axis_lab": self.label,
            f"{record}_axis_units_lab": unit,
        }


_DISPLACEMENT, _FORCE = _Axis(8, "Displacement"), _Axis(13, "Excitation force")
_MOTION = {"receptance": _DISPLACEMENT, "accelerance": _Axis(12, "Acceleration")}
_HELD = {
    "free": "both rings free; node 1 bottom ring centre, node 2 top ring centre",
    "bottom_held": "bottom ring held in all its motions; node 2 top ring centre",
}


def write(contents: Contents, path: Path) -> None:
    """Write force on one motion per another, for all 144 pairs, and the named stiffnesses.

    The named ones (definition and direction) are scalars: node 0, direction 0, as the radial one
    belongs to no single pair.
    """
    sets = [_header(contents), _units(), _nodes(contents)]
    full = contents.dynamic_stiffness
    common = _common(contents) | {
        "id2": "force per motion, all other motions of both rings held",
        "id5": "node 1 bottom ring centre, node 2 top ring centre",
        "x": contents.frequencies,
        "abscissa_spacing": 0,
    }
    for i, j, pair in pairs("free"):
        force, motion = pair.response, pair.reference
        sets.append(
            common
            | _place(pair)
            | _FORCE.fields("ordinate", force.force_unit)
            | _DISPLACEMENT.fields("orddenom", motion.unit)
            | {
                "id1": f"dynamic stiffness: force on {force.name} per motion {motion.name}",
                "data": full[:, i, j],
            }
        )
    directional = directional_stiffness(full)
    nowhere = dict.fromkeys(("rsp_node", "rsp_dir", "ref_node", "ref_dir"), 0)
    exponents = {"ordinate_force_unit_exp": 1, "orddenom_len_unit_exp": 1}
    for d, definition in enumerate(DEFINITIONS):
        for e, direction in enumerate(DIRECTIONS):
            sets.append(
                common
                | nowhere
                | exponents
                | _FORCE.fields("ordinate", "N")
                | _DISPLACEMENT.fields("orddenom", "m")
                | {
                    "id1": f"{definition} {direction} dynamic stiffness",
                    "data": directional[d, e],
                }
            )
    pyuff.UFF(str(path)).write_sets(sets, "overwrite")


def write_motion(contents: Contents, path: Path, *, quantity: str, condition: str) -> None:
    """Write receptance or accelerance of all pairs that move, in single precision."""
    values = contents.motion_per_force(quantity, condition)
    common = _common(contents) | {
        "id2": _HELD[condition],
        "id5": contents.even_grid.words[:_ID_LENGTH],
        "x": contents.even_grid.frequencies,
        "abscissa_spacing": 1,
        "ord_data_type": _COMPLEX_SINGLE,
    }
    sets = [_header(contents), _units(), _nodes(contents)]
    for i, j, pair in pairs(condition):
        unit = pair.response.unit + QUANTITIES[quantity]
        sets.append(
            common
            | _place(pair)
            | _MOTION[quantity].fields("ordinate", unit)
            | _FORCE.fields("orddenom", pair.reference.force_unit)
            | {"id1": f"{quantity}: {pair.text}", "data": values[:, i, j]}
        )
    pyuff.UFF(str(path)).write_sets(sets, "overwrite", force_double=False)


def _header(contents: Contents) -> dict:
    """Which foil, realisation and commit the file is of."""
    origin = contents.provenance
    date, time = (_created(contents) + " NONE").split(" ")[:2]
    return {
        "type": 151,
        "model_name": " ".join(str(contents.crumple.foil).split())[:_ID_LENGTH],  # one line
        "description": f"crumpled, seed {origin.get('seed', 'unknown')}"[:_ID_LENGTH],
        "db_app": f"commit {origin.get('git_commit', 'unknown')}"[:_ID_LENGTH],
        "program": "foilstudy",
        "date_db_created": date, "time_db_created": time,
        "date_db_saved": date, "time_db_saved": time,
        "date_file_written": date, "time_file_written": time,
    }  # fmt: skip


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


def _place(pair: Pair) -> dict:
    response, reference = pair.response, pair.reference
    return {
        "rsp_node": response.node, "rsp_dir": response.direction,
        "ref_node": reference.node, "ref_dir": reference.direction,
    }  # fmt: skip


def _common(contents: Contents) -> dict:
    """What all functions of a file share."""
    return {
        "type": 58,
        "func_type": _FREQUENCY_RESPONSE,
        "binary": 0,
        "id3": _created(contents),
        "id4": str(contents.damping)[:_ID_LENGTH],
        "abscissa_spec_data_type": _FREQUENCY,
        "abscissa_axis_lab": "Frequency",
        "abscissa_axis_units_lab": "Hz",
    }


def _created(contents: Contents) -> str:
    """Date and time as the format wants them."""
    created = contents.provenance.get("created")
    if created is None:
        return "NONE"
    return datetime.fromisoformat(created).strftime("%d-%b-%y %H:%M:%S").upper()
