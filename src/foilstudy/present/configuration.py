"""The configuration that a cube carries."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType
from typing import Any

from foilstudy.base.errors import ConfigError
from foilstudy.config import Isolation, StudyConfig, load_config
from foilstudy.model.materials import Material


def configuration(cube) -> Mapping[str, Any]:
    """Sections of the study's configuration, read once for all who ask.

    Parameters
    ----------
    cube : xarray.Dataset
        Its attribute ``config`` holds them as YAML.

    Returns
    -------
    mapping
        The cube of an older release lacks the sections and keys of which that knew nothing.
    """
    return _parsed(cube.attrs.get("config", ""))


@lru_cache(maxsize=4)
def _parsed(text: str) -> Mapping[str, Any]:
    import yaml

    return MappingProxyType(yaml.safe_load(text) or {})


def study_of(cube) -> StudyConfig | None:
    """The whole study; None where its configuration is no longer valid."""
    try:
        return load_config(configuration(cube))
    except ConfigError:
        return None


def isolation_options(cube) -> Isolation:
    """Section ``isolation`` of the study; its defaults where the configuration has none."""
    return Isolation.model_validate(configuration(cube).get("isolation", {}))


def material(cube) -> Material | None:
    """Material of the foil in SI units; None where the configuration does not tell it in full."""
    from pydantic import ValidationError

    from foilstudy.config.foils import material_of
    from foilstudy.config.sections import Material as Section

    section = configuration(cube).get("material")
    try:
        return None if section is None else material_of(Section.model_validate(section))
    except ValidationError:
        return None
