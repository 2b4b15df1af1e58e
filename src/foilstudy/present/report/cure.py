"""The change of a configuration that makes a study's stiffness trustworthy, and what it costs."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from foilstudy.base.numerals import duration, nominal
from foilstudy.config import ConfigError, Sheet, StudyConfig, load_config
from foilstudy.config.accuracy import ACCURACIES, STANDARD, Accuracy
from foilstudy.model.mesh_size import (
    SLENDERNESS_MAX,
    element_size_for,
    energy_error_at,
)
from foilstudy.present.configuration import configuration
from foilstudy.present.statistics.cells import realised
from foilstudy.study.sweep.expected import MEASURED, expected

COARSEST_ERROR = energy_error_at(SLENDERNESS_MAX)
"""Energy error of the coarsest mesh that resolves a crumple."""
COARSER_ERROR_PERCENT = 25.0
"""Energy error of a mesh between that one and the one that `auto` makes by itself."""
CORES = 2
"""For which the waiting time is told."""


@dataclass(frozen=True)
class Cure:
    """A change of the configuration.

    Attributes
    ----------
    keys : tuple of str
        Lines such as ``mesh.element_size_mm: auto``.
    remark : str
        What they come to.
    cost : str
        Time that it takes.
    """

    keys: tuple[str, ...]
    remark: str
    cost: str


@dataclass(frozen=True)
class Need:
    """What is to be cured.

    Attributes
    ----------
    mesh : bool
        Crumples that their mesh does not resolve.
    refinements : int or None
        Of the stiffness, that are needed; None where those of the study are enough.
    error : float or None
        Largest energy error, a share, of a mesh that follows the folds; None where that of the
        study does.
    """

    mesh: bool
    refinements: int | None
    error: float | None = None


def cures(cube, need: Need) -> list[Cure]:
    """Changes that a study of this package can carry, the thorough one first.

    Empty where the configuration of an older cube is no longer valid.
    """
    content, keys = _content(cube), ()
    if need.refinements is not None:
        keys = (f"stiffness.refinements: {need.refinements}",)
        stiffness = dict(content.get("stiffness") or {})
        content["stiffness"] = stiffness | {"refinements": need.refinements}
    if not need.mesh and need.error is None:
        study = _study(content)
        return [Cure(keys, "", _cost(study, crumples=False))] if study else []
    thicknesses = content["sweep"]["thickness_um"]
    # Foils so thin that no mesh resolves them within the limit of elements are left out.
    for first in range(len(thicknesses)):
        kept = thicknesses[first:]
        content["sweep"]["thickness_um"] = kept
        left = (f"sweep.thickness_um: [{', '.join(f'{t:g}' for t in kept)}]",) if first else ()
        found = [
            Cure((*lines, *keys, *left), _sizes(study), _cost(study, crumples=True))
            for lines, changed in _changes(content, need.error)
            if (study := _study(changed))
        ]
        if found:
            return found[:2]
    return []


def _study(content: Mapping[str, Any]) -> StudyConfig | None:
    try:
        return load_config(content)
    except ConfigError:
        return None


def _content(cube) -> dict[str, Any]:
    """The configuration of the study, with the sweep that the cube holds."""
    content = dict(configuration(cube))
    content["sweep"] = {
        "thickness_um": [float(value) for value in cube["thickness"].values],
        "reference_height_mm": [float(value) for value in cube["reference_height"].values],
        # as much work, where configurations took different numbers
        "realisations": math.ceil(realised(cube).sum("seed").mean()),
    }
    return content


def _changes(
    content: dict[str, Any], error: float | None
) -> Iterator[tuple[tuple[str, ...], dict[str, Any]]]:
    """Lines of a configuration and the content that they make, the thorough ones first."""
    largest = _largest_percent(error)
    tier = _tier(content)
    if (content.get("mesh") or {}).get("energy_error_percent") == tier.energy_error_percent:
        # the word has sized the elements, and another one sizes them anew
        finer = [other for other in ACCURACIES.values() if other.energy_error_percent <= largest]
        if finer and largest < tier.energy_error_percent:
            other = max(finer, key=lambda each: each.energy_error_percent)
            yield (f"accuracy: {other.name}",), _with_another_tier(content, tier, other)
    for mesh in _meshes(content, largest):
        yield _keys(mesh), content | {"mesh": mesh}


def _tier(content: Mapping[str, Any]) -> Accuracy:
    return ACCURACIES.get(content.get("accuracy"), STANDARD)


def _with_another_tier(
    content: Mapping[str, Any], tier: Accuracy, other: Accuracy
) -> dict[str, Any]:
    """A content in which all that the one word decided is decided by another one."""
    changed = dict(content) | {"accuracy": other.name}
    for path, value in tier.values.items():
        name, _, key = path.partition(".")
        section = changed.get(name) or {}
        if section.get(key) == value:
            changed[name] = dict(section) | {key: other.values[path]}
    return changed


def _largest_percent(error: float | None) -> float:
    return math.inf if error is None else math.floor(1e3 * error) / 10


def _meshes(content: Mapping[str, Any], largest: float) -> Iterator[dict[str, Any]]:
    """Sections `mesh` that resolve every foil, from the finest to the coarsest."""
    section = content.get("mesh") or {}
    element = {"element": section["element"]} if "element" in section else {}
    by_word = _tier(content).energy_error_percent
    if largest < by_word:
        yield {"element_size_mm": "auto", "energy_error_percent": largest} | element
        return
    yield {"element_size_mm": "auto"} | element
    for percent in (COARSER_ERROR_PERCENT, round(100 * COARSEST_ERROR, 6)):
        if by_word < percent <= largest:
            yield {"element_size_mm": "auto", "energy_error_percent": percent} | element
    if element not in ({}, {"element": "corner"}):  # the only one that knows `auto`
        sheet = content.get("sheet") or {}
        radius = float(sheet.get("diameter_mm", Sheet().diameter_mm)) / 2e3
        thinnest = 1e-6 * content["sweep"]["thickness_um"][0]
        size = 1e3 * element_size_for(COARSEST_ERROR, radius, thinnest)
        yield {"element_size_mm": round(size, 9)} | element


def _keys(mesh: Mapping[str, Any]) -> tuple[str, ...]:
    return tuple(
        f"mesh.{name}: {value if isinstance(value, str) else format(value, 'g')}"
        for name, value in mesh.items()
        if name != "element"
    )


def _sizes(study: StudyConfig) -> str:
    sizes = [study.mesh_of(thickness).element_size_mm for thickness in study.thicknesses_um]
    ends = dict.fromkeys(nominal(size) for size in (min(sizes), max(sizes)))
    return f"elements of {' to '.join(ends)} mm"


def _cost(study: StudyConfig, crumples: bool) -> str:
    """Time of the whole study, or of the responses alone where the crumples stay."""
    cost = expected(study)
    seconds, start = cost.processor_seconds, cost.start_seconds
    what = "the whole study anew"
    if not crumples:
        responses = sum(each.seconds_of["response"] for each in cost.configurations)
        seconds = len(study.seeds) * responses + cost.realisations * MEASURED.job
        seconds += MEASURED.gathering
        what = "the responses anew, the crumples stay"
    waiting = start + seconds / min(CORES, cost.realisations)
    return (
        f"{what}, about {duration(seconds, 2)} of processor time, {duration(waiting, 2)} on "
        f"{CORES} free cores"
    )
