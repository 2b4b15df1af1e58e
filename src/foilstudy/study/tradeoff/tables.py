"""The charts as a table for programs and as one for people."""

from __future__ import annotations

import math
from collections.abc import Iterator

from foilstudy.base.tables import markdown_table
from foilstudy.study.tradeoff.knees import beaten
from foilstudy.study.tradeoff.points import Gathered, Row
from foilstudy.study.tradeoff.powers import EXPONENTS, crumple_powers, step_powers


def rows(study: Gathered) -> list[dict]:
    """One row per setting and quantity; seconds of the processor, errors as shares of one."""
    return [
        {
            "ladder": row.ladder,
            "setting": row.family,
            "value": row.value,
            "quantity": row.quantity,
            "seconds": row.seconds,
            "ratio": row.ratio,
            "error": row.error.value,
            "interval": row.error.interval,
            "scatter": row.error.scatter,
            "same_crumples": row.same,
            "failed": row.failed,
            "front": row.front,
            "held": row.held,
            "default": row.default,
            "reference": row.reference,
        }
        for row in study.rows
    ]


def page(study: Gathered) -> str:
    """What each setting buys, a table for each ladder; errors on the front are bold."""
    ladders = dict.fromkeys(row.ladder for row in study.rows)
    parts = [part for ladder in ladders for part in _ladder(study, ladder)]
    better = beaten(rows(study))
    verdict = "; ".join(better) if better else "no setting beats the default of its family"
    return "\n".join([*parts, *_powers(study), f"Knees: {verdict}.\n"])


def _powers(study: Gathered) -> Iterator[str]:
    known = ", ".join(f"{name} {exponent:g}" for name, exponent in EXPONENTS.items())
    for what, powers in (("a step", step_powers(study)), ("a crumple", crumple_powers(study))):
        words = "; ".join(power.words for power in powers)
        yield f"Time of {what} against element size: {words}.\n"
    yield f"Of a crumple, elsewhere: {known}.\n"


def _ladder(study: Gathered, ladder: str) -> Iterator[str]:
    found = study.of(ladder=ladder)
    quantities = list(dict.fromkeys(row.quantity for row in found))
    heads = ["setting", "value", "time", "s", *(f"error, {quantity}" for quantity in quantities)]
    body = []
    for setting, value in dict.fromkeys((row.family, row.value) for row in found):
        own = {row.quantity: row for row in found if (row.family, row.value) == (setting, value)}
        first = next(iter(own.values()))
        name = f"{value} (default)" if first.default else value
        name += f", {first.failed} failed" if first.failed else ""
        times = [f"{first.ratio:.2f}", f"{first.seconds:.3g}"]
        times = ["-", "-"] if math.isnan(first.ratio) else times
        body.append([setting, name, *times, *(_error(own.get(q)) for q in quantities)])
    yield f"### {ladder}\n"
    yield markdown_table(heads, body)
    scatters = {row.quantity: row.error.scatter for row in found}
    known = {name: value for name, value in scatters.items() if math.isfinite(value)}
    if known:
        words = ", ".join(f"{quantity} {value:.0%}" for quantity, value in known.items())
        yield f"Natural scatter of a realisation: {words}.\n"


def _error(row: Row | None) -> str:
    if row is None or math.isnan(row.error.value):
        return "" if row is None else "-"
    mark = "**" if row.front else ""
    if not row.error.interval:
        return f"{mark}{100 * row.error.value:+.2g} %{mark}"
    if row.reference:
        return f"{mark}reference ± {100 * row.error.interval:.2g} %{mark}"
    return f"{mark}{100 * row.error.value:+.2g} ± {100 * row.error.interval:.2g} %{mark}"
