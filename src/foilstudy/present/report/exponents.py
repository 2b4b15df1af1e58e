"""What mesh and pre-stress do to the thickness exponent, in sentences."""

from collections.abc import Mapping, Sequence

from foilstudy.base.numerals import fixed
from foilstudy.present.report.laws import DirectionLaws, Law
from foilstudy.present.statistics.powerlaw import LIMIT, PLAIN, PRESTRESSED

_STEPS = (
    (PLAIN, LIMIT, "refining the same shapes to the mesh limit"),
    (PLAIN, PRESTRESSED, "leaving the stress in"),
    (
        PRESTRESSED,
        "simulation pre-stressed refined",
        "relaxing again on the refined mesh with the stress left in",
    ),
)
"""From which law to which, and what the step between them is called."""

_ALIKE = 0.005
"""Difference of exponents that is not worth a word: half of the last digit shown."""


def exponent_findings(directions: Sequence[DirectionLaws]) -> list[str]:
    """Say per direction what mesh and pre-stress do to the thickness exponent.

    Where there is something published every exponent is set beside it. Says nothing of a study of
    which no stiffness is trusted.
    """
    sentences = []
    for item in directions:
        laws = {law.source: law for law in item.laws if law.gamma.known}
        if PLAIN not in laws or item.answer is None:
            continue
        values = ", ".join(
            f"{fixed(law.gamma.value)}{law.gamma.margin} ({_place(law)})" for law in laws.values()
        )
        steps = [
            _step(laws, laws[before].gamma.value, laws[after].gamma.value, name)
            for before, after, name in _STEPS
            if before in laws and after in laws
        ]
        text = f"Thickness exponent of the {item.direction} stiffness: {values}."
        sentences.append(" ".join([text, *steps]))
    return sentences


def _place(law: Law) -> str:
    return law.source.removeprefix("simulation ") if law.source != PLAIN else "crumpled mesh"


def _step(laws: Mapping[str, Law], before: float, after: float, name: str) -> str:
    change = after - before
    if abs(change) < _ALIKE:
        return f"{name.capitalize()} leaves it as it is."
    places: dict[str, list[str]] = {"nearer to": [], "farther from": [], "as far from": []}
    for source in ("published simulation", "published experiment"):
        if source in laws:
            gain = abs(before - laws[source].gamma.value) - abs(after - laws[source].gamma.value)
            word = "nearer to" if gain > 0 else "farther from"
            places["as far from" if abs(gain) < _ALIKE else word].append(f"the {source}")
    verb = "raises" if change > 0 else "lowers"
    where = [f"{word} {' and '.join(names)}" for word, names in places.items() if names]
    beside = f": {', '.join(where)}" if where else ""
    return f"{name.capitalize()} {verb} it by {fixed(abs(change))}{beside}."
