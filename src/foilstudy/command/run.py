"""`foilstudy run`: hands over to Snakemake."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from foilstudy.base.errors import Refusal

from .options import Cores, read_study

__all__ = ["run", "study_folder"]


def run(
    file: Path,
    /,
    *options: Annotated[str, Parameter(allow_leading_hyphen=True)],
    cores: Cores = 2,
) -> None:
    """Run a study, or go on with one that was stopped.

    Snakemake does, in the current folder if that has the Snakefile, else in the checkout of
    foilstudy; results go to results/NAME there.

    Parameters
    ----------
    file : Path
        YAML file of the study.
    options : str
        For Snakemake, such as --dry-run, --forceall, or a target: verify, elements, convergence,
        dynamics.
    """
    read_study(file)  # says what is wrong with it before Snakemake loads
    folder, config = study_folder(), file.resolve()
    snakemake = Path(sys.executable).with_name("snakemake")
    if not snakemake.is_file():
        raise Refusal(
            f"{snakemake}: there is no Snakemake beside this Python; install foilstudy[workflow]."
        )
    os.chdir(folder)
    words = ["snakemake", "--configfile", os.path.relpath(config), f"-j{cores}", *options]
    sys.stdout.flush()
    os.execv(snakemake, words)


def study_folder() -> Path:
    """The folder with the Snakefile: the current one, else the checkout of an editable install.

    Raises
    ------
    Refusal
        If neither has one.
    """
    checkout = Path(__file__).resolve().parents[3]
    for folder in (Path.cwd(), checkout):
        if (folder / "Snakefile").is_file():
            return folder
    raise Refusal(
        f"{Path.cwd()}: there is no Snakefile here, and foilstudy is not installed from a "
        "checkout; change to the folder of the repository."
    )
