"""The console command `foilstudy`, also `python -m foilstudy`: words in, library call, words out.

Cyclopts, as it loads in half the time of Typer, takes the help from numpydoc docstrings, and hands
options of Snakemake through untouched. What a command works with is imported when it runs: neither
help nor `--version` may wait for numba.
"""

from __future__ import annotations

import io
import sys
from collections.abc import Sequence
from importlib.metadata import version

from cyclopts import App

from foilstudy.base.errors import Refusal

from .check import check
from .compare import compare
from .datasheet import datasheet
from .export import export
from .report import report
from .run import run

__all__ = ["app", "main"]

app = App(
    name="foilstudy",
    help="Statics and dynamics of crumpled foil cylinders: from one config file to a report.",
    help_epilogue=(
        "One foil in Python, axial and radial stiffness in N/m; lengths in m (diameter, height, "
        "gap, thickness):\n\n"
        "from foilstudy import Foil, crumple\n\n"
        'print(crumple(Foil(0.2, 0.17, 0.13, 500e-6, "FEP")).stiffness())'
    ),
    version=lambda: version("foilstudy"),
    result_action="return_value",
)
app.register_install_completion_command()
for command in (check, run, export, report, compare, datasheet):
    app.command(command, help_epilogue="")  # else that of the whole


def main(words: Sequence[str] | None = None) -> None:
    """Do what the words say; what they ask for and cannot have is a sentence and exit code 1.

    A fault of the package keeps its traceback.

    Parameters
    ----------
    words : sequence of str, optional
        Those of the command line.

    Raises
    ------
    SystemExit
        With the sentences, or with the exit code.
    """
    if isinstance(sys.stdout, io.TextIOWrapper):
        # a terminal that lacks a character of a name shows its number
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        app(words)
    except Refusal as problem:
        sys.exit(str(problem))
    except KeyboardInterrupt:
        sys.exit("Stopped; the same command begins again.")
    except OSError as problem:
        if problem.filename is None:  # a fault of the machine, not of the words
            raise
        sys.exit(f"{problem.filename}: {problem.strerror}; check path, permissions and disk.")
