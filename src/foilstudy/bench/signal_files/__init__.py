"""Time signals in the files of other tools, as recordings: one file per format.

The signals with their units stand in the file; what each sensor is fixed to, where and along what,
stands in a table of channels beside it (`roles`).
"""

from __future__ import annotations

from pathlib import Path

from foilstudy.base.errors import Refusal
from foilstudy.base.registry import Choice, Registry
from foilstudy.bench.recording import MemoryRecording, Recording
from foilstudy.bench.signal_files.roles import as_recording, read_roles, roles_beside, write_roles
from foilstudy.bench.signal_files.signals import Signals

__all__ = ["SIGNAL_FORMATS", "read_signals", "write_signals"]

SIGNAL_FORMATS = Registry(
    "format of time signals",
    {
        "csv": Choice("bench.signal_files.table:FORMAT", "table with units in its header"),
        "mat": Choice("bench.signal_files.matlab:FORMAT", "MATLAB variables"),
        "uff": Choice("bench.signal_files.universal:FORMAT", "Universal File, dataset 58 or 58b"),
        "unv": Choice("bench.signal_files.universal:FORMAT", "the same under its other name"),
    },
)
"""Objects of the protocol `SignalFormat`."""


def read_signals(path: str | Path, channels: str | Path | None = None) -> MemoryRecording:
    """A recording from a file of another tool, by the end of its name.

    Parameters
    ----------
    path : str or Path
        Signals that the table of channels does not name are left out.
    channels : str or Path, optional
        Table of channels; else ``STEM.channels.csv`` or ``channels.csv`` beside the signals.

    Raises
    ------
    Refusal
        If a file cannot be read, a unit is no acceleration or force, a channel is missing, clipped
        or not finite, or the channels were not sampled together.
    """
    path = Path(path)
    if not path.is_file():
        raise Refusal(f"{path}: there is no such file; correct the path.")
    found = SIGNAL_FORMATS[_kind(path)].read(path)
    roles = read_roles(Path(channels) if channels else roles_beside(path))
    return as_recording(path, found, roles)


def write_signals(recording: Recording, path: str | Path) -> None:
    """Write a recording in the format that the end of a name says, and its channels beside it.

    All of it is in memory meanwhile; `write_recording` writes long ones piece by piece.
    """
    path = Path(path)
    values = recording.read(0, recording.samples)
    names, units = zip(*((each.name, each.unit) for each in recording.channels))
    SIGNAL_FORMATS[_kind(path)].write(Signals(names, units, recording.rate_hz, values), path)
    write_roles(recording.channels, path.with_suffix(".channels.csv"))


def _kind(path: Path) -> str:
    kind = path.suffix.lower().removeprefix(".")
    if kind not in SIGNAL_FORMATS:
        known = ", ".join(f".{name}" for name in SIGNAL_FORMATS)
        raise Refusal(f"{path}: time signals are exchanged as {known}; convert the file.")
    return kind
