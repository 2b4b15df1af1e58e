"""Read a study configuration and say clearly what is wrong with it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from foilstudy.base.errors import ConfigError

from .model import StudyConfig
from .sentences import MINIMAL, describe, sentences

__all__ = ["load_config"]


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
        return _validate(source)
    if not isinstance(source, str | Path):
        raise ConfigError(
            f"A configuration cannot be read from a {type(source).__name__}; "
            "pass the path of a YAML file, or a mapping."
        )
    try:
        return _validate(_read_file(Path(source)))
    except ConfigError as error:
        raise ConfigError(*(f"{source}: {problem}" for problem in error.problems)) from None


def _read_file(path: Path) -> Any:
    from ._yaml import read_yaml  # jobs that only read a task need no YAML

    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise ConfigError("there is no such file; check the path.") from None
    except IsADirectoryError:
        raise ConfigError("this is a folder; give the path of a YAML file in it.") from None
    except UnicodeDecodeError:
        raise ConfigError("this is not a text file; save it as UTF-8.") from None
    except ValueError:
        raise ConfigError("this is not a path; check it.") from None
    except OSError as error:
        raise ConfigError(
            f"the file cannot be read ({error.strerror}); check its permissions."
        ) from None
    return read_yaml(text)


def _validate(content: Any) -> StudyConfig:
    if content is None or content == {}:
        raise ConfigError(f"the configuration is empty; give at least {MINIMAL}.")
    if not isinstance(content, Mapping):
        raise ConfigError(
            f"the top level is {describe(content)}, not a mapping of sections; start with "
            "lines such as 'study:' and 'sweep:'."
        )
    try:
        return StudyConfig.model_validate(dict(content))
    except ValidationError as error:
        raise ConfigError(*dict.fromkeys(sentences(error))) from None
