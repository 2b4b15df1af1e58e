"""Whether the defaults stand at the knees: no setting is much cheaper and as accurate."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Mapping

CHEAPER = 0.8
"""Share of the time of the default below which a setting counts as cheaper."""


def beaten(rows: Iterable[Mapping]) -> list[str]:
    """A sentence for every setting that beats the default, from rows of ``tradeoff.csv``.

    It does where it was measured at all, in every ladder and quantity: in less than four fifths of
    the time, with an error that is not above that of the default by more than the narrower of their
    intervals, as what is not known is not accurate, and with no more crumples that came to no
    rest. Defaults that no study has are not held.
    """
    rows = [row for row in rows if row["held"]]
    defaults = {_place(row): row for row in rows if row["default"]}
    tried = defaultdict(list)
    for row in rows:
        if not row["default"]:
            tried[row["setting"], row["value"]].append(row)
    return [
        f"{setting} {value} is as accurate as the default {defaults[_place(own[0])]['value']} in "
        f"{max(row['ratio'] for row in own):.2f} of the time"
        for (setting, value), own in tried.items()
        if all(_beats(row, defaults[_place(row)]) for row in own)
    ]


def _place(row: Mapping) -> tuple:
    return row["ladder"], row["setting"], row["quantity"]


def _beats(row: Mapping, default: Mapping) -> bool:
    numbers = (row["ratio"], row["error"], row["interval"])
    if any(number is None or not math.isfinite(number) for number in numbers):
        return False
    doubt = min(row["interval"], default["interval"])
    as_accurate = abs(row["error"]) - doubt <= abs(default["error"])
    return row["ratio"] < CHEAPER and as_accurate and row["failed"] <= default["failed"]
