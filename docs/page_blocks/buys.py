"""Block of what each setting buys, on one page."""

from __future__ import annotations

from collections.abc import Iterator

import pandas as pd

from foilstudy.study.tradeoff.knees import worth_more
from page_blocks.study import Study, rows

_SAME = 0.05
"""Times that differ by less from that of the default are as good as it."""


def buys(study: Study) -> Iterator[str]:
    """Of every setting the default, and the next value that is cheaper and that is dearer."""
    table = study.table("tradeoff")
    table["value"] = table["value"].astype(str)
    body = []
    for (ladder, setting), family in table.groupby(["ladder", "setting"], sort=False):
        default = family[family["default"]]
        times = family[~family["default"]].groupby("value", sort=False)["ratio"].first()
        less, more = times[times < 1 - _SAME], times[times > 1 + _SAME]
        body.append(
            [
                ladder,
                setting,
                f"{default['value'].iloc[0]}: {_errors(default)}",
                _other(family, less.idxmax()) if len(less) else "none cheaper",
                _other(family, more.idxmin()) if len(more) else "none dearer",
            ]
        )
    heads = ["ladder", "setting", "default: error, %", "next cheaper: time, error", "next dearer"]
    yield from rows(heads, body)
    yield ""
    better = worth_more(table.to_dict("records"))
    yield "Hardly dearer and far more accurate than a default: " + "; ".join(better or ["none"])


def _other(family: pd.DataFrame, value: str) -> str:
    own = family[family["value"] == value]
    return f"{value}: {own['ratio'].iloc[0]:.2f}, {_errors(own)}"


def _errors(own: pd.DataFrame) -> str:
    if own["reference"].all():
        return "reference"
    parts = own[own["error"].notna()]
    return ", ".join(
        f"{quantity} {100 * error:.2g}"
        for quantity, error in zip(parts["quantity"], parts["error"], strict=True)
    )
