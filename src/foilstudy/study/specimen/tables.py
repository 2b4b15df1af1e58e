"""Scenes, drawn shapes and ways to share the shortening, as tables for programs and for people."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from foilstudy.base.confidence import CONFIDENCE
from foilstudy.base.reference import published
from foilstudy.base.tables import markdown_table
from foilstudy.study.kernel.plan import Records
from foilstudy.study.specimen.plan import (
    LAWS,
    MERIDIANS,
    OVERLENGTHS_PERCENT,
    SCENES,
    SHARED_PERCENT,
    SHARES,
    THICKNESS_UM,
)

_NUMBERS = (
    "energy",
    "membrane_energy",
    "bending_energy",
    "dissipated_work",
    "reaction",
    "developed_height",
    "shortening_spread",
    "shortening_gini",
    "axisymmetric_share",
)


def scene_rows(records: Records) -> list[dict]:
    """One row per crumple of a specimen."""
    return _rows(records["scenes"])


def drawn_rows(records: Records) -> list[dict]:
    """One row per drawn shape."""
    return _rows(records["drawn"])


def shared_rows(records: Records) -> list[dict]:
    """One row per crumple whose shortening is left to a share of the height."""
    released = [f"released_{name}" for name in ("status", *_NUMBERS)]
    rows = _rows(records["shared"], (*_NUMBERS, *released))
    for row, record in zip(rows, records["shared"].values(), strict=True):
        for kind in ("prestressed", "joined", "released", "released_prestressed"):
            axial, radial = stiffness(record.result, kind)
            row |= {f"{kind}_axial": axial, f"{kind}_radial": radial}
    return rows


def _rows(cases: Mapping[Any, Any], numbers: Sequence[str] = _NUMBERS) -> list[dict]:
    return [
        {
            **vars(case),
            "status": record.result.get("status", ""),
            "axial": stiffness(record.result)[0],
            "radial": stiffness(record.result)[1],
            **{name: record.result.get(name) for name in numbers},
        }
        for case, record in cases.items()
    ]


def stiffness(result: Mapping[str, Any], kind: str = "") -> tuple[float, float]:
    """Axial and radial of what was measured, N/m; NaN where it came to nothing."""
    values = result.get(f"{kind}_stiffness" if kind else "stiffness")
    return (np.nan, np.nan) if values is None else (float(values[0]), float(values[1]))


def measured_stiffness(direction: str, overlength_percent: float) -> float:
    """By the published power law of the measurements, N/m."""
    law = published().power_laws[direction]["experiment"].law
    return float(law.stiffness(overlength_percent, THICKNESS_UM))


def change(values: Sequence[float], plain: Sequence[float]) -> tuple[float, float, float]:
    """By what factor values differ from paired ones, and its 95 % interval.

    Of the mean logarithm of the ratio, by Student: NaN for fewer than two pairs.
    """
    from scipy.special import stdtrit

    ratios = np.log(np.asarray(values, float) / np.asarray(plain, float))
    ratios = ratios[np.isfinite(ratios)]
    if ratios.size < 2:
        return np.nan, np.nan, np.nan
    error = ratios.std(ddof=1) / np.sqrt(ratios.size)
    half = stdtrit(ratios.size - 1, 0.5 + CONFIDENCE / 2) * error
    return tuple(float(np.exp(ratios.mean() + sign * half)) for sign in (0, -1, 1))


def page(records: Records) -> str:
    """Tables for people."""
    parts = (_scenes, _against, _drawn, _shared, _released)
    return "\n".join(part(records) for part in parts)


def _scenes(records: Records) -> str:
    cases = {(c.scene, c.seed): r.result for c, r in records["scenes"].items()}
    seeds = sorted({seed for _, seed in cases})
    rows = []
    for scene in SCENES:
        of, plain = ([cases[name, seed] for seed in seeds] for name in (scene, "plain"))
        words = []
        for pick in (*_PICKS.values(),):
            values, base = [pick(each) for each in of], [pick(each) for each in plain]
            if scene == "plain":
                words.append(f"{np.nanmean(values):.4g}")
            else:
                words.append("{:.2f} ({:.2f} to {:.2f})".format(*change(values, base)))
        rows.append([scene.replace("_", " "), len(seeds), *words])
    heads = ["specimen", "seeds", *_PICKS]
    return "Means of the plain foil, and factors on them with 95 % intervals:\n\n" + markdown_table(
        heads, rows
    )


_PICKS = {
    "axial, N/m": lambda result: stiffness(result)[0],
    "radial, N/m": lambda result: stiffness(result)[1],
    "energy, J": lambda result: result.get("energy", np.nan),
    "shortening spread": lambda result: result.get("shortening_spread", np.nan),
}


def _drawn(records: Records) -> str:
    cases = {(c.meridian, c.overlength_percent, c.size_mm): r.result
             for c, r in records["drawn"].items()}  # fmt: skip
    finest = min(size for _, _, size in cases)
    rows = []
    for percent in OVERLENGTHS_PERCENT:
        fit = (1e-3 * measured_stiffness(name, percent) for name in ("axial", "radial"))
        row = [f"{percent:g}", "{:.3g} / {:.3g}".format(*fit)]
        for meridian in MERIDIANS:
            found = cases[meridian, percent, finest]
            axial, radial = (1e-3 * value for value in stiffness(found))
            row.append(f"{axial:.3g} / {radial:.3g}, {found['energy']:.3g} J")
        rows.append(row)
    heads = ["overlength, %", "measured fit", *(m.replace("_", " ") for m in MERIDIANS)]
    return (
        "Axial / radial stiffness of drawn shapes, kN/m, and their elastic energy:\n\n"
        + markdown_table(heads, rows)
    )


def _shared(records: Records) -> str:
    rows = []
    for law in LAWS:
        for percent in SHARED_PERCENT:
            row = [law, f"{percent:g}"]
            for share in SHARES:
                found = [
                    each for each in of_seeds(records, law, share, percent) if "energy" in each
                ]
                if not found:
                    row.append("no equilibrium")
                    continue
                stored, spent = (
                    np.mean([each[name] for each in found])
                    for name in ("energy", "dissipated_work")
                )
                text = f"{stored:.3g} J" if law == "elastic" else f"{stored:.3g} + {spent:.3g} J"
                row.append(text if len(found) > 1 else f"{text} (one seed)")
            rows.append(row)
    heads = ["law", "overlength, %", *(share.replace("_", " ") for share in SHARES)]
    return "Energy stored (plastic: + work used up), mean of the seeds:\n\n" + markdown_table(
        heads, rows
    )


def _against(records: Records) -> str:
    from scipy.stats import spearmanr

    found = [r.result for r in records["scenes"].values() if "energy" in r.result]
    rows = []
    for name in ("shortening_spread", "axisymmetric_share"):
        measure = [each[name] for each in found]
        row = [name.replace("_", " ")]
        for direction in (0, 1):
            rank = spearmanr(measure, [stiffness(each)[direction] for each in found])
            row.append(f"{rank.statistic:+.2f} (p = {rank.pvalue:.2g})")
        rows.append(row)
    return (
        f"Rank correlation of the stiffness with localisation, {len(found)} crumples of all "
        "scenes:\n\n" + markdown_table(["measure", "axial", "radial"], rows)
    )


def of_seeds(records: Records, law: str, share: str, percent: float) -> list[dict]:
    """What was measured of all seeds."""
    return [
        record.result
        for case, record in records["shared"].items()
        if (case.law, case.share, case.overlength_percent) == (law, share, percent)
    ]


def _released(records: Records) -> str:
    rows = []
    for law in LAWS:
        kind = "" if law == "elastic" else "prestressed"
        for percent in SHARED_PERCENT:
            fit = (1e-3 * measured_stiffness(name, percent) for name in ("axial", "radial"))
            row = [law, f"{percent:g}", "{:.3g} / {:.3g}".format(*fit)]
            for share in ("whole", "half", "third"):
                found = of_seeds(records, law, share, percent)
                row.append(_let_go(found, kind, share != "whole"))
            rows.append(row)
    heads = ["law", "overlength, %", "measured fit", "even", "half, let go", "third, let go"]
    return (
        "Axial / radial stiffness, kN/m, elastic without its stresses, plastic with them, and the "
        "spread of the shortening:\n\n" + markdown_table(heads, rows)
    )


def _let_go(found: Sequence[Mapping[str, Any]], kind: str, released: bool) -> str:
    """Means of the seeds that came to rest."""
    first = "released_" if released else ""
    at_rest = [each for each in found if f"{first}energy" in each]
    if not at_rest:
        return "no equilibrium"
    kind = f"{first}{kind}".rstrip("_")
    axial, radial = 1e-3 * np.mean([stiffness(each, kind) for each in at_rest], axis=0)
    spread = np.mean([each[f"{first}shortening_spread"] for each in at_rest])
    return f"{axial:.3g} / {radial:.3g}, {spread:.2f}"
