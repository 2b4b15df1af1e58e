"""`foilstudy check`: what a configuration means, and what it will cost."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from .options import Cores, read_study

if TYPE_CHECKING:
    from foilstudy.config import StudyConfig
    from foilstudy.study.sweep.expected import Expected, ExpectedConfiguration

__all__ = ["check"]

_TIMES = ("not at all", "once", "twice", "three times")
_HEADS = ("thickness", "elements", "size", "refined to", "steps", "time of each", "memory of a job")


def check(file: Path, /, *, cores: Cores = 2) -> None:
    """Say what a configuration means and what it will cost, or what is wrong with it.

    Nothing is started. The expected cost rests on studies that were measured.

    Parameters
    ----------
    file : Path
        YAML file of the study.
    """
    from foilstudy.study.sweep.expected import expected

    study = read_study(file)
    cost = expected(study)
    lines = [f"{file}: no problem; results go to results/{study.study.name}.", ""]
    lines += (f"{name:10} {text}" for name, text in _resolved(study))
    lines += ["", *_table(cost), "", *_summary(study, cost, cores)]
    print("\n".join(lines))


def _resolved(study: StudyConfig) -> Iterator[tuple[str, str]]:
    """What was written, and what defaults and `auto` became."""
    sheet, material, imperfection = study.sheet, study.material, study.imperfection
    yield (
        "foil",
        f"{material.name} ({material.youngs_modulus_mpa:g} MPa, {material.poisson_ratio:g}, "
        f"{material.density_kg_m3:g} kg/m3), diameter {sheet.diameter_mm:g} mm, "
        f"gap {sheet.gap_height_mm:g} mm",
    )
    yield "heights", f"{_listed(study.reference_heights_mm, '{:g}')} mm"
    yield "overlength", f"{_listed(study.overlengths_percent, '{:.3g}')} %"
    length = imperfection.correlation_length_mm
    correlated = f", correlated over {length:g} mm" if length else ""
    mesh, relaxation = study.mesh, study.relaxation
    error = f" for {mesh.energy_error_percent:g} % of energy error" if _is_auto(study) else ""
    yield (
        "crumple",
        f"{mesh.element} elements{error}; {imperfection.kind} imperfection of "
        f"{imperfection.amplitude_um:g} um{correlated}; {relaxation.ramp_steps} steps of ramp, at "
        f"most {relaxation.relaxation_steps_max} after it, to a residual of "
        f"{relaxation.residual_tolerance:g}",
    )
    yield (
        "stiffness",
        f"shape refined {_TIMES[study.stiffness.refinements]}, equilibrium refined "
        f"{_TIMES[study.stiffness.relaxed_refinements]}",
    )
    dynamics = study.dynamics
    yield (
        "dynamics",
        f"{dynamics.reduction} to {dynamics.tolerance:g}, {dynamics.frequencies} frequencies from "
        f"{dynamics.shown_min_hz:g} to {dynamics.shown_max_hz:g} Hz, {dynamics.damping} damping of "
        f"{dynamics.damping_percent:g} %",
    )
    if study.export.formats:
        yield "export", ", ".join(study.export.formats)


def _is_auto(study: StudyConfig) -> bool:
    return study.mesh.energy_error_percent is not None


def _listed(values: Iterable[float], form: str) -> str:
    return ", ".join(form.format(value) for value in values)


def _table(cost: Expected) -> Iterator[str]:
    """One line for each thickness, its heights as ranges."""
    thicknesses = dict.fromkeys(each.thickness_um for each in cost.configurations)
    rows = [_HEADS] + [
        _row([each for each in cost.configurations if each.thickness_um == thickness])
        for thickness in thicknesses
    ]
    widths = [max(len(row[column]) for row in rows) for column in range(len(_HEADS))]
    for row in rows:
        yield "  ".join(f"{cell:>{width}}" for cell, width in zip(row, widths, strict=True))


def _row(heights: list[ExpectedConfiguration]) -> tuple[str, ...]:
    first, last = heights[0], heights[-1]  # the shortest cylinder and the longest
    refined = _range(first.elements[-1], last.elements[-1]) if len(first.elements) > 1 else "-"
    return (
        f"{first.thickness_um:g} um",
        _range(first.elements[0], last.elements[0]),
        f"{first.element_size_mm:g} mm",
        refined,
        f"{_two_digits(first.steps)}",
        _range(_two_digits(first.seconds), _two_digits(last.seconds)) + " s",
        _range(*(f"{each.peak_memory_mb / 1000:.1f}" for each in (first, last))) + " GB",
    )


def _range(first: object, last: object) -> str:
    return f"{first}" if first == last else f"{first} to {last}"


def _two_digits(value: float) -> str:
    return f"{float(f'{value:.2g}'):g}"


def _summary(study: StudyConfig, cost: Expected, cores: int) -> Iterator[str]:
    from foilstudy.study.sweep.expected import MEMORY_SPREAD, SPREAD

    kinds = ["crumple", "response"]
    kinds += ["refine"] * bool(study.stiffness.relaxed_refinements)
    kinds += ["export"] * bool(study.export.formats)
    yield (
        f"{cost.realisations} realisations make {cost.jobs} jobs ({', '.join(kinds)} for each); "
        "cylinder, cube, tables, figures and report follow once."
    )
    yield (
        f"About {_duration(cost.processor_seconds)} of processor time, "
        f"{_duration(cost.wall_seconds(cores))} on {_cores(cores, 'free ')}; of the realisations "
        f"measured, on two kinds of processor, nine of ten kept within a factor of {SPREAD:g}."
    )
    yield (
        f"About {cost.peak_memory_mb / 1000:.1f} GB for the largest job, "
        f"{cost.total_memory_mb(cores) / 1000:.1f} GB for all on {_cores(cores)}, within a factor "
        f"of {MEMORY_SPREAD:g}."
    )


def _cores(number: int, which: str = "") -> str:
    return f"{number} {which}core{'s' * (number > 1)}"


def _duration(seconds: float) -> str:
    if seconds < 90:
        return f"{seconds:.0f} s"
    if seconds < 90 * 60:
        return f"{_two_digits(seconds / 60)} minutes"
    return f"{_two_digits(seconds / 3600)} hours"
