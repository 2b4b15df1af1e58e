"""What elements of several sizes would save in a crumple, and smaller ones late in its ramp."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from foilstudy.linalg import SolveError
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.shape import Shape
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.loop import Ramp, StoppingRule, relax
from foilstudy.study.elements.plan import DEFAULT
from foilstudy.study.elements.variants import VARIANTS
from foilstudy.study.published import CrumpleCase, foil
from foilstudy.study.tradeoff.adaptive import sensor, sizes
from foilstudy.study.tradeoff.ensembles import method_for
from foilstudy.study.tradeoff.pace import in_turns

STAGES = (0.15, 0.25, 0.35, 0.5, 0.65, 0.8, 1.0)
"""Shares of the steps of the ramp at which its shape is looked at."""
_CELLS = (1, 2, 4, 8)
"""Elements a side of what is made one element."""


def measure(case: CrumpleCase) -> dict:
    """Crumple a foil, and say what it would gain by an adaptive mesh.

    Returns
    -------
    dict
        ``levels``, of the best tree; ``shares`` of the area by level, coarsest first; ``errors``
        of the energy, relative, on elements of the mesh and twice, four and eight times as large;
        ``gain``, elements of the uniform mesh over those of others with the same error: ``ideal``,
        ``tree``, ``unbalanced`` tree, ``graded``; ``kernel``, time of the general kernel over that
        of the vectorised one; ``ramp``, see `_ramp`.

    Raises
    ------
    SolveError
        If it does not come to rest.
    """
    recipe = _recipe(case)
    start, crumpled = uncrumpled(*recipe), crumple(*recipe)
    if crumpled.status != "converged":
        raise SolveError(f"the crumple whose elements are counted failed: {crumpled.message}")
    fields = sensor.strain_fields(crumpled)
    tree, loose = sizes.best_tree(fields), sizes.best_tree(fields, balanced=False)
    uniform = fields[0].size
    return {
        "elements": uniform,
        "energy": crumpled.energies().total,
        "levels": tree.levels,
        "shares": [tree.share(k) for k in range(sizes.COARSEST, sizes.FINEST - 1, -1)],
        "errors": _relative_errors(crumpled),
        "gain": {
            "ideal": sizes.ideal_gain(sensor.spread(fields, 2, 2)),
            "unbalanced": uniform / loose.elements,
            "tree": uniform / tree.elements,
            "graded": sizes.graded_gain(*sensor.directional_errors(fields)),
        },
        "kernel": _kernel_ratio(crumpled),
        "ramp": _ramp(start, crumpled),
    }


def _recipe(case: CrumpleCase) -> tuple[Foil, Mesh, Imperfection, Method]:
    """With the ramp that a study takes."""
    sheet = foil(case.thickness_um, case.height_mm)
    mesh = Mesh(case.size_mm * 1e-3, case.element)
    return sheet, mesh, Imperfection(seed=case.seed), method_for(sheet)


def _relative_errors(shape: Shape) -> np.ndarray:
    fields = sensor.strain_fields(shape)
    energy = (fields**2).sum()
    return np.array([sensor.cell_errors(fields, cells).sum() for cells in _CELLS]) / energy


def _kernel_ratio(crumpled: Crumpled) -> float:
    """How much longer a force takes by the kernel that asks no order of its elements."""
    general = replace(crumpled, element=VARIANTS[DEFAULT].general_kernel()).stressed
    own, points = crumpled.stressed, crumpled.points
    force = np.empty_like(points)
    general.force(points, force)  # compiles
    _, times = in_turns(lambda: general.force(points, force), lambda: own.force(points, force))
    return times["seconds"] / times["pace"]


def _ramp(start: Crumpled, crumpled: Crumpled) -> dict[str, Any]:
    """How large the elements of the ramp may be.

    Returns
    -------
    dict
        ``steps`` and ``shortening``, shares of the whole at each stage; ``size``, of the uniform
        elements that have the relative error which the crumple has on its mesh, over those of the
        mesh. Shares of the processor time of the crumple: ``share``, what the ramp takes;
        ``by_stage``, what larger elements of these sizes would save of it at most; ``coarsened``,
        what elements twice as large would save until minimisation takes over, whatever their error.
    """
    path, shortening = crumpled.method.path, crumpled.foil.shortening
    ramp = Ramp(shortening, path.ramp_steps)
    steps = tuple(round(stage * path.ramp_steps) for stage in STAGES)
    shapes = ramp_shapes(start, ramp, steps)
    errors = [_relative_errors(shape) for shape in shapes]
    size = [allowed_size(each, _relative_errors(crumpled)[0]) for each in errors]
    costs = crumpled.arrival.costs
    relaxing = costs["relaxing"].cpu_seconds
    relaxing /= relaxing + costs["settling"].cpu_seconds
    share = relaxing * path.ramp_steps / crumpled.arrival.history.step[-1]
    # each size is taken to last until the next stage, and the largest until the first: a bound
    lasting = np.maximum([_CELLS[-1], *size[:-1]], 1.0)
    needed = np.sum(np.diff(STAGES, prepend=0.0) / lasting**2)
    return {
        "steps": STAGES,
        "shortening": [ramp.shortening_at(step) / shortening for step in steps],
        "size": size,
        "share": float(share),
        "by_stage": float(share * (1 - needed)),
        "coarsened": 0.75 * relaxing,
    }


def allowed_size(errors: np.ndarray, allowed: float) -> float:
    """Element size at which the error is as allowed, over that of the mesh, eight at most."""
    if allowed < errors[0]:
        return float(np.sqrt(allowed / errors[0]))
    return float(np.exp(np.interp(np.log(allowed), np.log(errors), np.log(_CELLS))))


def ramp_shapes(start: Crumpled, ramp: Ramp, steps: tuple[int, ...]) -> list[Shape]:
    """What a foil looks like after these steps of its ramp."""
    problem = Problem(start.stressed, _Witness(steps))
    motion = start.method.path.scheme.start(problem)
    relax(problem, motion, ramp, StoppingRule(np.inf, 0))
    return [replace(start, points=points) for points in problem.state[1].seen]


@dataclass(frozen=True)
class _Seen:
    steps: int = 0
    seen: tuple[np.ndarray, ...] = ()


@dataclass(frozen=True)
class _Witness:
    """A term without energy that remembers the shapes after some steps."""

    steps: tuple[int, ...]
    energy_names = ()

    def start(self) -> _Seen:
        return _Seen()

    def force(self, points: np.ndarray, out: np.ndarray, state: _Seen) -> np.ndarray:
        out[:] = 0.0
        return np.empty(0)

    def evolved(self, points: np.ndarray, state: _Seen) -> _Seen:
        now = state.steps + 1
        return _Seen(now, (*state.seen, points.copy()) if now in self.steps else state.seen)
