"""Statics and dynamics of crumpled foil cylinders: crumple, measure, gather, fit, report.

In a notebook::

    from foilstudy import Foil, Mesh, crumple

    foil = Foil(0.2, 0.17, 0.13, 500e-6, "FEP")            # diameter, heights, thickness, m
    crumpled = crumple(foil, Mesh(5e-3))
    crumpled.stiffness()                                   # axial and radial, N/m
    crumpled.plot()

Whole studies run from one configuration file: ``foilstudy run FILE``. Heavy modules load on first
use, so that ``import foilstudy`` stays cheap.
"""

from importlib import import_module

_LAZY = {
    "Accuracy": "foilstudy.config.accuracy",
    "ConfigError": "foilstudy.base.errors",
    "Crumpled": "foilstudy.pipeline.crumpled",
    "DynamicsOptions": "foilstudy.measure.dynamics.options",
    "Foil": "foilstudy.model.foil",
    "Imperfection": "foilstudy.model.foil",
    "Material": "foilstudy.model.materials",
    "Mesh": "foilstudy.pipeline.method",
    "Method": "foilstudy.pipeline.method",
    "StudyConfig": "foilstudy.config",
    "crumple": "foilstudy.pipeline.crumple",
    "gather": "foilstudy.study.sweep.cube",
    "load_config": "foilstudy.config",
    "material": "foilstudy.model.materials",
    "open_cube": "foilstudy.base.cube",
}

__all__ = sorted(_LAZY)


def __getattr__(name: str):
    if name == "__version__":
        return import_module("importlib.metadata").version("foilstudy")
    if name in _LAZY:
        return getattr(import_module(_LAZY[name]), name)
    raise AttributeError(f"module 'foilstudy' has no attribute {name!r}")


def __dir__() -> list[str]:
    """The public names: what stands beside them is how they are loaded."""
    return [*__all__, "__version__"]
