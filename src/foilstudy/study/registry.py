"""Which side studies there are, cheap to import: the workflow makes its rules of them."""

from __future__ import annotations

from importlib import import_module

from foilstudy.base.errors import ConfigError
from foilstudy.study.kernel.plan import Study

MODULES = (
    "verification.plan",
    "elements.plan",
    "convergence.plan",
    "dynamics.plan",
    "tradeoff.plan",
    "accuracy.plan",
    "limits.plan",
    "limits.quick",
    "limits.measured",
    "limits.bounds",
    "real.plan",
    "truth.plan",
    "specimen.plan",
    "amplitude.plan",
)
"""Modules of this package that define a ``STUDY``."""

STUDIES: dict[str, Study] = {
    study.name: study
    for study in (import_module(f"foilstudy.study.{module}").STUDY for module in MODULES)
}
"""By the target of the workflow."""


def refuse_reserved_name(name: str) -> None:
    """See that a configured study writes into no side study's folder.

    Raises
    ------
    ConfigError
        If `name`, the ``study.name``, is the folder or the target of one.
    """
    for study in STUDIES.values():
        # some file systems do not tell the cases of letters apart
        if name.casefold() in (study.name.casefold(), study.folder.casefold()):
            raise ConfigError(
                f"study.name: {name!r} is the side study `snakemake {study.name}`, which writes "
                f"results/{study.folder}; choose another name."
            )
