"""The data sheet as a page that needs nothing else and prints on one sheet of A4."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import jinja2
import xarray as xr
from markupsafe import Markup

from foilstudy.base.files import written_whole
from foilstudy.base.numerals import fixed, nominal, number, percent, plural
from foilstudy.bench.transfer_level import nominal_hz
from foilstudy.present.comparison import studied_case
from foilstudy.present.configuration import configuration
from foilstudy.present.datasheet.facts import Direction, LinkFacts, Value, link_facts
from foilstudy.present.datasheet.picture import drawn_inline
from foilstudy.present.ramp import haste_findings
from foilstudy.present.strain import strain_findings
from foilstudy.present.width import width_findings

__all__ = ["write_datasheet"]

_MOTIONS = {
    "bottom_ux": "along x, N/m",
    "bottom_uy": "along y, N/m",
    "bottom_uz": "along the axis z, N/m",
    "bottom_rx": "rocking about x, N m/rad",
    "bottom_ry": "rocking about y, N m/rad",
    "bottom_rz": "torsion about z, N m/rad",
}
_NOT_COMPUTED = "not computed"


@dataclass(frozen=True)
class _Row:
    """A line of the table of static stiffness, as it is read."""

    name: str
    mean: str
    interval: str
    scatter: str
    ends: str
    mesh_error: str = ""
    amplitude: str = ""


def write_datasheet(
    cube: xr.Dataset, path: Path, thickness_um: float | None = None, height_mm: float | None = None
) -> LinkFacts:
    """Write the data sheet of one configuration.

    Parameters
    ----------
    cube : xarray.Dataset
        As `open_cube` gives it.
    path : Path
        Of the page; it appears complete or not at all.
    thickness_um, height_mm : float, optional
        May be left out where the cube has one; the height is that of the uncrumpled cylinder.

    Returns
    -------
    LinkFacts
        What it says.

    Raises
    ------
    Refusal
        If the cube does not have the configuration, or none of its realisations counts.
    """
    facts = link_facts(cube, thickness_um, height_mm)
    page = _template().render(_content(cube, facts))
    with written_whole(path) as partial:
        partial.write_text(page, encoding="utf-8")
    return facts


@cache
def _template() -> jinja2.Template:
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template("datasheet.html")


def _content(cube: xr.Dataset, facts: LinkFacts) -> dict:
    material = configuration(cube).get("material") or {}
    alone = cube.sel(thickness=[facts.thickness_um])
    name = f"{material['name']}, " if material.get("name") else ""
    return {
        "title": (
            f"Crumpled foil link: {name}{nominal(facts.thickness_um)} µm, "
            f"{nominal(facts.height_mm)} mm"
        ),
        "scope": _scope(cube, facts),
        "counted": _counted(facts),
        "doubts": [
            *_doubts(facts),
            *haste_findings(alone),
            *width_findings(alone),
            *strain_findings(alone.sel(overlength=[facts.overlength_percent])),
        ],
        "static": list(_static_rows(facts)),
        "static_words": _static_words(facts),
        "first_words": _first_words(facts),
        "band_words": _band_words(facts),
        "picture": Markup(drawn_inline(facts)),
        "names": [each.name for each in facts.directions],
        "bands": _halves(list(_band_rows(facts.directions))),
        "provenance": _provenance(cube),
    }


def _scope(cube: xr.Dataset, facts: LinkFacts) -> str:
    text = f"Overlength {nominal(facts.overlength_percent)} %"
    if case := studied_case(cube):
        text = (
            f"Cylinder {nominal(case.diameter_mm)} mm in diameter and "
            f"{nominal(facts.height_mm)} mm high, crumpled into a gap of "
            f"{nominal(case.gap_height_mm)} mm (overlength {nominal(facts.overlength_percent)} %); "
            f"E = {nominal(case.youngs_modulus_mpa)} MPa, ν = {nominal(case.poisson_ratio)}, "
            f"{nominal(case.density_kg_m3)} kg/m³"
        )
    air = configuration(cube).get("air", {}).get("kind", "none")
    surroundings = "in vacuum" if air == "none" else "its dynamics in air"
    stress = "Stress-free in its crumpled shape where nothing else is said"
    return f"{text}. {stress}; both rings rigid; {surroundings}."


def _counted(facts: LinkFacts) -> str:
    text = f"Of {plural(facts.realisations, 'realisation')} (seeds), {facts.counted} in the numbers"
    if facts.not_converged:
        text += f", {facts.not_converged} of them not converged"
    return f"{text}."


def _doubts(facts: LinkFacts) -> Iterator[str]:
    for each in facts.directions:
        if each.doubts:
            yield f"Do not trust the {each.name} stiffness: {'; '.join(each.doubts)}."
    if facts.counted < 3:
        known = "not known" if facts.counted == 1 else "little more than a guess"
        yield f"{plural(facts.counted, 'realisation')}: how much such links differ is {known}."


def _static_rows(facts: LinkFacts) -> Iterator[_Row]:
    for each in facts.directions:
        best = each.limit if each.limit.known else each.static
        yield _row(f"{each.name}, N/m", best, percent(each.mesh_error), _amplitude(each, facts))
        for words, value in each.beside.items():
            yield _row(f"{each.name}, {words}, N/m", value)
    for name, value in facts.motions.items():
        yield _row(_MOTIONS[name], value)


def _row(name: str, value: Value, mesh_error: str = "", amplitude: str = "") -> _Row:
    known = value.interval
    return _Row(
        name,
        number(known.mean),
        _span(known.low, known.high),
        percent(known.cv),
        _span(value.least, value.most),
        mesh_error,
        amplitude,
    )


def _span(low: float, high: float) -> str:
    if not (math.isfinite(low) and math.isfinite(high)):
        return number(math.nan)
    return f"{number(low)} to {number(high)}"


def _amplitude(direction: Direction, facts: LinkFacts) -> str:
    value = direction.amplitude
    if value is None or not value.known:
        return _NOT_COMPUTED
    ends = _span(value.least, value.most)
    return f"{number(value.interval.mean, 2)} {facts.amplitude_unit} ({ends})"


def _static_words(facts: LinkFacts) -> str:
    where = "in the limit of a fine mesh, of the shapes as they crumpled"
    if not any(each.limit.known for each in facts.directions):
        where = "on the mesh on which the shapes crumpled; no mesh error is stated"
    text = (
        f"Axial and radial: {where}; radial is the mean of x and y. The six motions below them: on "
        "the mesh on which they crumpled, about the centre of the ring, the other ring held."
    )
    if any(each.beside for each in facts.directions):
        text += (
            " Rows under axial and radial: on the mesh on which they crumpled, stress-free by what "
            "closed contacts do; as it stands: with its stresses, by its tangent and by small "
            "motions of the ring one way and the other."
        )
    if all(each.amplitude is None for each in facts.directions):
        text += " The amplitude at which the stiffness has changed by 1 % was not computed."
    return text


def _first_words(facts: LinkFacts) -> str:
    first, known = facts.first_hz, facts.first_hz.interval
    if not first.known:
        return "The first eigenfrequency with both rings held is not known."
    text = f"First eigenfrequency with both rings held: {number(known.mean)} Hz"
    if math.isfinite(known.low):
        text += f" (95 %: {_span(known.low, known.high)} Hz)"
    if first.most > first.least:
        text += f", least to largest {_span(first.least, first.most)} Hz"
    return f"{text}."


def _band_words(facts: LinkFacts) -> str:
    low, high = facts.band_hz
    text = f"Dynamic stiffness valid from {number(low)} to {number(high)} Hz in all realisations"
    if facts.valid_to_hz < facts.frequencies[-1]:
        text += f" (simulated to {number(float(facts.frequencies[-1]))} Hz)"
    return f"{text}, on the mesh on which the shapes crumpled."


def _band_rows(directions: tuple[Direction, ...]) -> Iterator[list[str]]:
    """One for each band that any direction has: nominal frequency, mean and ends of each."""
    centres = sorted({float(f) for each in directions for f in each.bands.centres})
    for centre in centres:
        row = [f"{nominal_hz(centre):g}"]
        for each in directions:
            at = each.bands.centres == centre
            if at.any():
                mean, least, most = (
                    float(values[at][0])
                    for values in (each.bands.mean, each.bands.least, each.bands.most)
                )
                row += [fixed(mean, 1), f"{fixed(least, 1)} to {fixed(most, 1)}"]
            else:
                row += [number(math.nan)] * 2
        yield row


def _halves(rows: list[list[str]]) -> list[list[list[str]]]:
    middle = -(-len(rows) // 2)
    return [half for half in (rows[:middle], rows[middle:]) if half]


def _provenance(cube: xr.Dataset) -> str:
    names = {"study": "study", "created": "of", "git_commit": "commit"}
    found = [f"{words} {cube.attrs[name]}" for name, words in names.items() if name in cube.attrs]
    return f"foilstudy; {', '.join(found)}." if found else "foilstudy."
