"""Responses from a Universal File: dataset 58, its units from dataset 164 or its axis labels."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.bench.estimation.estimate import Estimate
from foilstudy.bench.measured.conversion import QUANTITIES, Quantity, as_stiffness, unit_named
from foilstudy.bench.measured.table import chosen

__all__ = ["datasets", "read"]

_FREQUENCY_RESPONSE = 4
_DISPLACEMENT, _ACCELERATION, _FORCE = 8, 12, 13
_KINDS = {
    (_FORCE, _DISPLACEMENT): QUANTITIES[0],
    (_DISPLACEMENT, _FORCE): QUANTITIES[1],
    (_ACCELERATION, _FORCE): QUANTITIES[2],
}
"""Quantities by the data types of ordinate and its denominator."""


def read(path: Path, function: str | None = None) -> Estimate:
    """See `Reader`; a function is named by its first ID line."""
    sets, units = datasets(path)
    sets = [each for each in sets if each["func_type"] == _FREQUENCY_RESPONSE]
    names = [each["id1"].strip() for each in sets]
    wanted = chosen(path, list(dict.fromkeys(names)), function)
    if names.count(wanted) > 1:
        raise Refusal(
            f"{path}: {names.count(wanted)} functions are called {wanted!r}; export one of them."
        )
    found = sets[names.index(wanted)]
    types = found["ordinate_spec_data_type"], found["orddenom_spec_data_type"]
    if types not in _KINDS:
        raise Refusal(
            f"{path}: {wanted!r} has data types {types[0]} over {types[1]}; export force over "
            "displacement (13 over 8), displacement (8) or acceleration (12) over force (13)."
        )
    quantity = _KINDS[types]
    size = _size(path, quantity, found, units)
    return as_stiffness(path, quantity, found["x"], size * np.asarray(found["data"]))


def datasets(path: Path) -> tuple[list[dict], list[dict]]:
    """Functions (dataset 58) and units (dataset 164) of a Universal File.

    Raises
    ------
    Refusal
        If it cannot be read.
    """
    import pyuff

    try:
        file = pyuff.UFF(str(path))
        kinds = np.atleast_1d(file.get_set_types())
        functions, units = (
            [file.read_sets(int(k)) for k in np.flatnonzero(kinds == kind)] for kind in (58, 164)
        )
    except Exception as error:  # pyuff raises plain ones
        raise Refusal(
            f"{path}: cannot be read as a Universal File ({error}); export it anew."
        ) from None
    return functions, units


def _size(path: Path, quantity: Quantity, found: dict, units: list[dict]) -> float:
    """Of the unit of the values, in SI."""
    if units:
        length, force = units[0]["length"], units[0]["force"]  # factors from SI
        return force / length if quantity.inverse else length / force
    labels = [found[f"{each}_axis_units_lab"].strip() for each in ("ordinate", "orddenom")]
    if any(label in ("", "NONE") for label in labels):
        raise Refusal(
            f"{path}: states no units, neither in a dataset 164 nor on its axes; export it "
            "with them."
        )
    kind, size = unit_named("/".join(labels), path)
    if kind != quantity:
        raise Refusal(
            f"{path}: its data types say {quantity.name}, its units {kind.name}; correct one."
        )
    return size
