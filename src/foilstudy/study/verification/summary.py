"""All benchmarks in one table, the elements side by side, as CSV and as Markdown."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from foilstudy.base.files import written_whole
from foilstudy.study.verification.records import Benchmark, Quantity

_COLUMNS = (
    "benchmark", "element", "quantity", "unit", "reference", "source", "elements", "value",
    "relative_error", "order", "expected_order", "met",
)  # fmt: skip


def write_csv(benchmarks: Iterable[Benchmark], path: str | Path) -> None:
    """One row per quantity, finest mesh; `order` is that of the family where there is one."""
    with written_whole(path) as partial, partial.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(_COLUMNS)
        for benchmark in benchmarks:
            for q in benchmark.quantities:
                rate = benchmark.rate(q)
                writer.writerow(
                    [
                        benchmark.name, benchmark.element, q.name, q.unit, f"{q.reference:.7g}",
                        q.source, q.meshes[-1], f"{q.values[-1]:.7g}", f"{q.errors[-1]:.2e}",
                        f"{rate:.2f}" if np.isfinite(rate) else "",
                        "" if q.expected_rate is None else f"{q.expected_rate:g}",
                        not q.problems(),
                    ]
                )  # fmt: skip


def table(benchmarks: Iterable[Benchmark]) -> str:
    """Markdown table, one row per quantity, with mesh, error and order of every element."""
    pairs: dict[str, list[Benchmark]] = {}
    for benchmark in benchmarks:
        pairs.setdefault(benchmark.name, []).append(benchmark)
    elements = [benchmark.element.replace("_", " ") for benchmark in next(iter(pairs.values()))]
    heads = [f"{element}: mesh | error | order" for element in elements]
    lines = [
        f"| benchmark | quantity | known value | source | {' | '.join(heads)} |",
        "|---" * (4 + 3 * len(elements)) + "|",
    ]
    for pair in pairs.values():
        lines += [_row(pair, i) for i in range(len(pair[0].quantities))]
    return "\n".join(lines) + "\n"


def write_markdown(benchmarks: Iterable[Benchmark], path: str | Path) -> None:
    """The table, and what is not met."""
    benchmarks = list(benchmarks)
    problems = [problem for benchmark in benchmarks for problem in benchmark.problems()]
    text = table(benchmarks)
    if problems:
        text += "\nNot met:\n\n" + "".join(f"- {problem}\n" for problem in problems)
    with written_whole(path) as partial:
        partial.write_text(text)


def _row(pair: Sequence[Benchmark], place: int) -> str:
    """One quantity with every element."""
    q = pair[0].quantities[place]
    cells = [pair[0].title if place == 0 else "", q.name, _value(q), q.source]
    for benchmark in pair:
        mine = benchmark.quantities[place]
        cells += [str(mine.meshes[-1]), _percent(mine), _order(benchmark, mine)]
    return f"| {' | '.join(cells)} |"


def _value(quantity: Quantity) -> str:
    unit = f" {quantity.unit}" if quantity.unit not in ("", "1") else ""
    return f"{quantity.reference:.5g}{unit}"


def _percent(quantity: Quantity) -> str:
    return f"{100 * quantity.errors[-1]:+.2g} %" if quantity.errors[-1] else "0"


def _order(benchmark: Benchmark, quantity: Quantity) -> str:
    rate = benchmark.rate(quantity)
    if not np.isfinite(rate):
        return "-"
    if quantity.expected_rate is None:
        return f"{rate:.1f}"
    return f"{rate:.1f} ({quantity.expected_rate:g})"
