"""The convergence study as tables and as text."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from foilstudy.base.reference import EXPLICIT_CODE, EXPLICIT_CODE_ENERGIES, published
from foilstudy.base.tables import markdown_table
from foilstudy.study.convergence import plan
from foilstudy.study.convergence.analysis import fit, means, slope
from foilstudy.study.convergence.records import ensemble
from foilstudy.study.kernel.plan import Results
from foilstudy.study.published import HEIGHT_MM, THICKNESSES_UM

_COLUMNS = (
    "size_mm", "elements", "status", "strain_energy", "membrane_energy", "bending_energy",
    "stabilisation_energy", "static_stiffness", "static_limit", "static_limit_error",
    "prestressed_stiffness", "residual", "negative_eigenvalues", "ramp_steps", "steps", "hessians",
    "cpu_seconds_relaxing", "cpu_seconds_settling", "cpu_seconds_static", "peak_memory_mb",
)  # fmt: skip
_DIRECTIONS = ("axial", "radial")
_PAIRS = {key for key in _COLUMNS if "stiffness" in key or "limit" in key}
_STOP_COLUMNS = ("residual", "strain_energy", "negative_eigenvalues", "static_stiffness",
                 "prestressed_stiffness")  # fmt: skip


def crumples(study: Results) -> list[dict]:
    """One row per crumple and per level of the refined ones; J, N/m, s, MB."""
    found = [("own mesh", case, record) for case, record in study["crumples"].items()]
    for case, levels in study["levels"].items():
        found += [(f"refined {record['level']} times", case, record) for record in levels]
    rows = []
    for path, case, record in found:
        row = {"path": path, "element": case.element, "thickness_um": case.thickness_um}
        row |= {"height_mm": case.height_mm, "asked_size_mm": case.size_mm, "seed": case.seed}
        rows.append(row | _cells(record, _COLUMNS))
    return rows


def stops(study: Results) -> list[dict]:
    """One row per crumple and residual at which it was stopped; J, N/m."""
    return [
        {"element": case.element, "thickness_um": case.thickness_um}
        | {"height_mm": case.height_mm, "seed": case.seed}
        | _cells(record, _STOP_COLUMNS)
        for case, records in study["stops"].items()
        for record in records
    ]


def _cells(record: dict, columns: Iterable[str]) -> dict:
    """Numbers of a record, directions apart; None where a crumple did not get so far."""
    cells = {}
    for key in columns:
        if key in _PAIRS:
            values = record.get(key, (None, None))
            cells |= {f"{key}_{d}": v for d, v in zip(_DIRECTIONS, values, strict=True)}
        else:
            cells[key] = record.get(key)
    return cells


def page(study: Results) -> str:
    """What the study found, in Markdown."""
    parts = [_ensembles(study, thickness) for thickness in THICKNESSES_UM]
    parts += [_explicit_code(), _levels(study), _tall(study), _timing(study)]
    return "\n".join(parts)


def _ensembles(study: Results, thickness_um: int) -> str:
    heads = [
        "element", "size, mm", "converged", "energy, J", "stabilisation", "axial, N/m",
        "axial limit", "radial, N/m", "radial limit", "pre-stressed axial", "radial", "steps",
        "CPU, s", "GB",
    ]  # fmt: skip
    rows = [
        row for element in ("corner", "one_point") for row in _rows(study, thickness_um, element)
    ]
    lines = [
        f"## {thickness_um} um, h_ref {HEIGHT_MM} mm, each crumple on a mesh of its own\n",
        "Mean of the converged seeds and its standard error (scatter pooled over the sizes).\n",
        markdown_table(heads, rows).rstrip("\n"),
    ]
    for element in ("corner", "one_point"):
        fitted = fit(ensemble(study, "strain_energy", thickness_um, element))
        lines.append(
            f"\nEnergy by the {element} element at size zero: {fitted.limit:.3g} +- "
            f"{fitted.limit_error:.1g} J, order {fitted.order:.1f} +- {fitted.order_error:.1f}."
        )
    return "\n".join(lines) + "\n"


def _rows(study: Results, thickness_um: int, element: str) -> Iterable[list[str]]:
    def pick(key, index=None):
        return ensemble(study, key, thickness_um, element, index)

    energy, share = pick("strain_energy"), pick("stabilisation_energy")
    sizes, mean, error = means(energy)
    for k, size in enumerate(sizes):
        asked = [
            c for c in study["crumples"]
            if (c.element, c.thickness_um, c.size_mm, c.height_mm)
            == (element, thickness_um, size, HEIGHT_MM)
        ]  # fmt: skip
        numbers = [
            f"{np.mean(pick(key, direction)[size]):.4g}"
            for direction in (0, 1)
            for key in ("static_stiffness", "static_limit")
        ]
        numbers += [f"{np.mean(pick('prestressed_stiffness', d)[size]):.4g}" for d in (0, 1)]
        cpu = pick("cpu_seconds_relaxing")[size] + pick("cpu_seconds_settling")[size]
        yield [
            element, f"{size:g}", f"{len(energy[size])} of {len(asked)}",
            f"{mean[k]:.4g} +- {error[k]:.1g}", f"{np.mean(share[size] / energy[size]):.1%}",
            *("-" if number == "nan" else number for number in numbers),
            f"{np.mean(pick('steps')[size]):.0f}", f"{np.mean(cpu):.0f}",
            f"{np.max(pick('peak_memory_mb')[size]) / 1024:.2f}",
        ]  # fmt: skip


def _explicit_code() -> str:
    energies = ", ".join(
        ", ".join(f"{value:g}" for value in values) + f" J at {size:g} mm"
        for size, values in EXPLICIT_CODE_ENERGIES.items()
    )
    return f"{EXPLICIT_CODE}, 500 um: {energies}.\n"


def _levels(study: Results) -> str:
    heads = [
        "thickness, um", "size, mm", "energy, J", "stabilisation", "axial, radial, N/m",
        "pre-stressed", "residual", "negative", "steps", "tangents", "CPU, s", "GB",
    ]  # fmt: skip
    rows = []
    for case, levels in study["levels"].items():
        for record in levels:
            cpu = record.get("cpu_seconds_relaxing", 0.0) + record.get("cpu_seconds_settling", 0.0)
            share = record["stabilisation_energy"] / record["strain_energy"]
            rows.append(
                [
                    case.thickness_um, f"{record['size_mm']:.3g}", f"{record['strain_energy']:.4g}",
                    f"{share:.1%}", _pair(record["static_stiffness"]),
                    _pair(record["prestressed_stiffness"]), f"{record['residual']:.0e}",
                    record["negative_eigenvalues"], record["steps"], record["hessians"],
                    f"{cpu:.0f}", f"{record['peak_memory_mb'] / 1024:.2f}",
                ]
            )  # fmt: skip
    return "## Crumpled at 5 mm, refined and relaxed again\n\n" + markdown_table(heads, rows)


def _pair(values) -> str:
    return ", ".join(f"{value:.4g}" for value in values)


def _tall(study: Results) -> str:
    (record,) = [r for c, r in study["crumples"].items() if c.height_mm == plan.TALL_HEIGHT_MM]
    seconds = record["cpu_seconds_relaxing"] + record.get("cpu_seconds_settling", 0.0)
    return (
        f"## {plan.FINEST_MM:g} mm, 50 um, h_ref {plan.TALL_HEIGHT_MM} mm\n\n"
        f"{record['status']}, residual {record['residual']:.0e}, {record['negative_eigenvalues']} "
        f"negative eigenvalues; {record['strain_energy']:.4g} J, static stiffness axial, radial "
        f"{_pair(record['static_stiffness'])} N/m, {seconds:.0f} s of crumpling and "
        f"{record['cpu_seconds_static']:.0f} s of stiffness on one core, "
        f"{record['peak_memory_mb'] / 1024:.2f} GB.\n"
    )


def _timing(study: Results) -> str:
    lines = ["## Time of a step against element size\n"]
    exponents = published().run_time_exponents
    for thickness in THICKNESSES_UM:
        rows = [row for row in study["timing"]["steps"] if row["thickness_um"] == thickness]
        exponent, error = slope(
            np.array([row["size_mm"] for row in rows]),
            np.array([row["seconds_per_step"] for row in rows]),
        )
        times = ", ".join(
            f"{row['size_mm']:g} mm: {1e3 * row['seconds_per_step']:.3g} ms" for row in rows
        )
        lines.append(
            f"{thickness} um: {times}; exponent {exponent:.2f} +- {error:.2f} "
            f"(published {exponents[thickness]:g}).\n"
        )
    return "\n".join(lines)
