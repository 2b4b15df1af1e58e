"""Stiffness measures and stress removals on crumples of the published foil."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.tables import markdown_table
from foilstudy.linalg import SolveError
from foilstudy.measure.choices import STRESS_REMOVALS
from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.model.foil import Imperfection
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.measures import STIFFNESS_MEASURES
from foilstudy.pipeline.method import Mesh
from foilstudy.study.changes import changed
from foilstudy.study.kernel.plan import Records
from foilstudy.study.limits.measured import Measured
from foilstudy.study.limits.plan import LIMITS
from foilstudy.study.limits.trial import baseline
from foilstudy.study.published import foil

REFERENCE = "tangent"
"""The measure, and by `Reset` the stress removal, to which the others are compared."""


def measure(case: Measured) -> dict:
    """Crumple once, and measure in every way.

    Returns
    -------
    dict
        ``status``; by the names of the measures and removals ``measures`` and ``removals``, each
        with ``stiffness`` (axial and radial, N/m; None where there is none) and ``message``.
    """
    sheet = foil(case.thickness_um, case.height_mm)
    method = baseline(sheet)
    if case.ramp_steps is not None:
        method = changed(method, "path.ramp_steps", case.ramp_steps)
    crumpled = crumple(sheet, Mesh(case.size_mm * 1e-3), Imperfection(seed=case.seed), method)
    if crumpled.status != "converged":
        return {"status": crumpled.status, "measures": {}, "removals": {}}
    return {
        "status": crumpled.status,
        "measures": dict(_measures(crumpled)),
        "removals": dict(_removals(crumpled)),
    }


def _measures(crumpled: Crumpled) -> Iterator[tuple[str, dict]]:
    for one in LIMITS.measures.ways:
        way = STIFFNESS_MEASURES[one.measure](**one.set)
        found = way.of(crumpled)
        yield one.name, {"stiffness": list(map(float, found.stiffness)), "message": found.message}


def _removals(crumpled: Crumpled) -> Iterator[tuple[str, dict]]:
    for name in STRESS_REMOVALS:
        recipe = crumpled.recipe
        method = replace(recipe.method, stress_removal=STRESS_REMOVALS[name]())
        other = replace(crumpled, recipe=replace(recipe, method=method))
        try:
            yield name, {"stiffness": list(map(float, other.stiffness())), "message": ""}
        except (SolveError, Refusal) as error:
            yield name, {"stiffness": [np.nan] * len(DIRECTIONS), "message": str(error)}


@dataclass(frozen=True)
class Ratio:
    """Of one way to the reference, over the seeds of a crumple."""

    least: float
    most: float
    count: int
    of: int

    @property
    def words(self) -> str:
        """For people."""
        if not self.count:
            return "none"
        few = "" if self.count == self.of else f" ({self.count} of {self.of})"
        ends = dict.fromkeys((f"{self.least:.2f}", f"{self.most:.2f}"))
        return " to ".join(ends) + few


def rows(records: Records) -> list[dict]:
    """One row for each crumple, way and direction."""
    return [
        {
            "thickness_um": case.thickness_um,
            "height_mm": case.height_mm,
            "ramp_steps": case.ramp_steps,
            "seed": case.seed,
            "kind": kind,
            "way": name,
            "direction": direction,
            "stiffness": value,
            "message": found["message"],
        }
        for case, record in records["measures"].items()
        for kind in ("measures", "removals")
        for name, found in record.result[kind].items()
        for direction, value in zip(DIRECTIONS, found["stiffness"], strict=True)
    ]


def page(records: Records) -> str:
    """Every way over the reference: a table of measures and one of stress removals."""
    return "\n".join(_table(records, kind) for kind in ("measures", "removals"))


def _table(records: Records, kind: str) -> str:
    crumples = list(dict.fromkeys(replace(case, seed=0) for case in records["measures"]))
    ways = dict.fromkeys(
        name for record in records["measures"].values() for name in record.result[kind]
    )
    heads = ["over the tangent of the reset shape", *map(_words, crumples)]
    body = [
        [
            f"{name}, {direction}",
            *(_ratio(records, c, kind, name, direction).words for c in crumples),
        ]
        for name in ways
        for direction in DIRECTIONS
    ]
    return markdown_table(heads, body)


def _words(crumple: Measured) -> str:
    ramp = "" if crumple.ramp_steps is None else f", ramp {crumple.ramp_steps}"
    return f"{crumple.thickness_um} um, {crumple.height_mm} mm{ramp}"


def _ratio(records: Records, crumple: Measured, kind: str, name: str, direction: str) -> Ratio:
    k = DIRECTIONS.index(direction)
    found = [
        record.result
        for case, record in records["measures"].items()
        if replace(case, seed=0) == crumple
    ]
    ratios = [
        value / result["measures"][REFERENCE]["stiffness"][k]
        for result in found
        if name in result[kind]
        for value in (result[kind][name]["stiffness"][k],)
        if value is not None and np.isfinite(value)
    ]
    return Ratio(min(ratios, default=np.nan), max(ratios, default=np.nan), len(ratios), len(found))
