"""All benchmarks in one table, the elements side by side, as CSV and as Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from foilstudy.base.tables import markdown_table
from foilstudy.study.kernel.plan import Records
from foilstudy.study.verification.records import Benchmark, Checked, Curve, Picture, Plot


def benchmarks_of(records: Records) -> list[Benchmark]:
    """All benchmarks of a run."""
    return [_benchmark(record.result) for record in records["benchmarks"].values()]


def _benchmark(result: dict) -> Benchmark:
    plot = result["plot"]
    if plot is not None:
        plot = Plot(**plot | {"curves": [Curve(**curve) for curve in plot["curves"]]})
    quantities = [Checked(**quantity) for quantity in result["quantities"]]
    pictures = [Picture(**picture) for picture in result["pictures"]]
    return Benchmark(**result | {"quantities": quantities, "plot": plot, "pictures": pictures})


def problems(benchmarks: Iterable[Benchmark]) -> list[str]:
    """What the benchmarks miss, one sentence each."""
    return [problem for benchmark in benchmarks for problem in benchmark.problems()]


def rows(benchmarks: Iterable[Benchmark]) -> list[dict]:
    """One row per quantity, finest mesh; `order` is that of the family where there is one."""
    found = []
    for benchmark in benchmarks:
        for q in benchmark.quantities:
            rate = benchmark.rate(q)
            row = {"benchmark": benchmark.name, "element": benchmark.element, "quantity": q.name}
            row |= {"unit": q.unit, "reference": f"{q.reference:.7g}", "source": q.source}
            row |= {"elements": int(q.meshes[-1]), "value": f"{q.values[-1]:.7g}"}
            row["relative_error"] = f"{q.errors[-1]:.2e}"
            row["order"] = f"{rate:.2f}" if np.isfinite(rate) else ""
            row["expected_order"] = q.expected_rate
            found.append(row | {"met": not q.problems()})
    return found


def table(benchmarks: Iterable[Benchmark]) -> str:
    """Markdown table, one row per quantity, with mesh, error and order of every element."""
    pairs: dict[str, list[Benchmark]] = {}
    for benchmark in benchmarks:
        pairs.setdefault(benchmark.name, []).append(benchmark)
    heads = ["benchmark", "quantity", "known value", "source"]
    for benchmark in next(iter(pairs.values())):
        heads += [f"{benchmark.element.replace('_', ' ')}: mesh", "error", "order"]
    rows = (_row(pair, i) for pair in pairs.values() for i in range(len(pair[0].quantities)))
    return markdown_table(heads, rows)


def page(benchmarks: Sequence[Benchmark]) -> str:
    """The table, and what is not met."""
    missed = "".join(f"- {problem}\n" for problem in problems(benchmarks))
    return table(benchmarks) + (f"\nNot met:\n\n{missed}" if missed else "")


def _row(pair: Sequence[Benchmark], place: int) -> list[str]:
    """One quantity with every element."""
    q = pair[0].quantities[place]
    cells = [pair[0].title if place == 0 else "", q.name, _value(q), q.source]
    for benchmark in pair:
        mine = benchmark.quantities[place]
        cells += [f"{mine.meshes[-1]:g}", _percent(mine), _order(benchmark, mine)]
    return cells


def _value(quantity: Checked) -> str:
    unit = f" {quantity.unit}" if quantity.unit not in ("", "1") else ""
    return f"{quantity.reference:.5g}{unit}"


def _percent(quantity: Checked) -> str:
    return f"{100 * quantity.errors[-1]:+.2g} %" if quantity.errors[-1] else "0"


def _order(benchmark: Benchmark, quantity: Checked) -> str:
    rate = benchmark.rate(quantity)
    if not np.isfinite(rate):
        return "-"
    if quantity.expected_rate is None:
        return f"{rate:.1f}"
    return f"{rate:.1f} ({quantity.expected_rate:g})"
