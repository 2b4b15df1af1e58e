"""What a configuration asks for that is possible and almost surely not meant.

A refusal needs certainty; here a sentence says what looks wrong, and the study runs.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain

from foilstudy.base.numerals import number
from foilstudy.model.mesh_size import SLENDERNESS_MAX
from foilstudy.solve.pace import ramp_steps

from .accuracy import AUTO
from .choices import cautions_of
from .haste import RAMPED, haste
from .model import StudyConfig
from .sections import RAMP_STEPS_MIN
from .width import wide

__all__ = ["first_buckling", "hurried", "known_to_fail", "likely_slips", "unresolved"]

THICKNESS_MIN_UM = 1.0
"""Thinner foils are not on sale."""
DIAMETER_RANGE_MM = (5.0, 5_000.0)
ASPECT_RANGE = (0.05, 10.0)
"""Gap over diameter, from a ring to a tube."""
OVERLENGTH_RANGE_PERCENT = (0.1, 300.0)
MODULUS_RANGE_MPA = (10.0, 450_000.0)
"""From rubber to tungsten."""
METAL_DENSITY_KG_M3, METAL_MODULUS_MPA = 2_400.0, 10_000.0
"""No polymer is denser, no metal foil softer."""
DENSITY_RANGE_KG_M3 = (300.0, 23_000.0)
YIELD_STRAIN_RANGE = (1e-4, 0.2)
AMPLITUDE_MAX = 10.0
"""Of an imperfection, over the thickness."""
PLASTIC_RAMP_MIN = 2_000
"""Steps; in these a foil of 500 um dissipates a fifth more than in four times as many, in 500 of
them three quarters more, and in 200 all of it yields."""
TOLERANCE_RANGE = (1e-12, 1e-3)
RAMP_SLOWNESS_MIN = 0.5
"""Steps of the ramp for each unit of R/t: twice the fastest ramp at which a foil of 31 % overlength
has locked, hourglassed or folded (results/limits: 0.05 of 100 um and 0.1 of 50 um do, 0.25 do not;
at 190 % overlength 0.25 diverge)."""
RING_SLENDERNESS_MAX = 0.4
"""Size of the elements over sqrt(R t) up to which a cylinder buckles at the load of theory to
within 6 %; `auto` stays below the energy error that it is asked for."""
ELEMENTS_MAX = 200_000
"""Of the mesh that is crumpled: ten times the finest of docs/convergence.md."""


def likely_slips(study: StudyConfig) -> list[str]:
    """Sentences about what is almost surely a slip, with key, value and reason."""
    return list(
        chain(
            _of_sizes(study),
            _of_heights(study),
            _of_material(study),
            _of_yielding(study),
            _of_numerics(study),
            _of_mesh_and_band(study),
        )
    )


def known_to_fail(study: StudyConfig) -> list[str]:
    """Sentences about methods that fail, as docs/limits.md maps them, and what to take instead."""
    return [*_of_ramp(study), *cautions_of(study)]


def unresolved(study: StudyConfig) -> list[str]:
    """Sentences about foils whose folds, first buckles or shapes the mesh cannot follow, if any."""
    radius = study.sheet.diameter_mm / 2
    widths = {
        thickness: study.mesh_of(thickness).element_size_mm / math.sqrt(radius * thickness * 1e-3)
        for thickness in study.thicknesses_um
    }
    broad = {t: w for t, w in widths.items() if w > SLENDERNESS_MAX * (1 + 1e-6)}
    early = {t: w for t, w in widths.items() if t not in broad and w > RING_SLENDERNESS_MAX}
    shapes = wide(widths) if _is_corner(study) else None
    return [
        *_of_folds(study, broad),
        *_of_first_buckling(study, early),
        *([shapes] if shapes else []),
    ]


def hurried(study: StudyConfig) -> list[str]:
    """A sentence about foils that cannot follow the ramp; none if they can, or there is none."""
    if study.method.path not in RAMPED:
        return []
    steps = {t: study.relaxation_of(t).ramp_steps for t in study.thicknesses_um}
    said = haste(steps, study.sheet.diameter_mm / 2)
    return [said] if said else []


def _of_folds(study: StudyConfig, broad: Mapping[float, float]) -> Iterator[str]:
    """Where elements are wider than folds; widths over sqrt(R t) by thickness in um."""
    if broad:
        rings = f", rings of them buckle at {_loads(study, broad)}" if _is_corner(study) else ""
        yield (
            f"mesh.element_size_mm does not resolve {_those(list(broad))} um: its elements are "
            f"{_rounded(broad.values())} times sqrt(R t) wide{rings}, and folds need "
            f"{SLENDERNESS_MAX:g} at most, so the report will not trust those stiffnesses; use "
            "auto, or a finer size."
        )


def _of_first_buckling(study: StudyConfig, early: Mapping[float, float]) -> Iterator[str]:
    """Where a size that was given, and so no error, lets rings buckle before their time."""
    if early and _is_corner(study) and study.mesh.element_size_mm != AUTO:
        size, radius = study.mesh.element_size_mm, study.sheet.diameter_mm / 2
        finest = RING_SLENDERNESS_MAX * math.sqrt(radius * min(early) * 1e-3)
        yield (
            f"mesh.element_size_mm of {size:g} mm lets {_those(list(early))} um buckle first at "
            f"{_loads(study, early)}; that by itself does little to crumples (docs/limits.md), but "
            f"where the first buckles matter, use {finest:.2g} mm at most."
        )


def _is_corner(study: StudyConfig) -> bool:
    """Whether `first_buckling` is about its element."""
    return study.mesh.element == "corner"


def _loads(study: StudyConfig, widths: Mapping[float, float]) -> str:
    poisson = study.material.poisson_ratio
    loads = (100 * first_buckling(width, poisson) for width in widths.values())
    return f"{_rounded(loads)} % of the load of theory"


def first_buckling(slenderness: float, poisson_ratio: float) -> float:
    """Axial load at which a cylinder of corner elements buckles, over the classical one.

    The least of (x + 1/x)/2 - q over waves of two elements and longer, x <= 1/(2 q), where x is the
    square of the wave number over the critical one and q = sqrt(3 (1 - nu^2)) h^2 / (4 R t) is what
    the corners do not feel of the stretching of rings (docs/verification.md).

    Parameters
    ----------
    slenderness : float
        h / sqrt(R t).
    poisson_ratio : float
    """
    unfelt = math.sqrt(3 * (1 - poisson_ratio**2)) * slenderness**2 / 4
    return 1 - unfelt if unfelt < 0.5 else 1 / (4 * unfelt)


def _outside(value: float, bounds: tuple[float, float]) -> bool:
    return not bounds[0] <= value <= bounds[1]


def _those(values: Sequence[float]) -> str:
    """One value, or the range of several."""
    low, high = min(values), max(values)
    return f"{low:g}" if low == high else f"{low:g} to {high:g}"


def _rounded(values: Iterable[float]) -> str:
    """The same with two digits."""
    return _those([float(f"{value:.2g}") for value in values])


def _of_sizes(study: StudyConfig) -> Iterator[str]:
    thin = [value for value in study.thicknesses_um if value < THICKNESS_MIN_UM]
    if thin:
        yield (
            f"sweep.thickness_um holds {_those(thin)} um, thinner than any foil on sale; check "
            "that it is in um."
        )
    diameter, gap = study.sheet.diameter_mm, study.sheet.gap_height_mm
    if _outside(diameter, DIAMETER_RANGE_MM):
        yield f"sheet.diameter_mm is {diameter:g} mm; check that it is in mm."
    if _outside(gap / diameter, ASPECT_RANGE):
        yield (
            f"sheet.gap_height_mm is {gap:g} mm beside sheet.diameter_mm of {diameter:g} mm, "
            f"{number(gap / diameter, 2)} of it; check that both are in mm."
        )


def _of_heights(study: StudyConfig) -> Iterator[str]:
    least, most = OVERLENGTH_RANGE_PERCENT
    key = "reference_height_mm" if study.sweep.reference_height_mm else "overlength_percent"
    low = [value for value in study.overlengths_percent if value < least]
    high = [value for value in study.overlengths_percent if value > most]
    if low:
        yield (
            f"sweep.{key} makes an overlength of {_those(low)} %, a hair above the gap, where "
            "hardly anything crumples; check height and gap."
        )
    if high:
        yield (
            f"sweep.{key} makes an overlength of {_those(high)} %, far beyond the published ones "
            "(4 to 92 %); check height and gap."
        )


def _of_material(study: StudyConfig) -> Iterator[str]:
    material = study.material
    modulus, density = material.youngs_modulus_mpa, material.density_kg_m3
    if modulus < MODULUS_RANGE_MPA[0] or (
        modulus < METAL_MODULUS_MPA and density > METAL_DENSITY_KG_M3
    ):
        yield (
            f"material.youngs_modulus_mpa is {modulus:g} MPa, too soft for a foil of "
            f"{density:g} kg/m3; check that it is not in GPa ({1000 * modulus:g} MPa then)."
        )
    elif modulus > MODULUS_RANGE_MPA[1]:
        yield (
            f"material.youngs_modulus_mpa is {modulus:g} MPa, stiffer than tungsten; check that "
            "it is in MPa."
        )
    if _outside(density, DENSITY_RANGE_KG_M3):
        hint = f", not in g/cm3 ({1000 * density:g} kg/m3 then)" if density < 25 else ""
        yield (
            f"material.density_kg_m3 is {density:g} kg/m3, which no foil has; check that it is in "
            f"kg/m3{hint}."
        )
    strain = material.yield_stress_mpa / modulus
    if _outside(strain, YIELD_STRAIN_RANGE):
        yield (
            f"material.yield_stress_mpa is {material.yield_stress_mpa:g} MPa, {100 * strain:.2g} % "
            "of Young's modulus; check that both are in MPa."
        )
    if material.poisson_ratio < 0:
        yield (
            f"material.poisson_ratio is {material.poisson_ratio:g}: the foil widens as it is "
            "pulled; check its sign."
        )


def _of_yielding(study: StudyConfig) -> Iterator[str]:
    material, removal = study.material, study.method.stress_removal
    if material.law != "elastic":
        fastest = min(study.relaxation_of(each).ramp_steps for each in study.thicknesses_um)
        if fastest < PLASTIC_RAMP_MIN:
            slenderness = 1e3 * study.sheet.diameter_mm / 2 / study.thicknesses_um[0]
            enough = max(4 * PLASTIC_RAMP_MIN, ramp_steps(slenderness))
            yield (
                f"material.law is {material.law}, and the ramp takes {fastest} steps: in fewer "
                f"than {PLASTIC_RAMP_MIN} the foil yields by the hurry; set relaxation.ramp_steps: "
                f"{enough}."
            )
        if material.hardening_mpa == 0:
            yield (
                "material.hardening_mpa is 0: elements without hardening may fold flat and never "
                "come to rest; leave it out."
            )
    if removal != "reset":
        yield (
            f"method.stress_removal is {removal}, which leaves stress in the shape: the stiffness "
            "called stress-free is lower by a tenth to a third or more; use reset, unless that "
            "is what is studied."
        )


def _of_numerics(study: StudyConfig) -> Iterator[str]:
    amplitude, thinnest = study.imperfection.amplitude_um, study.thicknesses_um[0]
    if amplitude > AMPLITUDE_MAX * thinnest:
        yield (
            f"imperfection.amplitude_um is {amplitude:g} um, {number(amplitude / thinnest, 2)} "
            f"times the thickness of {thinnest:g} um, a crumple by itself; check that it is in um."
        )
    relaxation = study.relaxation
    tolerance = relaxation.residual_tolerance
    if tolerance < TOLERANCE_RANGE[0]:
        yield (
            f"relaxation.residual_tolerance is {tolerance:g}, below what rounding allows; no "
            "crumple may reach it."
        )
    elif tolerance > TOLERANCE_RANGE[1]:
        yield (
            f"relaxation.residual_tolerance is {tolerance:g}, so large that a crumple need not be "
            "in equilibrium; check its exponent."
        )
    if relaxation.ramp_steps is not None and relaxation.ramp_steps < RAMP_STEPS_MIN:
        yield (
            f"relaxation.ramp_steps is {relaxation.ramp_steps}, in which the foil cannot follow "
            "the ring; use some hundreds."
        )


def _of_ramp(study: StudyConfig) -> Iterator[str]:
    """Ramps in which foil folds as a whole or zigzags from element to element (docs/limits.md)."""
    radius = study.sheet.diameter_mm / 2
    fast = {
        thickness: steps / (1e3 * radius / thickness)
        for thickness in study.thicknesses_um
        for steps in (study.relaxation_of(thickness).ramp_steps,)
    }
    thickness, slowness = min(fast.items(), key=lambda item: item[1])
    if slowness < RAMP_SLOWNESS_MIN:
        least = math.ceil(RAMP_SLOWNESS_MIN * 1e3 * radius / thickness)
        yield (
            f"relaxation.ramp_steps makes {slowness:.2g} steps for each unit of R/t of "
            f"{thickness:g} um, in which foil may fold as a whole or from element to element; "
            f"leave it out, or give {least} at least."
        )


def _of_mesh_and_band(study: StudyConfig) -> Iterator[str]:
    longest, circumference = study.reference_heights_mm[-1], math.pi * study.sheet.diameter_mm
    sizes = {t: study.mesh_of(t).element_size_mm for t in study.thicknesses_um}
    thickness, size = min(sizes.items(), key=lambda item: item[1])
    elements = longest * circumference / size**2
    if elements > ELEMENTS_MAX:
        yield (
            f"mesh.element_size_mm is {size:g} mm for {thickness:g} um, which makes {elements:.2g} "
            "elements on the longest cylinder; check that it is in mm, and see what the study "
            "costs."
        )
    highest = study.dynamics.shown_max_hz
    wave = {t: _bending_wave_mm(study, t, highest) / size for t, size in sizes.items()}
    thickness, elements = min(wave.items(), key=lambda item: item[1])
    if elements < 1:
        yield (
            f"dynamics.shown_max_hz is {highest:g} Hz, where a bending wave of foil of "
            f"{thickness:g} um is {elements * sizes[thickness]:.2g} mm long, shorter than an "
            f"element ({sizes[thickness]:g} mm); lower it, or refine mesh.element_size_mm."
        )


def _bending_wave_mm(study: StudyConfig, thickness_um: float, frequency_hz: float) -> float:
    """Length of a bending wave in the flat foil."""
    material, thickness = study.material, thickness_um * 1e-6
    modulus = material.youngs_modulus_mpa * 1e6
    bending = modulus * thickness**3 / (12 * (1 - material.poisson_ratio**2))
    mass = material.density_kg_m3 * thickness
    omega = 2 * math.pi * frequency_hz
    return 2e3 * math.pi * (bending / mass) ** 0.25 / math.sqrt(omega)
