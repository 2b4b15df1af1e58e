"""Tables of the dynamics study."""

from __future__ import annotations

import csv
from pathlib import Path

from foilstudy.base.files import written_whole
from foilstudy.study.dynamics.plan import CHECKED, HIGHEST_HZ, Model
from foilstudy.study.dynamics.records import METHODS, Study

_DIRECT_FREQUENCIES = 200


def write_chart(study: Study, path: Path) -> None:
    """Every reduction: one line each."""
    head = [
        "thickness_um", "height_mm", "element_size_mm", "prestressed", "damping", "unknowns",
        "method", "order", "coordinates", "seconds", "peak_memory_mb", "estimated_error",
        "error_transfer", "error_driving", "error_relative", "valid_to_hz",
    ]  # fmt: skip
    lines = []
    for model, chart in study.charts.items():
        for row in study.rows(model):
            lines.append(
                [
                    model.thickness_um, model.height_mm, model.size_mm, int(model.prestressed),
                    chart["damping"], chart["unknowns"], row.method, row.order, row.size,
                    f"{row.seconds:.3g}", f"{row.peak_memory_mb:.0f}", f"{row.estimate:.2e}",
                    *(f"{error:.2e}" for error in row.errors.max(axis=1)), f"{row.valid_to_hz:.4g}",
                ]
            )  # fmt: skip
    _write_csv(path, head, lines)


def write_checks(study: Study, path: Path) -> None:
    """The default reduction in every configuration: one line each."""
    head = [
        "thickness_um", "height_mm", "coordinates", "clamped_modes_below_800_hz",
        "estimated_error", "error", "seconds", "times_cheaper_than_200_direct",
    ]  # fmt: skip
    lines = []
    for model, check in study.checks.items():
        lines.append(
            [
                model.thickness_um, model.height_mm, check["size"], check["modes_below"],
                f"{check['estimate']:.2e}", f"{check['error']:.2e}", f"{check['seconds']:.3g}",
                f"{_times_cheaper(check):.0f}",
            ]
        )  # fmt: skip
    _write_csv(path, head, lines)


def _times_cheaper(check: dict) -> float:
    return _DIRECT_FREQUENCIES * check["seconds_per_direct_frequency"] / check["seconds"]


def _write_csv(path: Path, head: list[str], lines: list[list]) -> None:
    with written_whole(path) as partial, partial.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerows([head, *lines])


def write_markdown(study: Study, path: Path) -> None:
    """What the study found, as a page."""
    worst = max(study.checks.values(), key=lambda check: check["error"])
    slowest = max(study.checks.values(), key=lambda check: check["seconds"])
    cheaper = min(_times_cheaper(check) for check in study.checks.values())
    text = [
        "# Reductions against the full order",
        "",
        f"The default reduction (rational Krylov, tolerance 1e-3) in the {len(CHECKED)} "
        f"configurations of the published study, 5 mm elements, 5 % modal damping, 3 to "
        f"{HIGHEST_HZ:g} Hz: largest error {worst['error']:.1e} ({_words(worst['name'])}); at most "
        f"{slowest['seconds']:.1f} s of processor time ({_words(slowest['name'])}); at least "
        f"{cheaper:.0f} times cheaper than a direct solution at {_DIRECT_FREQUENCIES} frequencies.",
        "",
    ]
    for model in study.charts:
        text += _section(study, model)
    with written_whole(path) as partial:
        partial.write_text("\n".join(text) + "\n", encoding="utf-8")


def _words(name: str) -> str:
    model = Model.named(name)
    return f"{model.thickness_um} µm, {model.height_mm} mm"


def _section(study: Study, model: Model) -> list[str]:
    chart = study.charts[model]
    kind = "with its stresses" if model.prestressed else "free of stress"
    damping = chart["damping"].replace("Damping", "").lower()
    return [
        f"## {model.thickness_um} µm, {model.size_mm:g} mm elements, {kind}",
        "",
        f"{chart['unknowns']:,} unknowns, {damping} damping; assembling and condensing took "
        f"{chart['seconds_static']:.1f} s.",
        "",
        "| method | order | coordinates | CPU s | own estimate | transfer | driving | relative |",
        "|---|---|---|---|---|---|---|---|",
        *(
            f"| {METHODS[row.method]} | {_order(row.method, row.order)} | {row.size} | "
            f"{row.seconds:.1f} | {row.estimate:.1e} | "
            + " | ".join(f"{error:.1e}" for error in row.errors.max(axis=1))
            + " |"
            for row in study.rows(model)
        ),
        "",
    ]


def _order(method: str, order: float) -> str:
    if method == "guyan":
        return ""
    return f"tolerance {order:.0e}" if method == "rational_krylov" else f"{order:g} Hz"
