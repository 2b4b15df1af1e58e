"""Tables of the amplitude study, for programs and for people."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np

from foilstudy.base.tables import markdown_table
from foilstudy.measure.amplitude.curve import GOOD, LINEAR_SHARE
from foilstudy.study.amplitude.plan import AMPLITUDE_MM
from foilstudy.study.kernel.plan import Results

_COLUMNS = ("force", "secant", "tangent", "energy", "released", "status")


def steps(findings: Results) -> list[dict]:
    """One row per step of a sweep; SI."""
    return [
        asdict(case) | {"way": side["motion"][k]} | {name: side[name][k] for name in _COLUMNS}
        for case, found in findings["sweeps"].items()
        for side in found["sides"]
        for k in range(len(side["motion"]))
    ]


def linear(findings: Results) -> list[dict]:
    """One row per sweep: amplitudes of a change of one per cent, and what it met."""
    return [
        asdict(case)
        | {
            "stiffness": found["stiffness"],
            "linear_amplitude_mm": _mm(found["linear_amplitude"]),
            "linear_of_tangent_mm": _mm(found["linear_of_tangent"]),
            "even_share": found["even_share"],
            "snaps": _snaps(found),
            "message": found["message"],
        }
        for case, found in findings["sweeps"].items()
    ]


def spreads(findings: Results) -> list[dict]:
    """One row per crumple of those that are swept to a change of one per cent only."""
    return [
        asdict(case)
        | {
            "stiffness": found["stiffness"],
            "linear_amplitude_mm": _mm(found["linear_amplitude"]),
            "ended_early": found["ended_early"],
            "message": found["message"],
        }
        for case, found in findings["spreads"].items()
    ]


def _medians(findings: Results) -> list[list]:
    """One row per foil, state and motion: median over the seeds, smallest, largest.

    What lies beyond the sweep counts as larger than all else. An amplitude that is not known, as
    its sweep ended early, is left out and counted.
    """
    groups: dict[tuple, list[dict]] = {}
    for case, found in findings["spreads"].items():
        groups.setdefault((case.words, case.motion), []).append(found)
    rows = []
    for names, group in groups.items():
        known = [each for each in group if not each["ended_early"]]
        ways = [np.inf if (w := each["linear_amplitude"]) is None else 1e3 * w for each in known]
        middle = np.median(ways) if ways else np.nan
        ends = (min(ways), max(ways)) if ways else (np.nan, np.nan)
        stiffnesses = [each["stiffness"] for each in group]
        rows.append(
            [
                *names,
                f"{np.median(stiffnesses):.4g}",
                *map(_bounded, (middle, *ends)),
                f"{len(known)} of {len(group)}",
            ]
        )
    return rows


def _bounded(millimetres: float) -> str:
    return f"> {AMPLITUDE_MM:g}" if np.isinf(millimetres) else f"{millimetres:.2g}"


def modes(findings: Results) -> list[dict]:
    """One row per mode."""
    return [
        asdict(case) | {"mode": k} | one | {"shift_amplitude": _mm(one["shift_amplitude"])}
        for case, found in findings["modes"].items()
        for k, one in enumerate(found["modes"], 1)
    ]


def releases(findings: Results) -> list[dict]:
    """One row per mode that was let go."""
    return [asdict(case) | found for case, found in findings["releases"].items()]


def page(findings: Results) -> str:
    """The same as the page of the documentation shows it."""
    swept = [
        [
            case.words,
            case.motion,
            case.seed,
            f"{row['stiffness']:.4g}",
            _amplitude(row["linear_amplitude_mm"], found),
            _amplitude(row["linear_of_tangent_mm"], found),
            "–" if row["even_share"] is None else f"{100 * row['even_share']:.2g} %",
            row["snaps"],
        ]
        for (case, found), row in zip(findings["sweeps"].items(), linear(findings), strict=True)
    ]
    share = f"{100 * LINEAR_SHARE:g} %"
    heads = ["foil", "motion", "seed", "stiffness, N/m", f"secant by {share}, mm"]
    heads += [f"tangent by {share}, mm", "even force", "snaps"]
    vibrating = [
        [
            case.words, case.seed, k, f"{one['frequency']:.4g}",
            f"{100 * one['gap']:.2g} %",
            f"{_mm(one['shift_amplitude']):.3g}",
            "hardens" if one["bend"] > 0 else "softens",
            f"{100 * one['condensation_error']:.2g} %",
        ]
        for case, found in findings["modes"].items()
        for k, one in enumerate(found["modes"], 1)
    ]  # fmt: skip
    let = [
        [case.words, case.mode, f"{case.displacement_mm:g}", *map(_percent, shifts)]
        for case, found in findings["releases"].items()
        for shifts in ([found[n] for n in ("integrated", "normal_form", "condensed")],)
    ]
    return "\n".join(
        (
            markdown_table(heads, swept),
            markdown_table(
                ["foil", "motion", "stiffness, median, N/m", f"secant by {share}, median, mm",
                 "smallest, mm", "largest, mm", "seeds"],
                _medians(findings),
            ),
            markdown_table(
                ["foil", "seed", "mode", "Hz", "next mode", f"{share} of frequency at, mm", "it",
                 "error of condensation"],
                vibrating,
            ),
            markdown_table(
                ["foil", "mode", "let go at, mm", "time integration", "normal form", "condensed"],
                let,
            ),
        )
    )  # fmt: skip


def _snaps(found: dict) -> int:
    return sum(side["status"].count("snapped") for side in found["sides"])


def _mm(metres: float | None) -> float | None:
    return None if metres is None else 1e3 * metres


def _amplitude(millimetres: float | None, found: dict) -> str:
    if millimetres is not None:
        return f"{millimetres:.2g}"
    ends = [status for side in found["sides"] for status in side["status"][-1:]]
    whole = len(ends) == 2 and all(end in GOOD for end in ends)
    return f"> {AMPLITUDE_MM:g}" if whole else "–"


def _percent(share: float | None) -> str:
    return "–" if share is None else f"{100 * share:+.3g} %"
