"""Assemble ``report.html``: findings, figures, shapes, health and provenance on one page."""

import base64
import hashlib
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import jinja2
import pandas as pd
import xarray as xr

from foilstudy.base import numerals
from foilstudy.base.files import written_whole
from foilstudy.config.chosen import accuracy_words
from foilstudy.config.departures import departures
from foilstudy.plot.save import inches_wide
from foilstudy.present.comparison import comparable, comparison_sentence, studied_case
from foilstudy.present.configuration import configuration, isolation_options, study_of
from foilstudy.present.figures import FIGURES
from foilstudy.present.files import StudyFiles
from foilstudy.present.ramp import haste_findings
from foilstudy.present.report import (
    beside,
    distrust,
    equilibrium,
    exponents,
    findings,
    grid,
    isolation,
    laws,
    mesh,
    modes,
    prestress,
    small_motions,
    true_state,
    viewer,
)
from foilstudy.present.report.alt import alt_text
from foilstudy.present.report.health import assess
from foilstudy.present.report.verdicts import found_verdicts
from foilstudy.present.statistics.cells import realised
from foilstudy.present.statistics.tables import TABLES
from foilstudy.present.statistics.trust import assess_trust
from foilstudy.present.strain import strain_findings
from foilstudy.present.width import width_findings
from foilstudy.study.sweep.origins import physics_codes

TEMPLATES = Path(__file__).parent / "templates"

SCRIPTS = ("enlarge.js", "viewer.js")
"""Make up the one script of the page."""

SECTIONS = {
    "stiffness": ("stiffness_axial", "stiffness_radial"),
    "shapes": ("morphology", "seeds"),
    "static": ("stiffness_map", "fit_quality"),
    "prestress": ("prestressed",),
    "variability": ("variability",),
    "dynamic": ("dynamic_stiffness", "convergence_high_frequency"),
    "eigenfrequency": ("eigenfrequency_law", "modal_density", "mac_seeds"),
    "isolation": ("design_chart", "transmissibility"),
    "mesh": ("mesh_error", "energy"),
    "health": ("history",),
}
"""Where each figure stands; one not named here follows the last of the results."""

SVG_BYTES_MAX = 600_000
"""A larger vector drawing is slower to show than its picture in dots."""

CSS_PIXELS_PER_INCH = 96


@dataclass(frozen=True)
class Figure:
    """A picture as it stands in the page."""

    id: str
    title: str
    caption: str
    alt: str
    source: str
    width: int | None


def write_report(files: StudyFiles, out_path: Path) -> Path:
    """Write the self-contained report of a study.

    Parameters
    ----------
    files
        Cube, tables, figures and records of one study. Of the figures those stand in the page that
        have been drawn; a handful of the shapes is chosen for the 3-D view.
    out_path
        The page to write. It appears complete or not at all.

    Returns
    -------
    Path
        ``out_path``.

    Raises
    ------
    FileNotFoundError
        If a table is missing.
    Refusal
        If the cube is missing or is none.
    """
    out_path = Path(out_path)
    content = _content(files, out_path.parent)
    page = _environment().get_template("report.html").render(content)
    with written_whole(out_path) as partial:
        partial.write_text(page, encoding="utf-8")
    return out_path


