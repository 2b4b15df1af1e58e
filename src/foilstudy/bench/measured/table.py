"""Responses from a table with names and units in its header.

``frequency (Hz)``, then ``magnitude (UNIT)`` with ``phase (deg)``, or ``real (UNIT)`` with
``imag (UNIT)``; perhaps ``deviation (UNIT)`` and ``coherence``. Words before these name one of
several functions: ``transfer axial real (N/m)``. Lines that begin with # are comments.
"""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.registry import did_you_mean
from foilstudy.bench.estimation.estimate import Estimate
from foilstudy.bench.measured.conversion import as_stiffness, unit_named

__all__ = ["read"]

_HEAD = re.compile(r"^(?P<name>.*?)\s*(?:[\[(](?P<unit>.*)[\])])?$")
_PARTS = {
    "real": "real", "re": "real", "imag": "imag", "im": "imag", "magnitude": "magnitude",
    "phase": "phase", "deviation": "deviation", "coherence": "coherence",
}  # fmt: skip
_ANGLES = {"deg": np.pi / 180, "°": np.pi / 180, "rad": 1.0}


def read(path: Path, function: str | None = None) -> Estimate:
    """See `Reader`."""
    heads, columns = _columns(path)
    frequencies, functions = None, {}
    for head, values in zip(heads, columns):
        found = _HEAD.match(head.strip())
        words, unit = found["name"].lower().split(), found["unit"] or ""
        if words == ["frequency"]:
            if unit != "Hz":
                stated = f"is in {unit!r}" if unit else "states no unit"
                raise Refusal(f"{path}: the frequency {stated}; give it in Hz, 'frequency (Hz)'.")
            frequencies = values
        elif words and words[-1] in _PARTS:
            name = " ".join(words[:-1])
            functions.setdefault(name, {})[_PARTS[words[-1]]] = (values, unit)
    if frequencies is None:
        raise Refusal(f"{path}: no column is headed 'frequency (Hz)'; name its columns so.")
    parts = functions[chosen(path, list(functions), function)]
    if "real" in parts and "imag" in parts:
        (real, unit), (imaginary, other) = parts["real"], parts["imag"]
        same = unit == other
        values = real + 1j * imaginary
    elif "magnitude" in parts and "phase" in parts:
        (size, unit), (angle, turn) = parts["magnitude"], parts["phase"]
        if turn not in _ANGLES:
            raise Refusal(f"{path}: the phase is in {turn!r}; give it in deg or rad.")
        same = True
        values = size * np.exp(1j * _ANGLES[turn] * angle)
    else:
        raise Refusal(
            f"{path}: the columns {', '.join(parts) or 'of no response'} are no complex number; "
            "give 'real' and 'imag', or 'magnitude' and 'phase', each with its unit."
        )
    deviation, its_unit = parts.get("deviation", (None, unit))
    if not same or its_unit != unit:
        raise Refusal(f"{path}: parts of one response have different units; write them in one.")
    quantity, size = unit_named(unit, path)
    return as_stiffness(
        path, quantity, frequencies, size * values,
        None if deviation is None else size * deviation, parts.get("coherence", (None, ""))[0],
    )  # fmt: skip


def chosen(path: Path, names: list[str], function: str | None) -> str:
    """The one name that is meant.

    Raises
    ------
    Refusal
        If none or several are.
    """
    wanted = (function or "").lower()
    fits = [name for name in names if wanted in name.lower()]
    exact = [name for name in names if wanted == name.lower()]
    if len(exact) == 1 or len(fits) == 1:
        return (exact or fits)[0]
    if not names:
        raise Refusal(f"{path}: holds no response; see docs/bench.md for how to write one.")
    shown = ", ".join(repr(name) for name in (fits or names)[:6])
    more = "" if len(fits or names) <= 6 else f" and {len(fits or names) - 6} more"
    what = f"{len(fits)} functions fit" if fits else f"no function is called {function!r}"
    if names == [""]:
        raise Refusal(f"{path}: {what}, and its one response has no name; leave --function out.")
    hint = "" if fits else did_you_mean(function or "", names)
    raise Refusal(f"{path}: {what}; {hint}name one of {shown}{more} with --function.")


def _columns(path: Path) -> tuple[list[str], np.ndarray]:
    """Heads and numbers, one row for each column."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise Refusal(f"{path}: is no text in UTF-8; save the table so.") from None
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    if len(lines) < 3:
        raise Refusal(f"{path}: has {len(lines)} lines; a response needs a header and two more.")
    mark = max("\t;,", key=lines[0].count)
    heads, *rows = csv.reader(lines, delimiter=mark)
    numbers = np.empty((len(rows), len(heads)))
    for k, row in enumerate(rows):
        try:
            # where semicolons part the columns, commas may part the decimals
            numbers[k] = [float(x.replace(",", ".") if mark == ";" else x) for x in row]
        except ValueError:
            raise Refusal(
                f"{path}: row {k + 2} holds {mark.join(row)!r}, not {len(heads)} numbers as its "
                "header names; correct it."
            ) from None
    return heads, numbers.T
