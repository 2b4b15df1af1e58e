"""What the mesh does to the stiffness: change towards the mesh limit, stated error, caveats."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr

from foilstudy.base.numerals import nominal, percent, percent_range, times
from foilstudy.base.reference import EXPLICIT_CODE
from foilstudy.present.report.spread import Spread, by_direction, by_thickness
from foilstudy.present.statistics.cells import energy_left, relative_mesh_error

PUBLISHED_LOCKING = (
    "The published simulation carries mesh locking of its own: of frozen shapes, a 5 mm mesh of "
    "4-node reduced-integration shells like its own gave a stiffness 35 % above the converged one "
    f"at 500 µm and five times too high at 50 µm ({EXPLICIT_CODE}; not in the thesis). Its "
    "thickness exponent holds for that mesh, not for the foil."
)

_ELEMENTS = {
    "corner": "corner-sampled",
    "one_point": "one-point",
    "full": "fully integrated",
}
_OLDEST_ELEMENT = "one_point"
"""Element of cubes from before there was a choice."""


@dataclass(frozen=True)
class MeshErrors:
    """What refining the crumpled shapes says about their stiffness.

    Attributes
    ----------
    change
        By direction, then thickness [um]: mesh limit over crumpled-mesh stiffness, minus one.
    stated
        By direction, then thickness [um]: estimated error of the mesh limit over the limit.
    stabilisation_share
        By thickness [um]: stabilisation energy over the whole internal energy.
    refinements
        By thickness [um]: of the shapes, where their number is recorded.
    """

    change: dict[str, dict[float, Spread]]
    stated: dict[str, dict[float, Spread]]
    stabilisation_share: dict[float, Spread]
    refinements: dict[float, Spread]

    def overall_change(self, direction: str) -> Spread | None:
        """Range of `change` over all thicknesses."""
        spreads = self.change.get(direction, {}).values()
        return Spread.of([v for s in spreads for v in (s.lowest, s.highest)])

    @property
    def most_dependent_thickness_um(self) -> float | None:
        """Thickness with the largest median `change`; None with less than two to compare."""
        medians: dict[float, float] = {}
        for spreads in self.change.values():
            for thickness, spread in spreads.items():
                medians[thickness] = max(medians.get(thickness, 0.0), abs(spread.median))
        return max(medians, key=medians.get) if len(medians) > 1 else None


def assess_mesh(cube: xr.Dataset) -> MeshErrors:
    """Read the mesh errors of a study from its cube."""
    share = by_thickness(cube["stabilisation_energy"] / energy_left(cube))
    if "static_stiffness_converged" not in cube:
        return MeshErrors({}, {}, share, {})
    change = cube["static_stiffness_converged"] / cube["static_stiffness"] - 1.0
    # Without a refinement there is no error estimate, and both stiffnesses are the same one.
    change = change.where(np.isfinite(cube["static_stiffness_mesh_error"]))
    stated = by_direction(relative_mesh_error(cube))
    # not recorded before there was a demand on the error
    made = by_thickness(cube["static_refinements"]) if "static_refinements" in cube else {}
    return MeshErrors(by_direction(change), stated, share, made)


def element_kind(config: Mapping) -> str:
    """Name of the element in words."""
    kind = config.get("mesh", {}).get("element", _OLDEST_ELEMENT)
    return _ELEMENTS.get(kind, kind)


def mesh_sentence(mesh: MeshErrors, config: Mapping) -> str:
    """Say by how much the stiffness of the same shapes changes towards the mesh limit."""
    parts = [
        f"the {direction} stiffness is {_extent(mesh.overall_change(direction))}"
        for direction in mesh.change
    ]
    if not parts:
        return "The mesh error of the stiffness was not measured."
    text = f"In the mesh limit ({_how(mesh, config)}) {' and '.join(parts)} for the same shapes"
    thickness = mesh.most_dependent_thickness_um
    return f"{text}, most at {nominal(thickness)} µm." if thickness else f"{text}."


def stated_error_sentence(mesh: MeshErrors) -> str:
    """Say how large the stated error of the mesh limit is at each thickness."""
    parts = []
    for direction, spreads in mesh.stated.items():
        errors = [
            f"{percent(spread.median)} (largest {percent(spread.highest)}) at {nominal(t)} µm"
            for t, spread in spreads.items()
        ]
        parts.append(f"{direction} {', '.join(errors)}")
    return f"The stated error of that limit is, in the median, {'; '.join(parts)}." if parts else ""


def share_sentence(config: Mapping) -> str:
    """Say what the share of the stabilisation energy means for the element of the study."""
    if config.get("mesh", {}).get("element", _OLDEST_ELEMENT) == _OLDEST_ELEMENT:
        return (
            "The share of the stabilisation in the internal energy tells how well the one-point "
            "elements resolve the ridges; the change towards the mesh limit tells what that costs."
        )
    return (
        f"The stabilisation of the {element_kind(config)} element controls the checkerboard alone: "
        "its share does not tell how well the ridges are resolved. The change towards the mesh "
        "limit and its stated error do, for the shape that was crumpled."
    )


def _extent(change: Spread) -> str:
    if change.highest <= 0:
        return f"{percent_range(-change.highest, -change.lowest)} lower"
    if change.lowest >= 0:
        return f"{percent_range(change.lowest, change.highest)} higher"
    return f"{percent(-change.lowest)} lower to {percent(change.highest)} higher"


def _how(mesh: MeshErrors, config: Mapping) -> str:
    section = config.get("stiffness", {})
    refinements = section.get("refinements", 1)
    if demand := section.get("error_percent"):
        made = ", ".join(f"{_times(s)} at {nominal(t)} µm" for t, s in mesh.refinements.items())
        return f"refined until the stated error is at most {demand:g} %, {made}"
    # Before there was a choice of elements the finest mesh stood for the limit.
    if refinements < 2 or "element" not in config.get("mesh", {}):
        return f"{times(refinements)} refined, not extrapolated"
    return f"{times(refinements)} refined, extrapolated to element size zero where the steps shrink"


def _times(refinements: Spread) -> str:
    ends = dict.fromkeys((int(refinements.lowest), int(refinements.highest)))
    return " to ".join(times(end) for end in ends)
