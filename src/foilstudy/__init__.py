"""Stiffness of crumpled foil cylinders: crumple, measure, gather, fit, report.

Heavy modules load on first use, so that ``import foilstudy`` stays cheap.
"""

from importlib import import_module

_LAZY = {
    "ConfigError": "foilstudy.config",
    "StudyConfig": "foilstudy.config",
    "load_config": "foilstudy.config",
    "crumple": "foilstudy.study.sweep.crumple",
    "gather": "foilstudy.study.sweep.cube",
    "open_cube": "foilstudy.study.sweep.cube",
    "respond": "foilstudy.study.sweep.respond",
}

__all__ = sorted(_LAZY)


def __getattr__(name: str):
    if name == "__version__":
        return import_module("importlib.metadata").version("foilstudy")
    if name in _LAZY:
        return getattr(import_module(_LAZY[name]), name)
    raise AttributeError(f"module 'foilstudy' has no attribute {name!r}")
