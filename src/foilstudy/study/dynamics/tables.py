"""Tables of the dynamics study."""

from __future__ import annotations

from operator import itemgetter

from foilstudy.base.tables import markdown_table
from foilstudy.measure.dynamics.response import DEFINITIONS
from foilstudy.study.dynamics.plan import CHECKED, HIGHEST_HZ, Model
from foilstudy.study.dynamics.records import METHODS, succeeded
from foilstudy.study.kernel.plan import Results

_DIRECT_FREQUENCIES = 200


def reductions(study: Results) -> list[dict]:
    """Every reduction: one row each."""
    return [
        {
            "thickness_um": model.thickness_um,
            "height_mm": model.height_mm,
            "element_size_mm": model.size_mm,
            "prestressed": int(model.prestressed),
            "damping": chart["damping"],
            "unknowns": chart["unknowns"],
            "method": row.method,
            "order": row.order,
            "coordinates": row.size,
            "seconds": f"{row.seconds:.3g}",
            "peak_memory_mb": f"{row.peak_memory_mb:.0f}",
            "estimated_error": f"{row.estimate:.2e}",
            **{
                f"error_{definition}": f"{error:.2e}"
                for definition, error in zip(DEFINITIONS, row.errors.max(axis=1), strict=True)
            },
            "valid_to_hz": f"{row.valid_to_hz:.4g}",
        }
        for model, chart in study["charts"].items()
        for row in succeeded(study, model)
    ]


def checks(study: Results) -> list[dict]:
    """The default reduction in every configuration: one row each."""
    return [
        {
            "thickness_um": model.thickness_um,
            "height_mm": model.height_mm,
            "coordinates": check["size"],
            "clamped_modes_below_800_hz": check["modes_below"],
            "estimated_error": f"{check['estimate']:.2e}",
            "error": f"{check['error']:.2e}",
            "seconds": f"{check['seconds']:.3g}",
            "times_cheaper_than_200_direct": f"{_times_cheaper(check):.0f}",
        }
        for model, check in study["checks"].items()
    ]


def _times_cheaper(check: dict) -> float:
    return _DIRECT_FREQUENCIES * check["seconds_per_direct_frequency"] / check["seconds"]


def page(study: Results) -> str:
    """What the study found, as a page."""
    worst, error = max(
        ((model, check["error"]) for model, check in study["checks"].items()), key=itemgetter(1)
    )
    slowest, seconds = max(
        ((model, check["seconds"]) for model, check in study["checks"].items()), key=itemgetter(1)
    )
    cheaper = min(_times_cheaper(check) for check in study["checks"].values())
    text = [
        "# Reductions against the full order",
        "",
        f"The default reduction (rational Krylov, tolerance 1e-3) in the {len(CHECKED)} "
        f"configurations of the published study, 5 mm elements, 5 % modal damping, 3 to "
        f"{HIGHEST_HZ:g} Hz: largest error {error:.1e} ({_words(worst)}); at most "
        f"{seconds:.1f} s of processor time ({_words(slowest)}); at least "
        f"{cheaper:.0f} times cheaper than a direct solution at {_DIRECT_FREQUENCIES} frequencies.",
        "",
    ]
    for model in study["charts"]:
        text += _section(study, model)
    return "\n".join(text) + "\n"


def _words(model: Model) -> str:
    return f"{model.thickness_um} µm, {model.height_mm} mm"


def _section(study: Results, model: Model) -> list[str]:
    chart = study["charts"][model]
    kind = "with its stresses" if model.prestressed else "free of stress"
    damping = chart["damping"].replace("Damping", "").lower()
    heads = ["method", "order", "coordinates", "CPU s", "own estimate", *DEFINITIONS]
    rows = [
        [METHODS[row.method], _order(row.method, row.order), row.size, f"{row.seconds:.1f}",
         f"{row.estimate:.1e}", *(f"{error:.1e}" for error in row.errors.max(axis=1))]
        for row in succeeded(study, model)
    ]  # fmt: skip
    return [
        f"## {model.thickness_um} µm, {model.size_mm:g} mm elements, {kind}",
        "",
        f"{chart['unknowns']:,} unknowns, {damping} damping; assembling and condensing took "
        f"{chart['seconds_static']:.1f} s.",
        "",
        markdown_table(heads, rows),
    ]


def _order(method: str, order: float) -> str:
    if method == "guyan":
        return ""
    return f"tolerance {order:.0e}" if method == "rational_krylov" else f"{order:g} Hz"
