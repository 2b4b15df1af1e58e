"""The convergence study as tables and as text."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from foilstudy.base.files import written_whole
from foilstudy.study.convergence import plan
from foilstudy.study.convergence.analysis import fit, means, slope
from foilstudy.study.convergence.published import QEPH_2MM5_J, QEPH_5MM_J, RUNTIME_EXPONENT
from foilstudy.study.convergence.records import Study

_COLUMNS = (
    "size_mm", "elements", "status", "strain_energy", "membrane_energy", "bending_energy",
    "stabilisation_energy", "static_stiffness", "static_limit", "static_limit_error",
    "prestressed_stiffness", "residual", "negative_eigenvalues", "ramp_steps", "steps", "hessians",
    "cpu_seconds_relaxing", "cpu_seconds_settling", "cpu_seconds_static", "peak_memory_mb",
)  # fmt: skip
_DIRECTIONS = ("axial", "radial")
_PAIRS = {key for key in _COLUMNS if "stiffness" in key or "limit" in key}


def write_crumples(study: Study, path: Path) -> None:
    """One row per crumple and per level of the refined ones; J, N/m, s, MB."""
    header = ["path", "element", "thickness_um", "height_mm", "asked_size_mm", "seed"]
    for key in _COLUMNS:
        header += [f"{key}_{d}" for d in _DIRECTIONS] if key in _PAIRS else [key]
    rows = [("own mesh", case, record) for case, record in study.crumples.items()]
    for case, levels in study.levels.items():
        rows += [(f"refined {record['level']} times", case, record) for record in levels]
    _write(path, header, (_crumple_row(*row) for row in rows))


def _crumple_row(kind: str, case: plan.Case, record: dict) -> list:
    row = [kind, case.element, case.thickness_um, case.height_mm, case.size_mm, case.seed]
    for key in _COLUMNS:
        value = record.get(key)
        if key in _PAIRS:
            row += [_cell(v) for v in (value if value is not None else (None, None))]
        else:
            row.append(_cell(value))
    return row


def write_stops(study: Study, path: Path) -> None:
    """One row per crumple and residual at which it was stopped; J, N/m."""
    header = ["element", "thickness_um", "height_mm", "seed", "residual", "strain_energy",
              "negative_eigenvalues"]  # fmt: skip
    pairs = ("static_stiffness", "prestressed_stiffness")
    header += [f"{key}_{d}" for key in pairs for d in _DIRECTIONS]
    rows = []
    for case, records in study.stops.items():
        for record in records:
            row = [case.element, case.thickness_um, case.height_mm, case.seed]
            row += [_cell(record[key]) for key in header[4:7]]
            rows.append(row + [_cell(v) for key in pairs for v in record[key]])
    _write(path, header, rows)


def _write(path: Path, header: Sequence[str], rows: Iterable[Sequence]) -> None:
    with written_whole(path) as partial, partial.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def _cell(value) -> str:
    if value is None or (isinstance(value, float) and not np.isfinite(value)):
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def write_markdown(study: Study, path: Path) -> None:
    """What the study found, in Markdown."""
    parts = [_ensembles(study, thickness) for thickness in plan.THICKNESSES_UM]
    parts += [_published(), _levels(study), _tall(study), _timing(study)]
    with written_whole(path) as partial:
        partial.write_text("\n".join(parts), encoding="utf-8")


def _ensembles(study: Study, thickness_um: int) -> str:
    lines = [
        f"## {thickness_um} um, h_ref {plan.HEIGHT_MM} mm, each crumple on a mesh of its own\n",
        "Mean of the converged seeds and its standard error (scatter pooled over the sizes).\n",
        "| element | size, mm | converged | energy, J | stabilisation | axial, N/m | axial limit | "
        "radial, N/m | radial limit | pre-stressed axial | radial | steps | CPU, s | GB |",
        "|" + "---|" * 14,
    ]
    for element in ("corner", "one_point"):
        lines += _ensemble_lines(study, thickness_um, element)
    for element in ("corner", "one_point"):
        fitted = fit(study.ensemble("strain_energy", thickness_um, element))
        lines.append(
            f"\nEnergy by the {element} element at size zero: {fitted.limit:.3g} +- "
            f"{fitted.limit_error:.1g} J, order {fitted.order:.1f} +- {fitted.order_error:.1f}."
        )
    return "\n".join(lines) + "\n"


def _ensemble_lines(study: Study, thickness_um: int, element: str) -> Iterable[str]:
    def pick(key, index=None):
        return study.ensemble(key, thickness_um, element, index)

    energy, share = pick("strain_energy"), pick("stabilisation_energy")
    sizes, mean, error = means(energy)
    for k, size in enumerate(sizes):
        asked = [
            c for c in study.crumples
            if (c.element, c.thickness_um, c.size_mm, c.height_mm)
            == (element, thickness_um, size, plan.HEIGHT_MM)
        ]  # fmt: skip
        numbers = [
            f"{np.mean(pick(key, direction)[size]):.4g}"
            for direction in (0, 1)
            for key in ("static_stiffness", "static_limit")
        ]
        numbers += [f"{np.mean(pick('prestressed_stiffness', d)[size]):.4g}" for d in (0, 1)]
        cpu = pick("cpu_seconds_relaxing")[size] + pick("cpu_seconds_settling")[size]
        yield (
            f"| {element} | {size:g} | {len(energy[size])} of {len(asked)} | "
            f"{mean[k]:.4g} +- {error[k]:.1g} | {np.mean(share[size] / energy[size]):.1%} | "
            + " | ".join("-" if number == "nan" else number for number in numbers)
            + f" | {np.mean(pick('steps')[size]):.0f} | {np.mean(cpu):.0f} | "
            f"{np.max(pick('peak_memory_mb')[size]) / 1024:.2f} |"
        )


def _published() -> str:
    energies = ", ".join(f"{energy:g}" for energy in QEPH_5MM_J)
    return (
        f"Another code, with the published kind of element (QEPH), 500 um: {energies} J at 5 mm, "
        f"{QEPH_2MM5_J:g} J at 2.5 mm.\n"
    )


def _levels(study: Study) -> str:
    lines = [
        "## Crumpled at 5 mm, refined and relaxed again\n",
        "| thickness, um | size, mm | energy, J | stabilisation | axial, radial, N/m | "
        "pre-stressed | residual | negative | steps | tangents | CPU, s | GB |",
        "|" + "---|" * 12,
    ]
    for case, levels in study.levels.items():
        for record in levels:
            cpu = record.get("cpu_seconds_relaxing", 0.0) + record.get("cpu_seconds_settling", 0.0)
            share = record["stabilisation_energy"] / record["strain_energy"]
            lines.append(
                f"| {case.thickness_um} | {record['size_mm']:.3g} | {record['strain_energy']:.4g} "
                f"| {share:.1%} | {_pair(record['static_stiffness'])} "
                f"| {_pair(record['prestressed_stiffness'])} | {record['residual']:.0e} "
                f"| {record['negative_eigenvalues']} | {record['steps']} | {record['hessians']} "
                f"| {cpu:.0f} | {record['peak_memory_mb'] / 1024:.2f} |"
            )
    return "\n".join(lines) + "\n"


def _pair(values) -> str:
    return ", ".join(f"{value:.4g}" for value in values)


def _tall(study: Study) -> str:
    (record,) = [r for c, r in study.crumples.items() if c.height_mm == plan.TALL_HEIGHT_MM]
    seconds = record["cpu_seconds_relaxing"] + record.get("cpu_seconds_settling", 0.0)
    return (
        f"## {plan.FINEST_MM:g} mm, 50 um, h_ref {plan.TALL_HEIGHT_MM} mm\n\n"
        f"{record['status']}, residual {record['residual']:.0e}, {record['negative_eigenvalues']} "
        f"negative eigenvalues; {record['strain_energy']:.4g} J, static stiffness axial, radial "
        f"{_pair(record['static_stiffness'])} N/m, {seconds:.0f} s of crumpling and "
        f"{record['cpu_seconds_static']:.0f} s of stiffness on one core, "
        f"{record['peak_memory_mb'] / 1024:.2f} GB.\n"
    )


def _timing(study: Study) -> str:
    lines = ["## Time of a step against element size\n"]
    for thickness in plan.THICKNESSES_UM:
        rows = [row for row in study.timing if row["thickness_um"] == thickness]
        exponent, error = slope(
            np.array([row["size_mm"] for row in rows]),
            np.array([row["seconds_per_step"] for row in rows]),
        )
        times = ", ".join(
            f"{row['size_mm']:g} mm: {1e3 * row['seconds_per_step']:.3g} ms" for row in rows
        )
        lines.append(
            f"{thickness} um: {times}; exponent {exponent:.2f} +- {error:.2f} "
            f"(published {RUNTIME_EXPONENT[thickness]:g}).\n"
        )
    return "\n".join(lines)
