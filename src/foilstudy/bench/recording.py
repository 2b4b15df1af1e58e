"""Time signals of several channels: in memory or on disk, read piece by piece, and watched."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_number

__all__ = [
    "Channel",
    "FileRecording",
    "MemoryRecording",
    "Recording",
    "Watched",
    "open_recording",
    "write_recording",
]

ACCELERATION, FORCE = "m/s^2", "N"
UNITS = (ACCELERATION, FORCE)
BODIES = ("base", "metrology")
GRAVITY = 9.80665
"""m/s^2."""
PIECE = 1 << 16
"""Samples that are held at once where all of a recording is gone through."""

_CONVENTION = "foilstudy recording 1"
_CLIPPED = 0.999
"""Share of the full scale at which a sample counts as clipped."""


@dataclass(frozen=True)
class Channel:
    """One sensor axis.

    Attributes
    ----------
    name : str
    unit : str
        ``m/s^2`` or ``N``.
    body : str
        What it is fixed to: ``base`` (below the foil, shaken) or ``metrology`` (above it).
    position : tuple of float
        m; the foil's lower ring has its centre at the origin, its axis is z.
    direction : tuple of float
        Unit vector along which it is positive.
    full_scale : float
        Largest value that it can show, in its unit.
    """

    name: str
    unit: str
    body: str
    position: tuple[float, float, float]
    direction: tuple[float, float, float]
    full_scale: float = float("inf")

    def __post_init__(self) -> None:
        if self.unit not in UNITS:
            raise Refusal(
                f"channel {self.name} has the unit {self.unit!r}; convert it to one of "
                f"{', '.join(UNITS)}."
            )
        if self.body not in BODIES:
            raise Refusal(
                f"channel {self.name} is on {self.body!r}; say which of {', '.join(BODIES)}."
            )
        length = float(np.linalg.norm(self.direction))
        if len(self.position) != 3 or not abs(length - 1) < 1e-6:
            raise Refusal(
                f"channel {self.name} needs three coordinates and a direction of length 1, not "
                f"{length:g}."
            )


class Recording(Protocol):
    """Channels sampled together."""

    channels: tuple[Channel, ...]
    rate_hz: float
    samples: int

    def read(self, start: int, stop: int) -> np.ndarray:
        """Samples from start to before stop of all channels, shape (channels, stop - start)."""
        ...


@dataclass(frozen=True, eq=False)
class MemoryRecording:
    """Signals that are at hand, shape (channels, samples)."""

    channels: tuple[Channel, ...]
    rate_hz: float
    values: np.ndarray

    def __post_init__(self) -> None:
        require_number("sampling rate", self.rate_hz, "Hz", above=0)
        if self.values.ndim != 2 or len(self.values) != len(self.channels):
            raise Refusal(
                f"{len(self.channels)} channels need as many rows of samples, not an array of "
                f"shape {self.values.shape}."
            )

    @property
    def samples(self) -> int:
        """Samples of a channel."""
        return self.values.shape[1]

    def read(self, start: int, stop: int) -> np.ndarray:
        """See `Recording`."""
        return self.values[:, start:stop]


class FileRecording:
    """Signals in a NetCDF file, of which only the piece that is asked for is read.

    Attributes
    ----------
    path : Path
    channels, rate_hz, samples
        See `Recording`.
    """

    def __init__(self, path: Path) -> None:
        import netCDF4

        from foilstudy.base.record import UNREADABLE

        self.path = path
        try:
            self._file = netCDF4.Dataset(path)
        except UNREADABLE as error:
            reason = getattr(error, "strerror", None) or str(error)
            raise Refusal(f"{path}: cannot be read as NetCDF ({reason}); check the path.") from None
        if getattr(self._file, "Conventions", None) != _CONVENTION:
            self._file.close()
            raise Refusal(
                f"{path}: is no recording of foilstudy; write one with "
                "foilstudy.bench.recording.write_recording."
            )
        self._file.set_auto_mask(False)
        rows = json.loads(self._file.channels)
        self.channels = tuple(
            Channel(
                **row | {name: tuple(row[name]) for name in ("position", "direction")}
                | ({"full_scale": float("inf")} if row["full_scale"] is None else {})
            )
            for row in rows
        )  # fmt: skip
        self.rate_hz = float(self._file.rate_hz)
        self.samples = len(self._file.dimensions["sample"])

    def __repr__(self) -> str:
        return (
            f"<FileRecording: {self.path}, {len(self.channels)} channels, "
            f"{self.samples / self.rate_hz:g} s at {self.rate_hz:g} Hz>"
        )

    def read(self, start: int, stop: int) -> np.ndarray:
        """See `Recording`."""
        return self._file["signal"][:, start:stop]

    def close(self) -> None:
        """Let go of the file."""
        self._file.close()

    def __enter__(self) -> FileRecording:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def open_recording(path: str | Path) -> FileRecording:
    """A recording that `write_recording` has written.

    Raises
    ------
    Refusal
        If the file cannot be read or is none.
    """
    return FileRecording(Path(path))


def write_recording(recording: Recording, path: str | Path) -> None:
    """Write a recording as NetCDF, piece by piece in single precision."""
    import netCDF4

    from foilstudy.base.files import written_whole

    rows = [
        asdict(each) | ({"full_scale": None} if np.isinf(each.full_scale) else {})
        for each in recording.channels
    ]
    with written_whole(path) as partial, netCDF4.Dataset(partial, "w", format="NETCDF4") as file:
        file.Conventions, file.rate_hz = _CONVENTION, recording.rate_hz
        file.channels = json.dumps(rows, allow_nan=False)
        file.createDimension("channel", len(rows))
        file.createDimension("sample", recording.samples)
        chunks = (len(rows), min(PIECE, recording.samples))
        signal = file.createVariable("signal", "f4", ("channel", "sample"), chunksizes=chunks)
        signal.long_name, signal.units = "time signals", "of each channel, see attribute channels"
        for start, stop in pieces(recording.samples):
            signal[:, start:stop] = recording.read(start, stop)


def pieces(samples: int, length: int = PIECE) -> Iterator[tuple[int, int]]:
    """Start and end of consecutive pieces."""
    for start in range(0, samples, length):
        yield start, min(start + length, samples)


class Watched:
    """A recording that notes what passes: extremes of each channel, and numbers that are none.

    Parameters
    ----------
    recording : Recording
    """

    def __init__(self, recording: Recording) -> None:
        self._recording = recording
        self.channels, self.rate_hz = recording.channels, recording.rate_hz
        self.samples = recording.samples
        self._least = np.full(len(self.channels), np.inf)
        self._most = np.full(len(self.channels), -np.inf)
        self._finite = np.ones(len(self.channels), dtype=bool)

    def read(self, start: int, stop: int) -> np.ndarray:
        """See `Recording`."""
        values = self._recording.read(start, stop)
        least, most = values.min(axis=1), values.max(axis=1)  # not a number if one of them is
        self._finite &= np.isfinite(least) & np.isfinite(most)
        np.fmin(self._least, least, out=self._least)
        np.fmax(self._most, most, out=self._most)
        return values

    def require_sound(self) -> None:
        """Refuse what has passed if a channel is dead, clipped, or not finite.

        Raises
        ------
        Refusal
            Naming the channels.
        """
        if bad := self._named(~self._finite):
            raise Refusal(f"channel {bad} holds samples that are no finite numbers; record anew.")
        if bad := self._named(self._least == self._most):
            raise Refusal(
                f"channel {bad} shows one constant value; check its cable or leave it out."
            )
        scales = np.array([each.full_scale for each in self.channels])
        largest = np.maximum(np.abs(self._least), np.abs(self._most))
        if bad := self._named(largest >= _CLIPPED * scales):
            raise Refusal(
                f"channel {bad} reaches its full scale, so that it is clipped; lower the "
                "excitation or its gain."
            )

    def _named(self, which: np.ndarray) -> str:
        return ", ".join(each.name for each, bad in zip(self.channels, which) if bad)
