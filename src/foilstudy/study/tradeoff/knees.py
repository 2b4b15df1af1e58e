"""Whether the defaults stand at the knees.

There no setting is much cheaper and as accurate, and none hardly dearer and far more accurate.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Mapping

CHEAPER = 0.8
"""Share of the time of the default below which a setting counts as cheaper."""
DEARER, SMALL = 1.3, 0.05
"""Times that of the default up to which a setting counts as hardly dearer; errors below the second
ask for no better setting."""


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
    if not _known(row):
        return False
    doubt = min(row["interval"], default["interval"])
    as_accurate = abs(row["error"]) - doubt <= abs(default["error"])
    return row["ratio"] < CHEAPER and as_accurate and row["failed"] <= default["failed"]


def worth_more(rows: Iterable[Mapping]) -> list[str]:
    """A sentence for every setting that takes little more time than the default and errs far less.

    That is at most `DEARER` times the time, with at most half of the error and of its interval, in
    every quantity where the default errs by more than `SMALL`; and in no quantity more.
    """
    rows = [row for row in rows if row["held"]]
    defaults = {_place(row): row for row in rows if row["default"]}
    tried = defaultdict(list)
    for row in rows:
        if not row["default"]:
            tried[row["ladder"], row["setting"], row["value"]].append(row)
    return [
        f"{ladder}: {setting} {value} errs half as much as the default or less in "
        f"{max(row['ratio'] for row in own):.2f} times the time"
        for (ladder, setting, value), own in tried.items()
        if all(_no_worse(row, defaults[_place(row)]) for row in own)
        and any(_bound(defaults[_place(row)]) > SMALL for row in own)
        and all(
            _bound(row) <= 0.5 * _bound(default)
            for row in own
            for default in (defaults[_place(row)],)
            if _bound(default) > SMALL
        )
    ]


def _no_worse(row: Mapping, default: Mapping) -> bool:
    if not (_known(row) and _known(default)):
        return False
    no_more = _bound(row) <= _bound(default) and row["failed"] <= default["failed"]
    return row["ratio"] <= DEARER and no_more


def _bound(row: Mapping) -> float:
    return abs(row["error"]) + row["interval"]


def _known(row: Mapping) -> bool:
    numbers = (row["ratio"], row["error"], row["interval"])
    return all(number is not None and math.isfinite(number) for number in numbers)
