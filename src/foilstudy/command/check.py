"""`foilstudy check`: what a configuration means, and what it will cost."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING

from foilstudy.base.numerals import duration, plural, times

from .options import Cores, read_study
from .run import study_folder

if TYPE_CHECKING:
    from foilstudy.config import StudyConfig
    from foilstudy.study.sweep.expected import Expected, ExpectedConfiguration

__all__ = ["check"]

_HEADS = (
    "thickness",
    "elements",
    "size",
    "by",
    "refined to",
    "steps",
    "time of each",
    "memory of a job",
)


def check(file: Path, /, *, cores: Cores = 2) -> None:
    """Say what a configuration means and what it will cost, or what is wrong with it.

    Nothing is started. The expected cost rests on studies that were measured. What is possible
    but most likely a slip is named at the end.

    Parameters
    ----------
    file : Path
        YAML file of the study.
    """
    from foilstudy.config.slips import hurried, known_to_fail, likely_slips, unresolved
    from foilstudy.study.sweep.expected import costly, expected

    study = read_study(file)
    if study.report.measured:
        from foilstudy.present.measured_files import measured_of  # which loads netCDF4

        measured_of(study, study_folder())
    cost = expected(study)
    lines = [f"{file}: no problem; results go to results/{study.study.name}.", ""]
    lines += (f"{name:10} {text}" for name, text in _resolved(study))
    lines += ["", *_table(study, cost), "", *_summary(cost, cores), *_least(study, cores)]
    lines += ["", *found] if (found := [*unresolved(study), *hurried(study)]) else []
    if failing := known_to_fail(study):
        lines += ["", "Known to fail (docs/limits.md):", *failing]
    if slips := [*likely_slips(study), *costly(cost)]:
        lines += ["", "Possible, but most likely a slip:", *slips]
    print("\n".join(lines))


def _resolved(study: StudyConfig) -> Iterator[tuple[str, str]]:
    """What was written, and what defaults, `accuracy` and `auto` became."""
    from foilstudy.config.chosen import accuracy_words
    from foilstudy.config.departures import departures

    sheet, material, imperfection = study.sheet, study.material, study.imperfection
    yield (
        "foil",
        f"{material.name} ({material.youngs_modulus_mpa:g} MPa, {material.poisson_ratio:g}, "
        f"{material.density_kg_m3:g} kg/m3), diameter {sheet.diameter_mm:g} mm, "
        f"gap {sheet.gap_height_mm:g} mm",
    )
    yield "accuracy", accuracy_words(study.model_dump())
    yield "heights", ", ".join(f"{height:g}" for height in study.reference_heights_mm) + " mm"
    yield "overlength", ", ".join(f"{share:.3g}" for share in study.overlengths_percent) + " %"
    yield "number", _realisations(study)
    length = imperfection.correlation_length_mm
    correlated = f", correlated over {length:g} mm" if length else ""
    mesh, relaxation, dynamics = study.mesh, study.relaxation, study.dynamics
    error = mesh.energy_error_percent
    auto = "" if error is None else f" for {error:g} % of energy error"
    yield (
        "crumple",
        f"{mesh.element} elements{auto}; {imperfection.kind} imperfection of "
        f"{imperfection.amplitude_um:g} um{correlated}; {_ramp(study)} steps of ramp, at "
        f"most {_most_steps(study)} after it, to a residual of "
        f"{relaxation.residual_tolerance:g}",
    )
    yield from departures(study.model_dump(mode="json"))
    stiffness = study.stiffness
    demand = (
        "" if stiffness.error_percent is None else f"to {stiffness.error_percent:g} %, at most "
    )
    sides = " and ".join(f"{direction}ly" for direction in stiffness.one_sided)
    yield (
        "stiffness",
        f"shape refined {demand}{times(stiffness.refinements)}, equilibrium refined "
        f"{times(stiffness.relaxed_refinements)}"
        + (f"; loading and unloading {sides}" if sides else ""),
    )
    yield (
        "dynamics",
        f"{dynamics.reduction} to {dynamics.tolerance:g}, {dynamics.frequencies} frequencies from "
        f"{dynamics.shown_min_hz:g} to {dynamics.shown_max_hz:g} Hz, {dynamics.damping} damping of "
        f"{dynamics.damping_percent:g} %"
        + (f"; closed contacts {', '.join(dynamics.contacts)}, too" if dynamics.contacts else ""),
    )
    if study.export.formats:
        yield "export", ", ".join(study.export.formats)


def _ramp(study: StudyConfig) -> str:
    steps = [study.relaxation_of(thickness).ramp_steps for thickness in study.thicknesses_um]
    return _range(min(steps), max(steps))


def _most_steps(study: StudyConfig) -> str:
    steps = [study.relaxation_of(each).relaxation_steps_max for each in study.thicknesses_um]
    return _range(min(steps), max(steps))


def _realisations(study: StudyConfig) -> str:
    sweep = study.sweep
    each = f"for each of {plural(len(study.cells()) // len(study.seeds), 'configuration')}"
    if not sweep.in_rounds:
        return f"{sweep.realisations} {each}"
    return (
        f"auto, {study.sweep.fewest} to {sweep.most} {each}, until the 95 % interval of the mean "
        f"stiffness is within {study.report.confidence_percent:g} % of it"
    )


def _table(study: StudyConfig, cost: Expected) -> Iterator[str]:
    """One line for each thickness, its heights as ranges."""
    by_thickness = groupby(cost.configurations, lambda each: each.thickness_um)
    rows = [_HEADS, *(_row(study, list(heights)) for _, heights in by_thickness)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(_HEADS))]
    for row in rows:
        yield "  ".join(f"{cell:>{width}}" for cell, width in zip(row, widths, strict=True))


def _row(study: StudyConfig, heights: list[ExpectedConfiguration]) -> tuple[str, ...]:
    first, last = heights[0], heights[-1]  # the shortest cylinder and the longest
    refined = _range(first.elements[-1], last.elements[-1]) if len(first.elements) > 1 else "-"
    return (
        f"{first.thickness_um:g} um",
        _range(first.elements[0], last.elements[0]),
        f"{study.mesh_of(first.thickness_um).element_size_mm:g} mm",
        study.sized_by(first.thickness_um),
        refined,
        _two_digits(first.steps),
        _range(_two_digits(first.seconds), _two_digits(last.seconds)) + " s",
        _range(*(f"{each.peak_memory_mb / 1000:.1f}" for each in (first, last))) + " GB",
    )


def _range(first: object, last: object) -> str:
    return " to ".join(dict.fromkeys((f"{first}", f"{last}")))


def _two_digits(value: float) -> str:
    return f"{float(f'{value:.2g}'):g}"


def _least(study: StudyConfig, cores: int) -> Iterator[str]:
    """What the first round costs, where all the above is of as many realisations as may be."""
    from foilstudy.study.sweep.expected import expected

    if study.sweep.in_rounds:
        cost = expected(study.with_fewest())
        yield (
            f"With {study.sweep.fewest} realisations of each configuration about "
            f"{duration(cost.processor_seconds, 2)} of processor time, "
            f"{duration(cost.wall_seconds(cores), 2)} on {plural(cores, 'free core')}: the least, "
            "the above is the most."
        )


def _summary(cost: Expected, cores: int) -> Iterator[str]:
    from foilstudy.study.sweep.expected import MEMORY_SPREAD, SPREAD

    kinds = ", ".join(cost.configurations[0].seconds_of)
    yield (
        f"{cost.realisations} realisations make {cost.jobs} jobs ({kinds} for each); "
        "cylinder, cube, tables, figures and report follow once."
    )
    yield (
        f"About {duration(cost.processor_seconds, 2)} of processor time, "
        f"{duration(cost.wall_seconds(cores), 2)} on {plural(cores, 'free core')}; of the "
        f"realisations measured, nine of ten kept within a factor of {SPREAD:g}."
    )
    yield (
        f"About {cost.peak_memory_mb / 1000:.1f} GB for the largest job, "
        f"{cost.total_memory_mb(cores) / 1000:.1f} GB for all on {plural(cores, 'core')}, within "
        f"a factor of {MEMORY_SPREAD:g}."
    )
    if cost.most_memory_mb > cost.peak_memory_mb:
        yield (
            f"Up to {cost.most_memory_mb / 1000:.1f} GB for a job whose shape needs more "
            "refinements than expected."
        )
