"""What each channel is: a table ``name, body, x_m, y_m, z_m, along_x, along_y, along_z,
full_scale``.

``body`` is base (below the foil, shaken) or metrology (above it); the foil's lower ring has its
centre at the origin and its axis is z; the direction has length 1; ``full_scale`` is the largest
value that the sensor can show, in the unit of its signal, and empty where it is not known.
"""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.files import written_whole
from foilstudy.base.registry import did_you_mean
from foilstudy.bench.recording import Channel, MemoryRecording
from foilstudy.bench.signal_files.signals import Signals, sized

__all__ = ["Role", "as_recording", "read_roles", "roles_beside", "write_roles"]

_NUMBERS = ("x_m", "y_m", "z_m", "along_x", "along_y", "along_z")
_COLUMNS = ("name", "body", *_NUMBERS, "full_scale")
_FLAT_COUNT, _FLAT_RATIO = 10, 4
"""Samples at one extreme value that make a flat top, and how many times as many as at the next
value they have to be. A sine in coarse steps has at most 2.4 times as many in its last one."""


@dataclass(frozen=True)
class Role:
    """A row of the table; the full scale is infinite where it is not known."""

    name: str
    body: str
    position: tuple[float, float, float]
    direction: tuple[float, float, float]
    full_scale: float


def roles_beside(path: Path) -> Path:
    """The table of channels that belongs to a file of signals.

    Raises
    ------
    Refusal
        If there is none.
    """
    places = path.with_suffix(".channels.csv"), path.with_name("channels.csv")
    for place in places:
        if place.is_file():
            return place
    raise Refusal(
        f"{path}: neither {places[0].name} nor {places[1].name} beside it says what the channels "
        f"are; write one with the columns {', '.join(_COLUMNS)}."
    )


def read_roles(path: Path) -> tuple[Role, ...]:
    """Read a table of channels.

    Raises
    ------
    Refusal
        If it cannot be read, lacks a column, or a row holds other than numbers.
    """
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "no text in UTF-8"
        raise Refusal(f"{path}: cannot be read ({reason}); save it anew.") from None
    rows = list(csv.DictReader(line for line in lines if line.strip() and line[0] != "#"))
    if not rows or not set(rows[0]) >= set(_COLUMNS):
        there = ", ".join(map(str, rows[0])) if rows else "nothing"
        raise Refusal(f"{path}: has {there}; give a row a channel with {', '.join(_COLUMNS)}.")
    roles = tuple(_role(path, row) for row in rows)
    names = [role.name for role in roles]
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise Refusal(f"{path}: {', '.join(twice)} stands there twice; give each channel one row.")
    return roles


def _role(path: Path, row: dict[str, str]) -> Role:
    name = (row["name"] or "").strip()
    try:
        numbers = [float(row[each]) for each in _NUMBERS]
        full = float(row["full_scale"]) if (row["full_scale"] or "").strip() else np.inf
    except (TypeError, ValueError):
        raise Refusal(
            f"{path}: the row of {name or 'a channel without name'} holds other than numbers in "
            f"{', '.join(_NUMBERS)} or full_scale; correct it."
        ) from None
    return Role(name, (row["body"] or "").strip(), tuple(numbers[:3]), tuple(numbers[3:]), full)


def write_roles(channels: Sequence[Channel], path: Path) -> None:
    """Write the table of a recording's channels."""
    with written_whole(path) as partial, partial.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(_COLUMNS)
        for each in channels:
            full = repr(float(each.full_scale)) if np.isfinite(each.full_scale) else ""
            numbers = (repr(float(x)) for x in (*each.position, *each.direction))
            writer.writerow([each.name, each.body, *numbers, full])


def as_recording(path: Path, signals: Signals, roles: Sequence[Role]) -> MemoryRecording:
    """The signals that the table names, in its order, in SI units.

    Raises
    ------
    Refusal
        If one of them is not there, or is clipped or not finite.
    """
    channels, rows = [], []
    for role in roles:
        if role.name not in signals.names:
            hint = did_you_mean(role.name, signals.names)
            raise Refusal(
                f"{path}: its table of channels names {role.name}, which is not in it; {hint}it "
                f"has {', '.join(signals.names)}."
            )
        at = signals.names.index(role.name)
        unit, size = sized(path, role.name, signals.units[at])
        channels.append(
            Channel(
                role.name, unit, role.body, role.position, role.direction, size * role.full_scale
            )
        )
        rows.append(signals.values[at] if size == 1 else size * signals.values[at])
        _require_sound(path, role.name, rows[-1])
    return MemoryRecording(tuple(channels), signals.rate_hz, np.array(rows))


def _require_sound(path: Path, name: str, values: np.ndarray) -> None:
    if not np.isfinite(values).all():
        raise Refusal(
            f"{path}: channel {name} has samples that are no finite numbers; record anew."
        )
    for extreme, values_ in ((values.max(), values), (-values.min(), -values)):
        count, rest = int(np.sum(values_ == extreme)), values_[values_ < extreme]
        if count < _FLAT_COUNT or not rest.size:
            continue  # a channel that shows one value is refused where it is processed
        if count > _FLAT_RATIO * int(np.sum(rest == rest.max())):
            raise Refusal(
                f"{path}: channel {name} shows its extreme value {count} times, as a sensor does "
                "that is saturated or clipped; lower the excitation or its gain."
            )
