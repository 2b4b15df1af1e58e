"""Measured responses from files, as dynamic stiffness: one file per format.

A reader takes a path and the name of a function in it, and gives an `Estimate`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Protocol

from foilstudy.base.errors import Refusal
from foilstudy.base.registry import Choice, Registry
from foilstudy.bench.estimation.estimate import Estimate

__all__ = ["READERS", "Reader", "read_response"]


class Reader(Protocol):
    """Reads one response of a file.

    Parameters
    ----------
    path : Path
    function : str or None
        Which one, part of its name; needed only where a file holds several.

    Raises
    ------
    Refusal
        If the file cannot be read, its units are not known, or the function is not in it.
    """

    def __call__(self, path: Path, function: str | None) -> Estimate: ...


READERS = Registry(
    "format of measured responses",
    {
        "csv": Choice("bench.measured.table:read", "table with units in its header"),
        "mat": Choice("bench.measured.matlab:read", "MATLAB variables"),
        "uff": Choice("bench.measured.universal:read", "Universal File, dataset 58"),
        "unv": Choice("bench.measured.universal:read", "the same under its other name"),
    },
)


def read_response(path: str | Path, function: str | None = None) -> Estimate:
    """The dynamic stiffness in a file, by the end of its name.

    Parameters
    ----------
    path : str or Path
    function : str, optional
        Part of the name of the function wanted, where the file holds several.

    Raises
    ------
    Refusal
        As `Reader`.
    """
    path = Path(path)
    if not path.is_file():
        raise Refusal(f"{path}: there is no such file; correct the path.")
    kind = path.suffix.lower().removeprefix(".")
    if kind not in READERS:
        known = ", ".join(f".{name}" for name in READERS)
        raise Refusal(f"{path}: measured responses are read from {known}; convert the file.")
    return READERS[kind](path, function)
