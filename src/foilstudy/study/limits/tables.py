"""The map as a table for programs and as one for people."""

from __future__ import annotations

from foilstudy.base.tables import markdown_table
from foilstudy.measure.verdicts import VERDICTS
from foilstudy.study.limits.map import QUANTITIES, Bias, Field, found

_MODEL = ("self_crossing", "beyond_yield")
"""Limits of the model, which the default has, too."""
_GOOD = "converged"


def rows(fields: list[Field]) -> list[dict]:
    """One row per trial."""
    return [
        {
            "group": field.setting.group,
            "method": field.setting.method,
            "value": field.setting.value,
            "thickness_um": field.foil.thickness_um,
            "height_mm": field.foil.height_mm,
            "size_mm": field.foil.size_mm,
            "seed": record.case.seed,
            "verdicts": " ".join(found(record)),
            **{name: record.result.get(name) for name in _NUMBERS},
            "axial": _stiffness(record.result, 0),
            "radial": _stiffness(record.result, 1),
            "message": record.result["message"],
        }
        for field in fields
        for record in field.records
    ]


_NUMBERS = (
    "membrane_energy",
    "bending_energy",
    "broad_wave_share",
    "alternation",
    "negative_eigenvalues",
    "residual",
    "steps",
    "hessians",
    "reached",
    "seconds",
)


def _stiffness(result: dict, direction: int) -> float | None:
    values = result.get("static_stiffness")
    return None if values is None or not len(values) else values[direction]


def page(fields: list[Field]) -> str:
    """A table for each foil: what became of each method, and its bias."""
    parts = []
    for foil in dict.fromkeys(field.foil for field in fields):
        heads = ["group", "method", "sound", "verdicts", *QUANTITIES, "time, s"]
        body = [
            [
                field.setting.group,
                field.setting.words,
                f"{field.sound} of {len(field.records)}",
                verdict_words(field),
                *(bias_words(field.bias[name]) for name in QUANTITIES),
                f"{field.seconds:.2g}" if field.seconds == field.seconds else "–",
            ]
            for field in fields
            if field.foil == foil
        ]
        parts.append(
            f"{foil.words}, elements of {foil.size_mm:g} mm:\n\n{markdown_table(heads, body)}"
        )
    return "\n".join(parts)


def verdict_words(field: Field) -> str:
    """What speaks against a method, with how many trials have it."""
    against = [
        f"{verdict.name.replace('_', ' ')} ({field.verdicts[verdict.name]})"
        for verdict in VERDICTS
        if field.verdicts[verdict.name] and verdict.name not in (_GOOD, *_MODEL)
    ]
    return ", ".join(against) or "none"


def bias_words(bias: Bias) -> str:
    """In per cent of the default."""
    if bias.value != bias.value:
        return "–"
    error = f" ± {100 * bias.error:.0f}" if bias.error == bias.error else ""
    return f"{100 * bias.value:+.0f}{error} %"
