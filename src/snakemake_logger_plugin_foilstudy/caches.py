"""A place for caches where the user's home has none: a run needs no home of its own."""

from __future__ import annotations

import os
from pathlib import Path
from tempfile import TemporaryDirectory

__all__ = ["place_for_caches"]


def place_for_caches() -> TemporaryDirectory | None:
    """See that Snakemake, Matplotlib and Numba can write what they keep between runs.

    Returns
    -------
    tempfile.TemporaryDirectory or None
        What stands in for an unusable home, until it is dropped.
    """
    home = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    try:
        Path(home).mkdir(parents=True, exist_ok=True)
        TemporaryDirectory(dir=home).cleanup()
        return None
    except OSError:
        folder = TemporaryDirectory(prefix="foilstudy-caches-", ignore_cleanup_errors=True)
        os.environ["XDG_CACHE_HOME"] = os.environ["MPLCONFIGDIR"] = folder.name
        return folder
