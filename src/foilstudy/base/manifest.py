"""The manifest of what is shown of results: which files there are, and what they were made of.

Tables, pictures and pages have no room for their origin; a JSON file beside them has.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

from foilstudy.base.files import read_json, write_json
from foilstudy.base.origin import Origin

__all__ = ["MANIFEST", "listed", "noted", "noted_origin", "outdated", "write_manifest"]

MANIFEST = "manifest.json"


def write_manifest(
    folder: Path, origin: Origin, files: Iterable[Path], notes: Mapping[str, Any] | None = None
) -> Path:
    """Put down the origin of files in a folder, the SHA-256 of each, and notes of whoever asks."""
    sums = {path.relative_to(folder).as_posix(): _sum(path) for path in files if path.is_file()}
    write_json(origin.attributes() | {"sha256": sums, **(notes or {})}, folder / MANIFEST)
    return folder / MANIFEST


def noted(folder: Path) -> dict[str, Any]:
    """The manifest of a folder; empty where there is none that can be read."""
    try:
        return dict(read_json(folder / MANIFEST))
    except (OSError, ValueError, TypeError):
        return {}


def noted_origin(folder: Path) -> Origin:
    """The origin in the manifest of a folder; an empty one without a manifest."""
    try:
        return Origin.of(read_json(folder / MANIFEST))
    except (OSError, ValueError, AttributeError):
        return Origin()


def listed(folder: Path) -> list[Path]:
    """The files that the manifest of a folder names; none without a manifest."""
    try:
        return [folder / name for name in read_json(folder / MANIFEST)["sha256"]]
    except (OSError, ValueError, KeyError, TypeError):
        return []


def outdated(folder: Path, origin: Origin, files: Iterable[Path]) -> dict[Path, str]:
    """Those files that are there but not what would be made now, each with the reason.

    The reason is in words that follow the name of the file.
    """
    there = [path for path in files if path.is_file()]
    try:
        manifest = read_json(folder / MANIFEST)
        departure, sums = Origin.of(manifest).departure(origin), dict(manifest["sha256"])
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        departure, sums = "by a run that did not end, or the manifest is damaged", {}
    if departure:
        return dict.fromkeys(there, f"was made {departure}")
    return {
        path: "was changed since it was made"
        for path in there
        if _sum(path) != sums.get(path.relative_to(folder).as_posix())
    }


def _sum(path: Path) -> str:
    return sha256(path.read_bytes()).hexdigest()
