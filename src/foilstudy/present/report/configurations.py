"""Configurations of a sweep named in few words, however many they are."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from foilstudy.base.numerals import nominal, plural

_RUNS_MAX = 3
"""Stretches of a sweep that are named one by one."""
_GROUPS_MAX = 3
"""Sets of thicknesses with the same overlengths that are named one by one."""


def named(chosen) -> str:
    """Name the chosen configurations, thicknesses with the same overlengths together.

    Parameters
    ----------
    chosen : xarray.DataArray of bool (thickness, overlength)
        At least one is.
    """
    thicknesses, overlengths = chosen["thickness"].values, chosen["overlength"].values
    table = chosen.transpose("thickness", "overlength").to_numpy()
    groups: dict[bytes, list[int]] = {}
    for i, row in enumerate(table):
        if row.any():
            groups.setdefault(row.tobytes(), []).append(i)
    parts = []
    for members in list(groups.values())[:_GROUPS_MAX]:
        foils = f"{_stretches(thicknesses, np.isin(np.arange(thicknesses.size), members))} µm"
        row = table[members[0]]
        if row.all():
            parts.append(foils if row.size == 1 else f"{foils} at every overlength")
        else:
            parts.append(f"{foils} at {_stretches(overlengths, row)} %")
    rest = list(groups.values())[_GROUPS_MAX:]
    if rest:
        parts.append(f"{plural(int(sum(table[m].sum() for m in rest)), 'more configuration')}")
    return ", ".join(parts)


def _stretches(values: np.ndarray, chosen: np.ndarray) -> str:
    """Chosen values of a sweep; three or more neighbours as a range."""
    runs: list[list[float]] = []
    for k, value in enumerate(values):
        if chosen[k]:
            if k and chosen[k - 1]:
                runs[-1].append(value)
            else:
                runs.append([value])
    texts = [text for run in runs for text in _run(run)]
    if len(texts) > _RUNS_MAX:
        count = int(chosen.sum())
        ends = f"{nominal(values[chosen][0])} and {nominal(values[chosen][-1])}"
        return f"{count} of {values.size} values between {ends}"
    return _listed(texts)


def _run(run: Sequence[float]) -> list[str]:
    if len(run) < 3:
        return [nominal(float(value)) for value in run]
    return [f"{nominal(float(run[0]))} to {nominal(float(run[-1]))}"]


def _listed(texts: Sequence[str]) -> str:
    *first, last = texts
    return f"{', '.join(first)} and {last}" if first else last
