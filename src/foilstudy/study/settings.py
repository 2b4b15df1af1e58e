"""Settings of side studies in files of their own; cheap to import."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any, TypeVar

import pydantic

from foilstudy.base.errors import ConfigError
from foilstudy.config.sections import Section
from foilstudy.config.sources import read_file

__all__ = ["content_digest", "read_settings"]

Settings = TypeVar("Settings", bound=Section)


def read_settings(path: Path, kind: type[Settings]) -> Settings:
    """The settings of a kind in a file.

    Raises
    ------
    ConfigError
        If it cannot be read or is of another form.
    """
    try:
        return kind.model_validate(read_file(path))
    except pydantic.ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        where = f"{path}: {place}" if place else str(path)
        raise ConfigError(f"{where}: {first['msg']}; see the entries beside it.") from None


def content_digest(content: Any) -> str:
    """What tells one content from another in a file name."""
    return hashlib.sha256(json.dumps(content).encode()).hexdigest()[:8]
