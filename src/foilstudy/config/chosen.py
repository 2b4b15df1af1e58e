"""What a study chose by its accuracy, and why, in lines for whoever starts it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import groupby
from typing import Any

from .accuracy import ACCURACIES, SETTLED_BY
from .model import StudyConfig

__all__ = ["accuracy_words", "choices"]


def accuracy_words(content: Mapping[str, Any]) -> str:
    """The tier of a study, and the keys that overrule it.

    Parameters
    ----------
    content : mapping
        A validated configuration as plain data.
    """
    keys = list(_overruling(content))
    name = content["accuracy"]
    return f"{name}, overruled by {', '.join(keys)}" if keys else name


def choices(study: StudyConfig) -> list[str]:
    """A line for the tier, and one for each thickness, or for several that are treated alike."""
    lines = [f"Accuracy {accuracy_words(study.model_dump())}"]
    chosen = ((_chosen(study, thickness), thickness) for thickness in study.thicknesses_um)
    for words, alike in groupby(chosen, lambda pair: pair[0]):
        thicknesses = [thickness for _, thickness in alike]
        lines.append(f"  {_range(thicknesses)} um: {words}")
    return lines


def _overruling(content: Mapping[str, Any]) -> Iterator[str]:
    """Keys with another value than the tier's; one given with the same value overrules nothing."""
    for path, value in ACCURACIES[content["accuracy"]].values.items():
        found = _value(content, path)
        if found is None:
            path = SETTLED_BY[path]
            yield f"{path}: {_value(content, path):g}"
        elif found != value:
            yield f"{path}: {found:g}"


def _value(content: Mapping[str, Any], path: str) -> float | None:
    section, _, key = path.partition(".")
    return content[section].get(key)


def _chosen(study: StudyConfig, thickness_um: float) -> str:
    size = study.mesh_of(thickness_um).element_size_mm
    return (
        f"elements of {size:g} mm ({study.sized_by(thickness_um)}), "
        f"{study.relaxation.ramp_steps} steps of ramp, reduction to {study.dynamics.tolerance:g}"
    )


def _range(values: list[float]) -> str:
    return " to ".join(dict.fromkeys(f"{value:g}" for value in (values[0], values[-1])))
