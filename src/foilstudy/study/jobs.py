"""The jobs of the side studies, by names and paths alone, as the workflow calls them."""

from __future__ import annotations

from pathlib import Path

from foilstudy.base.errors import Refusal
from foilstudy.study.kernel import files
from foilstudy.study.registry import STUDIES


def measure(study: str, part: str, case: str, path: Path, *needed: Path) -> None:
    """Measure one case and write its record; `needed` are the records that it takes."""
    cost = files.measure(STUDIES[study], part, case, path, needed).cost
    print(f"{cost.cpu_seconds:.1f} s of processor time, {cost.peak_memory_mb:.0f} MB")


def present(study: str, folder: Path) -> None:
    """Write tables and figures of the records in a folder."""
    files.present(STUDIES[study], folder)


def check(study: str, folder: Path) -> None:
    """See that the records in a folder meet the demands.

    Raises
    ------
    Refusal
        With a line for each demand that they miss.
    """
    if problems := files.problems(STUDIES[study], folder):
        raise Refusal("\n".join(problems))
