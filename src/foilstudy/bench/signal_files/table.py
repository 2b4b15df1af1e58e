"""Time signals in a table: ``time (s)``, then ``NAME (UNIT)`` for each channel."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.files import written_whole
from foilstudy.bench.signal_files.signals import Signals, even_rate

__all__ = ["FORMAT"]

_HEAD = re.compile(r"^\s*(?P<name>.*?)\s*[\[(](?P<unit>.*)[\])]\s*$")


class _Table:
    """See `SignalFormat`."""

    def read(self, path: Path) -> Signals:
        heads, values = _columns(path)
        found = [_HEAD.match(head) for head in heads]
        if found[0] is None or (found[0]["name"].lower(), found[0]["unit"]) != ("time", "s"):
            raise Refusal(f"{path}: its first column is headed {heads[0]!r}; give 'time (s)'.")
        if bare := [head for head, match in zip(heads, found) if match is None]:
            raise Refusal(
                f"{path}: the column {bare[0]!r} states no unit; head each with NAME (UNIT)."
            )
        names, units = zip(*((match["name"], match["unit"]) for match in found[1:]))
        return Signals(names, units, even_rate(path, values[0]), values[1:])

    def write(self, signals: Signals, path: Path) -> None:
        heads = [f"{name} ({unit})" for name, unit in zip(signals.names, signals.units)]
        times = np.arange(signals.values.shape[1]) / signals.rate_hz
        with written_whole(path) as partial, partial.open("w", encoding="utf-8") as file:
            file.write(",".join(["time (s)", *heads]) + "\n")
            for row in np.vstack([times, signals.values]).T.tolist():
                file.write(",".join(map(repr, row)) + "\n")


FORMAT = _Table()


def _columns(path: Path) -> tuple[list[str], np.ndarray]:
    """Heads and numbers, shape (columns, rows)."""
    try:
        with path.open(encoding="utf-8-sig") as file:
            head = next((line for line in file if line.strip() and line[0] != "#"), "")
            heads = [each.strip().strip('"') for each in head.split(",")]
            values = np.loadtxt(file, delimiter=",", comments="#", ndmin=2)
    except UnicodeDecodeError:
        raise Refusal(f"{path}: is no text in UTF-8; save the table so.") from None
    except ValueError as error:
        raise Refusal(f"{path}: holds other than numbers ({error}); correct it.") from None
    if len(heads) < 2 or values.shape[0] < 2 or values.shape[1] != len(heads):
        raise Refusal(
            f"{path}: {len(heads)} heads and {values.shape[0]} rows of {values.shape[1]} numbers "
            "are no table of signals; give 'time (s)' and one column a channel, parted by commas."
        )
    return heads, np.ascontiguousarray(values.T)
