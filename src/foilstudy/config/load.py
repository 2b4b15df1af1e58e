"""Read a study configuration and say clearly what is wrong with it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from foilstudy.base.errors import ConfigError

from .model import StudyConfig
from .sentences import MINIMAL, sentences
from .sources import merged, named, read_file, read_word

__all__ = ["load_config", "load_merged"]

PROBLEMS_MAX = 10
CHARACTERS_MAX = 1000
"""Of all sentences but the last, without the names of the files before them."""


def load_config(source: str | Path | Mapping[str, Any]) -> StudyConfig:
    """Read and validate the configuration of a study.

    Parameters
    ----------
    source : str, pathlib.Path or mapping
        Path of a YAML file, or the content of one.

    Returns
    -------
    StudyConfig
        Complete configuration, defaults filled in.

    Raises
    ------
    ConfigError
        If the configuration cannot be run; one sentence per problem, with key path and remedy.
    """
    if isinstance(source, Mapping):
        return _validated(source)
    if not isinstance(source, str | Path):
        raise ConfigError(
            f"A configuration cannot be read from a {type(source).__name__}; "
            "pass the path of a YAML file, or a mapping."
        )
    return load_merged([source])


def load_merged(files: Sequence[str | Path], words: Iterable[str] = ()) -> StudyConfig:
    """Read and validate a configuration that is written in several places.

    Parameters
    ----------
    files : sequence of str or pathlib.Path
        YAML files; keys of a later one replace those of earlier ones.
    words : iterable of str
        Such as ``sweep={realisations: 2}``, over all files.

    Raises
    ------
    ConfigError
        As of `load_config`.
    """
    words = list(words)
    contents = [*(read_file(Path(file)) for file in files), *map(read_word, words)]
    try:
        return _validated(merged(contents))
    except ConfigError as error:
        places = [*map(str, files), *(["--config"] if words else [])]
        raise named(", ".join(places), error) from None


def _validated(content: Mapping[str, Any]) -> StudyConfig:
    if not content:
        raise ConfigError(f"the configuration is empty; give at least {MINIMAL}.")
    try:
        return StudyConfig.model_validate(dict(content))
    except ValidationError as error:
        raise ConfigError(*_first_of(error)) from None


def _first_of(error: ValidationError) -> Iterator[str]:
    """As many of the sentences as a reader can take in."""
    makers, seen = sentences(error), dict[str, None]()
    for done, maker in enumerate(makers):
        if len(seen) == PROBLEMS_MAX or sum(map(len, seen)) > CHARACTERS_MAX:
            left = len(makers) - done
            yield from seen
            yield f"There are {left} more problems; correct these first, then try again."
            return
        seen[maker()] = None
    yield from seen
