"""What several commands have in common."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter
from cyclopts.validators import Number

if TYPE_CHECKING:
    from foilstudy.config import StudyConfig

__all__ = ["Cores", "read_study"]

Cores = Annotated[int, Parameter(help="Jobs at once.", validator=Number(gte=1))]


def read_study(file: Path) -> StudyConfig:
    """The configuration in a file, refused as a run would refuse it.

    Raises
    ------
    ConfigError
        One sentence for each problem.
    """
    from foilstudy.config import load_config
    from foilstudy.study.registry import refuse_reserved_name

    study = load_config(file)
    refuse_reserved_name(study.study.name)
    return study