@cache
def _environment() -> jinja2.Environment:
    """One for all pages of a process, as reading the templates takes longer than filling them."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    for name in ("number", "nominal", "fixed", "percent", "duration", "plural", "stiffness"):
        environment.filters[name] = getattr(numerals, name)
    return environment


def _content(files: StudyFiles, folder: Path) -> dict:
    cube = files.cube
    tables = {name: pd.read_csv(files.table(name)) for name in TABLES}
    powerlaw, summary = tables["powerlaw"], tables["stiffness_summary"]
    variability, eigenfrequency = tables["variability"], tables["eigenfrequency_law"]
    config = configuration(cube)
    health = assess(cube, files.benchmarks)
    settling = equilibrium.assess_equilibrium(cube, config)
    mesh_errors = mesh.assess_mesh(cube)
    trust, reference, case = assess_trust(cube), comparable(cube), studied_case(cube)
    scale = case and (case.diameter_mm / 2, case.youngs_modulus_mpa)
    read_laws = laws.read_laws(powerlaw, summary, scale)
    chosen = viewer.choose_shapes(files.crumple_paths)
    shapes = viewer.viewer_data(chosen, files.response_paths)
    script = "".join((TEMPLATES / name).read_text("utf-8") for name in SCRIPTS)
    bracket_title, bracket_picture = small_motions.bracket_picture(cube)
    said = {
        "stiffness_words": findings.stiffness_findings(summary),
        "fit_words": laws.fit_findings(read_laws),
        "prestress_words": prestress.prestress_findings(cube, variability, read_laws),
        "variability_words": findings.variability_findings(variability),
        "dynamic_words": findings.dynamic_findings(cube),
        "overlength_words": modes.overlength_findings(cube),
        "eigenfrequency_words": findings.eigenfrequency_findings(eigenfrequency, cube),
        "modal_density_words": modes.modal_density_findings(cube),
        "isolation_words": isolation.isolation_findings(
            tables["isolation"], isolation_options(cube)
        ),
        "mesh_words": [mesh.mesh_sentence(mesh_errors, config)],
        "stated_error_words": [mesh.stated_error_sentence(mesh_errors)],
        "shape_words": findings.shape_findings(cube, reference),
    }
    return said | {
        "title": config.get("report", {}).get("title", "Crumpled foil"),
        "study": cube.attrs.get("study", ""),
        "scope": _scope(cube, config),
        "grids": grid.stiffness_grids(summary),
        "grid_caption": grid.grid_caption(summary),
        "true_grids": true_state.true_grids(cube),
        "sure_words": [
            *true_state.true_findings(cube),
            *grid.sureness(summary),
            *haste_findings(cube),
            *width_findings(cube),
            *strain_findings(cube),
            *grid.wish_findings(summary, config.get("sweep", {}).get("realisations_max")),
            *_other_physics(cube),
        ],
        "banner": distrust.banner(cube, trust),
        "laws": read_laws,
        "law_scope": laws.scope_of,
        "gap_over_diameter": case and case.gap_height_mm / case.diameter_mm,
        "comparison_words": comparison_sentence(cube),
        "exponent_words": exponents.exponent_findings(read_laws),
        "locking_words": mesh.PUBLISHED_LOCKING if reference else "",
        "middle": laws.middle_of_sweep(summary),
        "prestress_rows": prestress.prestress_rows(cube, variability),
        "relaxed_words": prestress.relaxed_findings(cube),
        "relaxed_rows": prestress.relaxed_rows(cube),
        "secant_words": small_motions.secant_findings(cube),
        "secant_rows": small_motions.secant_rows(cube),
        "bracket_words": small_motions.bracket_findings(cube),
        "bracket_rows": small_motions.bracket_rows(cube),
        "bracket_kinds": small_motions.WORDS,
        "bracket_title": bracket_title,
        "bracket_picture": bracket_picture and _data_address(bracket_picture, "svg+xml"),
        "bend_words": laws.bend_sentence(read_laws),
        "mesh": mesh_errors,
        "share_words": mesh.share_sentence(config),
        "equilibrium": settling,
        "equilibrium_words": equilibrium.equilibrium_findings(settling),
        "health": health,
        "verdicts": found_verdicts(cube),
        "health_words": findings.health_sentence(health),
        "figures": _figures(files, _seen(said)),
        "measurements": [
            (each, _data_address(each.picture, "svg+xml"))
            for each in beside.measurements(cube, files.measured)
        ],
        "viewer": shapes,
        "has_records": bool(files.crumple_paths),
        "gradient": _gradient(viewer.colour_table()),
        "motion_gradient": _gradient(viewer.motion_table()),
        "style": (TEMPLATES / "report.css").read_text("utf-8"),
        "script": script,
        "script_hash": base64.b64encode(hashlib.sha256(script.encode()).digest()).decode(),
        "config": cube.attrs.get("config", ""),
        "provenance": _provenance(cube),
        "citation": reference and reference.citation,
        "files": _files(files, folder),
    }


def _scope(cube: xr.Dataset, config: Mapping) -> list[str]:
    """Say in a few phrases what was simulated."""

    def span(name: str, noun: str, unit: str) -> str:
        values = cube[name].values
        ends = numerals.nominal(float(values[0]))
        if values.size > 1:
            ends += f" to {numerals.nominal(float(values[-1]))}"
        return f"{numerals.plural(values.size, noun)} ({ends} {unit})"

    phrases = [
        f"{span('thickness', 'thickness', 'µm')} × {span('overlength', 'overlength', '%')} × "
        f"{_seeds(cube)}"
    ]
    sheet, material = config.get("sheet", {}), config.get("material", {})
    if sheet:
        phrases.append(
            f"cylinder {numerals.nominal(sheet['diameter_mm'])} mm in diameter, crumpled into a "
            f"gap of {numerals.nominal(sheet['gap_height_mm'])} mm"
        )
    if material:
        phrases.append(
            f"{material['name']}, E = {numerals.nominal(material['youngs_modulus_mpa'])} MPa, "
            f"ν = {numerals.nominal(material['poisson_ratio'])}"
        )
    phrases += (f"{name}: {words}" for name, words in departures(config))
    if "mesh" in config:
        phrases.append(f"{mesh.element_kind(config)} elements {_element_size(config['mesh'])}")
    if "accuracy" in config:
        phrases.append(f"accuracy {accuracy_words(config)}")
    return phrases


def _seeds(cube: xr.Dataset) -> str:
    counts = realised(cube).sum("seed").values
    least, most = int(counts.min()), int(counts.max())
    return f"{least} to {most} seeds" if least < most else numerals.plural(most, "seed")


def _element_size(section: dict) -> str:
    size = section["element_size_mm"]
    if size == "auto":
        error = numerals.nominal(section["energy_error_percent"])
        return f"sized for an energy error of {error} %"
    return f"of {numerals.nominal(size)} mm"


def _seen(said: Mapping[str, list[str]]) -> dict[str, list[str]]:
    """What the page says of the data of a figure, by its id."""
    by_direction = {
        f"stiffness_{direction}": [text for text in said["stiffness_words"] if direction in text]
        for direction in ("axial", "radial")
    }
    sources = {
        "morphology": "shape_words",
        "seeds": "shape_words",
        "stiffness_map": "stiffness_words",
        "fit_quality": "fit_words",
        "prestressed": "prestress_words",
        "variability": "variability_words",
        "dynamic_stiffness": "dynamic_words",
        "convergence_high_frequency": "overlength_words",
        "eigenfrequency_law": "eigenfrequency_words",
        "modal_density": "modal_density_words",
        "design_chart": "isolation_words",
        "transmissibility": "isolation_words",
        "mesh_error": "stated_error_words",
    }
    return by_direction | {name: said[words] for name, words in sources.items()}


def _figures(files: StudyFiles, seen: Mapping[str, list[str]]) -> dict[str, list[Figure]]:
    """Embed every figure of the study that there is, by section."""
    folder = Path(files.figures)
    stems = {path.stem for path in folder.glob("*") if path.suffix in (".png", ".svg")}
    stems -= files.left_out
    placed = {stem: name for name, order in SECTIONS.items() for stem in order}
    sections: dict[str, list[Figure]] = {name: [] for name in (*SECTIONS, "other")}
    for stem in [*placed, *(stem for stem in FIGURES if stem not in placed)]:
        if stem in stems:
            entry = FIGURES[stem]
            picture = _picture(folder, stem)
            sections[placed.get(stem, "other")].append(
                Figure(
                    stem, entry.title, entry.caption, alt_text(stem, entry.title, seen), *picture
                )
            )
    return sections


def _picture(folder: Path, stem: str) -> tuple[str, int | None]:
    """Return the data address of a figure, and its width in CSS pixels where the file lacks it."""
    vector, dots = folder / f"{stem}.svg", folder / f"{stem}.png"
    if vector.exists() and (not dots.exists() or vector.stat().st_size <= SVG_BYTES_MAX):
        return _data_address(vector.read_bytes(), "svg+xml"), None
    return _data_address(dots.read_bytes(), "png"), round(inches_wide(dots) * CSS_PIXELS_PER_INCH)


def _data_address(content: bytes, kind: str) -> str:
    return f"data:image/{kind};base64,{base64.b64encode(content).decode('ascii')}"


def _gradient(colours) -> str:
    """CSS stops of a table of colours, from its first to its last."""
    return ", ".join("rgb({}, {}, {})".format(*rgb) for rgb in colours[::17])


def _provenance(cube: xr.Dataset) -> list[tuple[str, str]]:
    rows = [
        (name.replace("_", " "), str(value))
        for name, value in cube.attrs.items()
        if name not in ("config", "task")  # the one stands below, the other says the same
    ]
    return rows


def _other_physics(cube: xr.Dataset) -> list[str]:
    """A sentence where the code of today would not crumple or measure as that of the cube."""
    study = study_of(cube)
    if study and all(cube.attrs.get(k) == code for k, code in physics_codes(study).items()):
        return []
    return [
        "The code that crumples or measures has changed since this cube was made; running the "
        "study again makes its realisations anew."
    ]


def _files(files: StudyFiles, folder: Path) -> list[tuple[str, str, str]]:
    """Links to the files that the page was made from: text, relative address, content."""
    described = [
        (files.cube_path, "all numbers of all realisations (NetCDF-4)"),
        *((files.table(name), table.title) for name, table in TABLES.items()),
        (files.figures, "the figures as PNG and SVG"),
    ]
    links = []
    for path, meaning in described:
        relative = Path(os.path.relpath(path, folder)).as_posix()
        links.append((relative, jinja2.filters.do_urlencode(relative), meaning))
    return links
