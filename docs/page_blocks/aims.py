"""Block of what was aimed at in speed, beside what was measured."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from page_blocks.study import Study, rows

_MEASURED = Path(__file__).parents[2] / "benchmarks" / "results.md"
_JOBS = ("crumple", "static", "dynamic")


def aims(
    thesis: Study, resolved: Study, thin: Study, tradeoff: Study, accuracy: Study
) -> Iterator[str]:
    """Aims of studies, of parts of a job, of a step, and of the steps of a real foil."""
    static = tradeoff.table("tradeoff").query("default and setting == 'refinements at most'")
    seconds = static.groupby("ladder")["seconds"].first()
    whole = int((resolved.cube["status"] == "converged").sum())
    slowest = float(thin.cube["seconds_crumple"].max()) / 60
    tallest = thesis.cube["seconds_dynamic"].isel(overlength=-1)
    reduced = float(tallest.sel(thickness=min(thesis.thicknesses)).median())
    looks = accuracy.table("trials").query("step == 'quick'")["seconds_crumple"]
    near = ", ".join(_row("Real foil", overlength)[4] for overlength in ("15 %", "31 %"))
    crumple, whole_one = (
        _first(_row("Jobs", words)[0]) for words in ("0.17 m, 5 mm, 4000 steps", "500 um, 0.17 m")
    )
    of_parts = ", ".join(f"{seconds[f'static, {thickness} um']:.2g}" for thickness in (500, 50))
    steps = ", ".join(_first(each) for each in _row("Kernels", "whole step"))
    body = {
        "published study, minutes of processor": ("8", f"{_minutes(thesis):.0f}", _on(thesis)),
        "resolved study, 120 realisations, minutes of processor": (
            "120", f"{_minutes(resolved):.0f} for {whole}, without 50 µm", _on(resolved),
        ),
        "crumple of 50 µm, 0.25 m, 1.25 mm, minutes": (
            "1.7", f"{slowest:.0f}, the longest on 1.02 mm", _on(thin),
        ),
        "crumple of 500 µm, 0.17 m, 5 mm to 1e-8, s": (
            "1.0", f"{crumple} for 4 000 steps, {whole_one} for 8 000 and to rest", _page("Jobs"),
        ),
        "the same by `quick`, not told from ten times its steps, s": (
            "0.4", f"{looks.median():.2g}", "EPYC, beside other work",
        ),
        "step, 5, 2.5, 1.25 mm, ns an element": ("50, 50, 60", steps, _page("Kernels")),
        "static stiffness with stated error, 500, 50 µm, s": (
            "2, 6", of_parts, "Xeon, beside another study",
        ),
        "dynamic reduction, 50 µm, 0.25 m, 5 mm, s": ("3", f"{reduced:.2g}", _on(thesis)),
        "physics in the time of a study, at least": (
            "80 %", _first(_row("Jobs", "physics of the time")[0]), _page("Jobs"),
        ),
        "plastic over elastic step, 500 µm, 31 %": (
            "1.8", _row("Real foil", "31 %")[3], _page("Real foil"),
        ),
        "step with contact over one without, 92 %": (
            "3", _row("Real foil", "92 %")[4], _page("Real foil"),
        ),
        "the same where nothing is near, 15, 31 %": ("1", near, _page("Real foil")),
        "everything at once, 500 µm, 31 %, 5 mm, with statics, s": (
            "8", _row("Real foil", "everything at once")[0], _page("Real foil"),
        ),
    }  # fmt: skip
    yield from rows(
        ["", "aimed at, at most", "measured", "on"],
        [[name, *cells] for name, cells in body.items()],
    )


def _minutes(study: Study) -> float:
    return sum(float(study.cube[f"seconds_{name}"].sum()) for name in _JOBS) / 60


def _on(study: Study) -> str:
    return _short(study.cube.attrs["machine"])


def _short(machine: str) -> str:
    """The maker's name of a processor."""
    return next((name for name in ("Xeon", "EPYC") if name in machine), machine)


@cache
def _sections() -> dict[str, str]:
    """Of the page of measurements, by their titles."""
    parts = re.split(r"^## (.+)$", _MEASURED.read_text("utf-8"), flags=re.MULTILINE)[1:]
    return dict(zip(parts[::2], parts[1::2], strict=True))


def _section(title: str) -> str:
    return next(text for name, text in _sections().items() if name.startswith(title))


def _page(title: str) -> str:
    return _short(_section(title).strip().splitlines()[0])


def _row(title: str, words: str) -> list[str]:
    """Cells behind the first one of the row of a section that has these words in it."""
    lines = (line.split("|")[1:-1] for line in _section(title).splitlines() if "|" in line)
    return next([cell.strip() for cell in cells[1:]] for cells in lines if words in cells[0])


def _first(cell: str) -> str:
    """Of a cell with further numbers in brackets or behind a comma."""
    return re.split(r"[,(]", cell)[0].strip().removesuffix(" s")
