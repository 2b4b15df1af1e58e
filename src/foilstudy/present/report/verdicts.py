"""What the numbers of the realisations say against them, and what to do instead."""

from __future__ import annotations

from dataclasses import dataclass

import xarray as xr

from foilstudy.measure.verdicts import VERDICTS, Verdict
from foilstudy.present.report.configurations import named
from foilstudy.present.statistics.cells import found_any, realised

_SHOWN_ELSEWHERE = ("converged", "self_crossing", "beyond_yield")
"""Good, or limits of the model, which have a table of their own."""


@dataclass(frozen=True)
class FoundVerdict:
    """One verdict that some realisations have.

    Attributes
    ----------
    name, words, consequence, cure : str
    count : int
        Realisations.
    where : str
        Their configurations.
    """

    name: str
    words: str
    count: int
    where: str
    consequence: str
    cure: str


def found_verdicts(cube: xr.Dataset) -> tuple[FoundVerdict, ...]:
    """All that speak against a realisation; none of a cube of a release before 0.5."""
    if "verdict" not in cube:
        return ()
    found = []
    for verdict in VERDICTS:
        cells = found_any(cube, (verdict.name,)) & realised(cube)
        if verdict.name not in _SHOWN_ELSEWHERE and cells.any():
            found.append(
                FoundVerdict(
                    verdict.name.replace("_", " "),
                    verdict.words,
                    int(cells.sum()),
                    named(cells.any("seed")),
                    _consequence(verdict),
                    verdict.cure,
                )
            )
    return tuple(found)


def _consequence(verdict: Verdict) -> str:
    if verdict.fault:
        return "left out of every mean"
    if verdict.doubt:
        return "not trusted where most realisations have it"
    return "kept"
