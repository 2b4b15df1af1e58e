"""Where a configuration comes from: files, and words KEY=VALUE of a command line over them."""

from __future__ import annotations

import stat
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from foilstudy.base.errors import ConfigError

from .model import StudyConfig
from .sentences import MINIMAL, describe, shown

__all__ = ["merged", "named", "read_file", "read_word"]

BYTES_MAX = 64 * 1024
"""Of a file: thirty times a long configuration, and read within a second."""
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")


def named(source: str, error: ConfigError) -> ConfigError:
    """The same problems, each with the source that it was found in."""
    place = source if source.isprintable() else repr(source)
    return ConfigError(*(f"{place}: {problem}" for problem in error.problems))


def read_file(path: Path) -> dict[str, Any]:
    """Content of a YAML or JSON file.

    Raises
    ------
    ConfigError
        If it cannot be read, or is no mapping of sections.
    """
    try:
        return _sections_of(_text_of(path))
    except ConfigError as error:
        raise named(str(path), error) from None


def read_word(word: str) -> dict[str, Any]:
    """Content of a word such as ``sweep={realisations: 2}`` or ``accuracy=quick``.

    Raises
    ------
    ConfigError
        If it is none, or names neither a section nor a key outside them.
    """
    from ._yaml import read_yaml  # jobs that only read a task need no YAML

    key, equals, value = word.partition("=")
    place = f"--config {key}"
    if not equals or key not in StudyConfig.model_fields:
        section, dot, name = key.partition(".")
        known = dot and equals and section in StudyConfig.sections()
        example = f"{section}={{{name}: {value}}}" if known else "sweep={realisations: 2}"
        raise ConfigError(
            f"{shown(place)}: this is not SECTION={{KEY: VALUE}}; write such as "
            f'--config "{shown(example)}".'
        )
    try:
        content = read_yaml(value)
    except ConfigError as error:
        raise named(place, error) from None
    if not isinstance(content, Mapping) and key in StudyConfig.sections():
        raise ConfigError(
            f"{place}: {key} is {describe(content)}, not a section; write its keys such as "
            f'--config "{key}={{{next(iter(_keys_of(key)))}: VALUE}}".'
        )
    return {key: content}


def merged(contents: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """One content, in which keys of a later one replace those of an earlier one."""
    whole: dict[str, Any] = {}
    for content in contents:
        for key, value in content.items():
            old = whole.get(key)
            both = isinstance(old, Mapping) and isinstance(value, Mapping)
            whole[key] = {**old, **value} if both else value
    return whole


def _keys_of(section: str) -> Iterable[str]:
    return StudyConfig.sections()[section].model_fields


def _text_of(path: Path) -> str:
    data = _bytes_of(path)
    if len(data) > BYTES_MAX:
        raise ConfigError(
            f"the file is larger than {BYTES_MAX // 1024} kB, which no configuration is; check the "
            "path, or write fewer values."
        )
    if data.startswith(_UTF_16):
        raise ConfigError("this is a text in UTF-16; save it as UTF-8.")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise ConfigError(
            f"line {line}: this is not a text file in UTF-8; save it as UTF-8."
        ) from None


def _bytes_of(path: Path) -> bytes:
    try:
        kind = path.stat().st_mode
        if stat.S_ISDIR(kind):
            raise ConfigError("this is a folder; give the path of a YAML file in it.")
        if not stat.S_ISREG(kind):
            raise ConfigError(
                "this is a pipe or a device, which cannot be read twice; give the path of a file."
            )
        with path.open("rb") as file:
            return file.read(BYTES_MAX + 1)
    except FileNotFoundError:
        link = path.is_symlink()
        raise ConfigError(
            "this is a link to a file that is not there; check where it leads."
            if link
            else "there is no such file; check the path."
        ) from None
    except NotADirectoryError:
        raise ConfigError("there is no such file; check the path.") from None
    except OSError as error:
        raise ConfigError(
            f"the file cannot be read ({error.strerror}); check its path and permissions."
        ) from None


def _sections_of(text: str) -> dict[str, Any]:
    from ._yaml import read_yaml  # jobs that only read a task need no YAML

    content = read_yaml(text)
    if content is None:
        raise ConfigError(f"the configuration is empty; give at least {MINIMAL}.")
    if not isinstance(content, Mapping):
        raise ConfigError(
            f"the top level is {describe(content)}, not a mapping of sections; start with "
            "lines such as 'study:' and 'sweep:'."
        )
    return dict(content)
