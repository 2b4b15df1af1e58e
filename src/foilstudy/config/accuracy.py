"""One word for how accurate a study is: each tier is a set of tolerances, as data.

A key of the configuration that is left out takes the value of its tier, when the configuration is
validated (`completed`); one that is given wins. Only the values enter the tasks of jobs, so that
the word itself makes no record stale.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from foilstudy.base.errors import Refusal
from foilstudy.base.registry import did_you_mean
from foilstudy.solve.pace import SLOWNESS

__all__ = ["ACCURACIES", "AUTO", "SETTLED_BY", "STANDARD", "Accuracy", "completed"]

AUTO = "auto"
"""Value of a key that leaves it to a tolerance."""
SETTLED_BY: Mapping[str, str] = {
    "mesh.energy_error_percent": "mesh.element_size_mm",
    "relaxation.ramp_slowness": "relaxation.ramp_steps",
    "stiffness.error_percent": "stiffness.refinements",
}
"""Tolerances that nothing asks for where another key is given, in whose place they stand."""


@dataclass(frozen=True)
class Accuracy:
    """Tolerances that go together.

    Attributes
    ----------
    name : str
        As in the configuration.
    words : str
        What it is for: the end of a sentence that begins with its name.
    energy_error_percent : float
        Expected error of the strain energy of a crumple, for which `auto` elements are sized.
    ramp_slowness : float
        Steps in which the top ring closes the gap, for each unit of R/t. In too few the foil lags
        behind the ring and crumples to another shape; its slowest motions take time as R/t does.
    stiffness_error_percent : float
        Stated mesh error of the static stiffness, at which refining ends.
    reduction_tolerance : float
        Largest relative error of the reduced model in the shown band.
    """

    name: str
    words: str
    energy_error_percent: float
    ramp_slowness: float
    stiffness_error_percent: float
    reduction_tolerance: float

    @classmethod
    def named(cls, name: str) -> Accuracy:
        """The tier of that name.

        Raises
        ------
        Refusal
            If there is none, naming the known ones.
        """
        if name not in ACCURACIES:
            hint = did_you_mean(name, ACCURACIES)
            raise Refusal(f"{name!r} is no accuracy; {hint}use one of {', '.join(ACCURACIES)}.")
        return ACCURACIES[name]

    def __repr__(self) -> str:
        values = ", ".join(f"{key} {value:g}" for key, value in self.values.items())
        return f"<Accuracy {self.name}: {values}>"

    @property
    def energy_error(self) -> float:
        """`energy_error_percent` as a share, for ``Mesh.resolving``."""
        return self.energy_error_percent / 100

    @property
    def values(self) -> Mapping[str, float]:
        """Every key that it decides, as ``section.key``, with its value."""
        return {
            "mesh.energy_error_percent": self.energy_error_percent,
            "relaxation.ramp_slowness": self.ramp_slowness,
            "stiffness.error_percent": self.stiffness_error_percent,
            "dynamics.tolerance": self.reduction_tolerance,
        }


ACCURACIES: Mapping[str, Accuracy] = {
    tier.name: tier
    for tier in (
        Accuracy(
            name="quick",
            words="a first look",
            energy_error_percent=25.0,
            ramp_slowness=12.0,
            stiffness_error_percent=10.0,
            reduction_tolerance=1e-2,
        ),
        Accuracy(
            name="standard",
            words="what a law is fitted to",
            energy_error_percent=10.0,
            ramp_slowness=SLOWNESS,
            stiffness_error_percent=5.0,
            reduction_tolerance=1e-3,
        ),
        Accuracy(
            name="fine",
            words="to see what `standard` leaves out",
            energy_error_percent=4.0,
            ramp_slowness=160.0,
            stiffness_error_percent=1.0,
            reduction_tolerance=1e-4,
        ),
    )
}
STANDARD = ACCURACIES["standard"]
"""Of a configuration without the word, and of a section by itself."""


def completed(content: Mapping[str, Any]) -> dict[str, Any]:
    """Content of a configuration with the values of its tier where it says nothing itself.

    What is malformed stays as it is and has its own sentence.
    """
    whole = dict(content)
    name = whole.get("accuracy", STANDARD.name)
    if not isinstance(name, str) or name not in ACCURACIES:
        return whole
    for path, value in ACCURACIES[name].values.items():
        section, _, key = path.partition(".")
        given = whole.get(section, {})
        if isinstance(given, Mapping) and _is_left_out(path, given):
            whole[section] = dict(given) | {key: value}
    return whole


def _is_left_out(path: str, section: Mapping[str, Any]) -> bool:
    _, _, key = path.partition(".")
    if path not in SETTLED_BY:
        return key not in section
    _, _, other = SETTLED_BY[path].partition(".")
    return section.get(key) is None and section.get(other, AUTO) == AUTO
