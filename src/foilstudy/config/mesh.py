"""The mesh of a study: its section, what `auto` makes of it, and whether it can carry the study."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import model_validator

from foilstudy.base.numerals import times
from foilstudy.model.foil import SMOOTH_LENGTH_MIN
from foilstudy.model.mesh_size import SLENDERNESS_MAX, element_size_for, energy_error_at
from foilstudy.model.shell.elements import ELEMENTS

from .accuracy import AUTO, STANDARD
from .choices import choice_of
from .sections import Section, auto_or, registry_field, tier_words, unit_field

# Fewer elements cannot carry the first buckling waves.
ELEMENTS_AROUND_MIN = 24
ELEMENTS_ALONG_MIN = 8
# About 20 GB in the refined stiffness; reached only by a slip of the unit.
ELEMENTS_MAX = 1_000_000


class Mesh(Section):
    """Discretisation of the foil."""

    element_size_mm: auto_or(float, 1e-4, 1000) = unit_field(
        "mm",
        "Edge length of the elements; at least 24 fit around the cylinder and 8 along the "
        "shortest one. `auto`: for each thickness the largest that keeps `energy_error_percent`.",
        AUTO,
    )
    energy_error_percent: float | None = unit_field(
        "%",
        "Expected error of the strain energy that an `auto` element size keeps; only with `auto`. "
        + tier_words("mesh.energy_error_percent"),
        None,
        ge=0.1,
        le=100,
    )
    ramp_coarsenings: int = unit_field(
        "1",
        "How often the elements are doubled for the ramp; the crumple is then refined, and relaxed "
        "on every mesh, each with the most steps that there may be.",
        0,
        ge=0,
        le=3,
    )
    element: choice_of(ELEMENTS) = registry_field(
        ELEMENTS, "corner", "Where an element samples its strains. "
    )

    @model_validator(mode="before")
    @classmethod
    def _default_energy_error(cls, data: Any) -> Any:
        if (
            isinstance(data, Mapping)
            and data.get("element_size_mm", AUTO) == AUTO
            and data.get("energy_error_percent") is None
        ):
            return dict(data) | {"energy_error_percent": STANDARD.energy_error_percent}
        return data

    @model_validator(mode="after")
    def _error_only_if_auto(self) -> Mesh:
        if self.element_size_mm != AUTO and self.energy_error_percent is not None:
            raise ValueError(
                "mesh.energy_error_percent is given, but mesh.element_size_mm is a number, which "
                "settles the mesh; remove one of them, or set mesh.element_size_mm: auto."
            )
        if self.element_size_mm == AUTO and self.element != "corner":
            raise ValueError(
                f"mesh.element_size_mm is auto, but the mesh error of the {self.element} element "
                "is not known; give a size, or use mesh.element: corner."
            )
        return self

    def resolved(self, diameter_mm: float, shortest_mm: float, thickness_um: float) -> Mesh:
        """The mesh of one thickness, its element size a number.

        With `auto` never too coarse for the diameter and the shortest cylinder of the study.
        """
        if self.element_size_mm == AUTO:
            size, _ = self._sized(diameter_mm, shortest_mm, thickness_um)
            return self.model_copy(
                update={"element_size_mm": round(size, 9), "energy_error_percent": None}
            )
        return self

    def sized_by(self, diameter_mm: float, shortest_mm: float, thickness_um: float) -> str:
        """What decides the element size of one thickness, in a few words."""
        if self.element_size_mm == AUTO:
            return self._sized(diameter_mm, shortest_mm, thickness_um)[1]
        return "as given"

    def _sized(self, diameter_mm: float, shortest_mm: float, thickness_um: float):
        """Size that `auto` stands for, mm, and what decides it."""
        percent = self.energy_error_percent
        size = 1e3 * element_size_for(percent / 100, diameter_mm / 2 * 1e-3, thickness_um * 1e-6)
        fitting = min(math.pi * diameter_mm / ELEMENTS_AROUND_MIN, shortest_mm / ELEMENTS_ALONG_MIN)
        fitting /= 2**self.ramp_coarsenings
        if size > fitting:
            return float(_floor(fitting)), "cylinder size"
        if percent / 100 > energy_error_at(SLENDERNESS_MAX):
            return size, "width of folds"
        return size, f"{percent:g} % energy error"


@dataclass(frozen=True)
class MeshUse:
    """What a mesh is to carry.

    Attributes
    ----------
    diameter_mm : float
    heights_mm, thicknesses_um : tuple of float
        Rising.
    refinements : int
        Of the stiffness, that are made in any case.
    correlation_length_mm : float or None
        Of the imperfection.
    """

    diameter_mm: float
    heights_mm: tuple[float, ...]
    thicknesses_um: tuple[float, ...]
    refinements: int
    correlation_length_mm: float | None


def mesh_problems(mesh: Mesh, use: MeshUse) -> Iterator[str]:
    """One sentence for each problem of the meshes, with its remedy."""
    if mesh.element_size_mm != AUTO:
        yield from _size_problems(use, mesh, mesh.element_size_mm, "")
        return
    # the thinnest foil has the finest mesh, the thickest one the coarsest
    for thickness in sorted({use.thicknesses_um[0], use.thicknesses_um[-1]}):
        which = f" (auto, {thickness:g} um, {mesh.energy_error_percent:g} % of energy error)"
        size = mesh.resolved(use.diameter_mm, use.heights_mm[0], thickness).element_size_mm
        yield from _size_problems(use, mesh, size, which)


def _size_problems(use: MeshUse, mesh: Mesh, size: float, which: str) -> Iterator[str]:
    circumference, heights = math.pi * use.diameter_mm, use.heights_mm
    doubled = 2**mesh.ramp_coarsenings
    larger = size * doubled
    around, along = round(circumference / larger), round(heights[0] / larger)
    if around < ELEMENTS_AROUND_MIN or along < ELEMENTS_ALONG_MIN:
        finest = min(circumference / ELEMENTS_AROUND_MIN, heights[0] / ELEMENTS_ALONG_MIN)
        yield (
            f"mesh.element_size_mm is {size:g} mm{which}, too coarse: it leaves {around} elements "
            f"around the circumference (at least {ELEMENTS_AROUND_MIN}) and {along} along the "
            f"shortest cylinder (at least {ELEMENTS_ALONG_MIN}){_of_ramp(mesh)}; use "
            f"{_floor(finest / doubled)} mm or less."
        )
    else:
        lengths = [height / round(height / larger) for height in heights]
        yield from _smoothing_problems(use, max(circumference / around, *lengths))
    finest = size / 2**use.refinements
    elements = circumference * heights[-1] / finest**2
    if elements > ELEMENTS_MAX:
        coarser = size * math.sqrt(elements / ELEMENTS_MAX)
        remedy = (
            "allow a larger mesh.energy_error_percent, as a coarser accuracy does, refine less, "
            "or give a size"
            if which
            else f"use {coarser:.2g} mm or more, and check that the value is in mm"
        )
        yield (
            f"mesh.element_size_mm is {size:g} mm{which}, which makes {elements:.2g} elements on "
            f"the longest cylinder, refined {times(use.refinements)} (at most "
            f"{ELEMENTS_MAX:g}); {remedy}."
        )


def _of_ramp(mesh: Mesh) -> str:
    if not mesh.ramp_coarsenings:
        return ""
    return f" for the ramp, by mesh.ramp_coarsenings: {mesh.ramp_coarsenings}"


def refinements_that_fit(size_mm: float, area_mm2: float, most: int) -> int:
    """How often elements can be halved on a sheet, at most `most` times."""
    finest = math.sqrt(area_mm2 / ELEMENTS_MAX)
    return max(0, min(most, math.floor(math.log2(size_mm / finest))))


def _smoothing_problems(use: MeshUse, size: float) -> Iterator[str]:
    length = use.correlation_length_mm
    if length is not None and length < SMOOTH_LENGTH_MIN * size:
        yield (
            f"imperfection.correlation_length_mm is {length:g} mm, which elements of {size:.3g} mm "
            f"cannot follow; use {SMOOTH_LENGTH_MIN * size:.3g} mm or more, a smaller "
            "mesh.element_size_mm, or imperfection.kind: gaussian."
        )


def _floor(value: float) -> str:
    """Value rounded down to three significant digits, so that it still satisfies an upper limit."""
    scale = 10.0 ** (math.floor(math.log10(value)) - 2)
    return f"{math.floor(value / scale) * scale:.3g}"
