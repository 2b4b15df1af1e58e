"""Every trial, and the laws of all models."""

from __future__ import annotations

import numpy as np

from foilstudy.base.tables import markdown_table
from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.study.real.laws import EXPONENTS, Found, levels
from foilstudy.study.sweep.quantities import declared


def trials(found: Found) -> list[dict]:
    """A row for each foil and model: its numbers, stiffness by direction."""
    named = sorted({name for result in found.records.values() for name in result})
    rows = []
    for trial, result in found.records.items():
        row = {
            "step": trial.step,
            "thickness_um": trial.thickness_um,
            "height_mm": trial.height_mm,
            "seed": trial.seed,
            "status": result["status"],
            "message": result["message"],
        }
        for name in named:
            if name in row:
                continue
            row |= _cells(name, result.get(name))
        rows.append(row)
    columns = dict.fromkeys(name for row in rows for name in row)
    return [{name: row.get(name) for name in columns} for row in rows]


def _cells(name: str, value) -> dict[str, float | None]:
    """One number, or one for each direction; larger arrays are in the records."""
    values = np.asarray(np.nan if value is None else value, float).ravel()
    if values.size == 1:
        return {name: float(values[0])}
    if declared(name).dims == ("direction",):
        return {f"{name}_{d}": float(v) for d, v in zip(DIRECTIONS, values)}
    return {}


def laws(found: Found) -> list[dict]:
    """A row for each law."""
    return [
        {
            "step": law.step,
            "state": law.state,
            "direction": law.direction,
            **{
                f"{term}{end}": getattr(known, kind)
                for term, known in law.terms.items()
                for end, kind in (("", "value"), ("_low", "low"), ("_high", "high"))
            },
            "realisations": law.count,
            "of": law.of,
        }
        for law in found.laws
    ]


def page(found: Found) -> str:
    """The laws as a table for people."""
    heads = [
        *("model", "state", "direction"),
        *(f"over measured at {at:.3g} %" for at in levels().values()),
        *(f"exponent of {name}" for name in EXPONENTS),
        "realisations",
    ]
    body = [
        [
            *(law.words, law.state, law.direction),
            *(law.terms[term].words for term in (*levels(), *EXPONENTS)),
            _count(law),
        ]
        for law in found.laws
    ]
    table = markdown_table(heads, body)
    return table.replace(" (nan to nan)", "") + "\n" + _bounds(found)


def _count(law) -> str:
    return f"{law.count} of {law.of}" if law.of else ""


def _bounds(found: Found) -> str:
    heads = ["thickness, um", "height, mm", "direction", "measured law, kN/m"]
    return markdown_table(
        [*heads, "no foil exceeds, kN/m", "share"],
        [
            [
                each.thickness_um,
                each.height_mm,
                each.direction,
                f"{1e-3 * each.measured:.3g}",
                f"{1e-3 * each.bound:.3g}",
                f"{100 * each.measured / each.bound:.3g} %",
            ]
            for each in found.bounds
        ],
    )
