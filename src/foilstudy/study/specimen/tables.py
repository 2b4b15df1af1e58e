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
    return _rows(records["shared"])


def _rows(cases: Mapping[Any, Any]) -> list[dict]:
    return [
        {
            **vars(case),
            "status": record.result.get("status", ""),
            "axial": stiffness(record.result)[0],
            "radial": stiffness(record.result)[1],
            **{name: record.result.get(name) for name in _NUMBERS},
        }
        for case, record in cases.items()
    ]


def stiffness(result: Mapping[str, Any]) -> tuple[float, float]:
    """Axial and radial of what was measured, N/m; NaN where it came to nothing."""
    values = result.get("stiffness")
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
    """Three tables for people."""
    return "\n".join([_scenes(records), _drawn(records), _shared(records), _against(records)])


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
    cases = records["shared"]
    rows = []
    for law in LAWS:
        for percent in SHARED_PERCENT:
            row = [law, f"{percent:g}"]
            for share in SHARES:
                found = [r.result for c, r in cases.items()
                         if (c.law, c.share, c.overlength_percent) == (law, share, percent)
                         and "energy" in r.result]  # fmt: skip
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
