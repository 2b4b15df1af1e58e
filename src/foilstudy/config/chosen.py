"""What a study chose by its accuracy, and why, in lines for whoever starts it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import groupby
from typing import Any

from foilstudy.base.numerals import times

from .accuracy import ACCURACIES, SETTLED_BY
from .model import Cell, StudyConfig
from .slips import hurried, known_to_fail, unresolved

__all__ = ["accuracy_words", "choices"]


def accuracy_words(content: Mapping[str, Any]) -> str:
    """The tier of a study, and the keys that overrule it.

    Parameters
    ----------
    content : mapping
        A validated configuration as plain data, such as a cube carries.
    """
    keys = list(_overruling(content))
    name = content["accuracy"]
    return f"{name}, overruled by {', '.join(keys)}" if keys else name


def choices(study: StudyConfig) -> list[str]:
    """A line for the tier, and one for each thickness, or for several that are treated alike.

    What the mesh does not resolve or the ramp hurries, and what is known to fail, is said at the
    end.
    """
    lines = [f"Accuracy {accuracy_words(study.model_dump())}"]
    shortest = {cell.thickness_um: cell for cell in reversed(study.cells())}
    chosen = ((_chosen(study, shortest[each]), each) for each in study.thicknesses_um)
    for words, alike in groupby(chosen, lambda pair: pair[0]):
        thicknesses = [thickness for _, thickness in alike]
        lines.append(f"  {_range(thicknesses)} um: {words}")
    lines += (f"  {sentence}" for sentence in (*unresolved(study), *hurried(study)))
    return [*lines, *(f"  known to fail: {sentence}" for sentence in known_to_fail(study))]


def _overruling(content: Mapping[str, Any]) -> Iterator[str]:
    """Keys with another value than the tier's; one given with the same value overrules nothing."""
    for path, value in ACCURACIES[content["accuracy"]].values.items():
        found = _value(content, path)
        if found is None:  # settled by another key, or not yet known to the release of a cube
            path = SETTLED_BY.get(path, path)
            found = _value(content, path)
        elif found == value:
            continue
        if found is not None:
            yield f"{path}: {found:g}"


def _value(content: Mapping[str, Any], path: str) -> float | None:
    section, _, key = path.partition(".")
    return content.get(section, {}).get(key)


def _chosen(study: StudyConfig, cell: Cell) -> str:
    size, percent = study.mesh_of(cell.thickness_um).element_size_mm, study.stiffness.error_percent
    ramp = study.relaxation_of(cell.thickness_um).ramp_steps
    demand = "" if percent is None else f"to {percent:g} %, at most "
    refined = f"{demand}{times(study.response_task(cell).refinements)}"
    return (
        f"elements of {size:g} mm ({study.sized_by(cell.thickness_um)}), "
        f"{ramp} steps of ramp, shape refined {refined}, "
        f"reduction to {study.dynamics.tolerance:g}"
    )


def _range(values: list[float]) -> str:
    return " to ".join(dict.fromkeys(f"{value:g}" for value in (values[0], values[-1])))
