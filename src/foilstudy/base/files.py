"""Files that appear only when they are complete."""

from __future__ import annotations

import errno
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np


@contextmanager
def written_whole(path: str | Path) -> Iterator[Path]:
    """Give a file beside `path` to write, and move it to `path` when that has succeeded.

    Parameters
    ----------
    path : str or Path
        Its folder is made if need be.

    Raises
    ------
    OSError
        Also where the NetCDF library says no more than that it could not write.
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    # a name of its own: a killed run may have left, or may still write, another
    partial = path.with_name(f".{path.name}.{os.getpid()}.partial")
    try:
        yield partial
        os.replace(partial, path)
    except RuntimeError as error:
        if not str(error).startswith("NetCDF: "):
            raise
        what = f"cannot be written ({error}), as on a full disk"
        raise OSError(errno.EIO, what, str(path)) from error
    finally:
        partial.unlink(missing_ok=True)


def write_json(record: dict | list[dict], path: str | Path) -> None:
    """Write a record as JSON; arrays become lists, numbers that are not finite null."""
    with written_whole(path) as partial:
        partial.write_text(json_text(record), encoding="utf-8")


def json_text(record: dict | list[dict]) -> str:
    """A record as JSON; arrays become lists, numbers that are not finite null."""
    return json.dumps(_plain(record), indent=1, allow_nan=False) + "\n"


def read_json(path: str | Path) -> dict | list[dict]:
    """What `write_json` has written; null is None for single numbers, NaN in lists."""
    return read_json_text(Path(path).read_text("utf-8"))


def read_json_text(text: str) -> dict | list[dict]:
    """What `json_text` has made."""
    return json.loads(text, object_hook=_arrays)


def _plain(value):
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float) and not np.isfinite(value):
        return None
    return value


def _arrays(record: dict) -> dict:
    return {
        key: np.array(value, float) if isinstance(value, list) and _numeric(value) else value
        for key, value in record.items()
    }


def _numeric(value: list) -> bool:
    return all(item is None or isinstance(item, int | float) for item in value)
