"""How fast the kernels are, against what this machine can do: a section of results.md, a roofline.

    .venv/bin/python benchmarks/kernel.py                        all of it, three minutes
    .venv/bin/python benchmarks/kernel.py results/default [...]  shares of physics of finished
                                                                 studies as well

Processor time on one core, on a machine that does nothing else: the median of many short
repetitions, and the least of them, which other work disturbs the least.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from measuring import PAGE, REPEATS, Timed, physics_share, timed_in_turns, write_section  # isort: skip

import numpy as np
from operations import Operations, operations
from peak import Machine, matrix_product, measured_machine, multiply_adds, spans, triad
from picture import Point, draw

from foilstudy.base.provenance import machine
from foilstudy.base.tables import markdown_table
from foilstudy.linalg import factorise
from foilstudy.model.patch import RING_ROWS, Patch
from foilstudy.model.shell.elements import corner_kernel
from foilstudy.pipeline.crumple import uncrumpled
from foilstudy.pipeline.method import Mesh
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import Ramp, Scheme, StoppingRule, relax
from foilstudy.solve.relaxation.mass.spectral import SpectralMassScaling
from foilstudy.study.published import foil

FOIL = foil(500, 170)
SIZES_MM = (5.0, 2.5, 1.25)
STEPS, RAMP_STEPS = 200, 2000
"""Steps that are timed, at the pace of a ramp of so many."""
PICTURE = PAGE.with_name("roofline.png")
NUMBER = 8
"""Bytes."""
FORCE, DOUBLE, SINGLE, STEP = "force kernel", "mass solve", "mass solve, single", "whole step"
ASSEMBLED, FACTORISED, SOLVED = "tangent assembled", "factorised", "solved, one right-hand side"


@dataclass(frozen=True)
class Case:
    """The published cylinder on one mesh."""

    size_mm: float
    problem: Problem

    @classmethod
    def on(cls, size_mm: float) -> Case:
        """On elements of so many mm."""
        return cls(size_mm, Problem(uncrumpled(FOIL, Mesh(size_mm * 1e-3)).stressed))

    @property
    def patch(self) -> Patch:
        """Of the mesh."""
        return self.problem.patch

    @property
    def elements(self) -> int:
        """Their number."""
        return self.patch.elements_around * self.patch.elements_along

    def __str__(self) -> str:
        patch = self.patch
        return f"{self.size_mm:g} mm ({patch.elements_around} x {patch.elements_along})"


@dataclass(frozen=True)
class Shares:
    """What the force kernel takes of what the machine can do, measured in turns with it.

    Attributes
    ----------
    peak : float
        Of the faster of loop and matrix product.
    vectors : float
        Of the loop of multiply-adds, which is compiled as the kernel is.
    bandwidth : float
        Where the mesh lies.
    """

    peak: float
    vectors: float
    bandwidth: float


def step_calls(case: Case) -> dict[str, Callable[[], object]]:
    """A step of the relaxation, `STEPS` at once, and its parts."""
    problem = case.problem
    noise = np.random.default_rng(0).standard_normal(case.patch.shape)
    points = problem.reference + 0.1 * FOIL.thickness * noise
    force = np.empty_like(points)
    problem.force(points, force)
    momentum = np.ascontiguousarray(force[:, RING_ROWS:-RING_ROWS])
    double, single = (
        SpectralMassScaling(single=single).start(problem).velocity for single in (False, True)
    )
    ramp = Ramp(FOIL.shortening * STEPS / RAMP_STEPS, STEPS)

    def steps():
        result = relax(problem, Scheme().start(problem), ramp, StoppingRule(0.0, 0))
        if result.steps != STEPS:
            raise RuntimeError(f"the steps that are timed ended early: {result.message}")

    return {
        FORCE: lambda: problem.force(points, force),
        DOUBLE: lambda: double(momentum),
        SINGLE: lambda: single(momentum),
        STEP: steps,
    }


def step_times(case: Case, limits: Machine, budget: float) -> tuple[dict[str, Timed], Shares]:
    """Times per element, and what of the machine the force kernel takes, all in turns."""
    level = limits.level_of(needed_bytes() * case.elements)
    most = {
        "vectors": multiply_adds(),
        "product": matrix_product(),
        "bytes": triad(spans(limits.sizes)[level]),
    }
    calls = {name: limit.call for name, limit in most.items()}
    times = timed_in_turns(step_calls(case) | calls, budget)
    speeds = {name: limit.speed(times.pop(name).median) for name, limit in most.items()}
    times[STEP] = times[STEP].per(STEPS)
    times = {name: each.per(case.elements) for name, each in times.items()}
    flops = counted_total(case.patch) / times[FORCE].median
    shares = Shares(
        flops / max(speeds["vectors"], speeds["product"]),
        flops / speeds["vectors"],
        needed_bytes() / times[FORCE].median / speeds["bytes"],
    )
    return times, shares


def tangent_times(case: Case, budget: float) -> tuple[int, dict[str, Timed]]:
    """Number of unknowns, and times per unknown of the tangent between held rings.

    The pattern is analysed once, before the factorisations that are timed.
    """
    problem = case.problem
    points = problem.reference
    matrix = problem.held_tangent(points)
    factor, unknowns = factorise(matrix), matrix.shape[0]
    load = np.cos(np.arange(unknowns, dtype=float))
    calls = {
        ASSEMBLED: lambda: problem.held_tangent(points),
        FACTORISED: lambda: factorise(matrix),
        SOLVED: lambda: factor.solve(load),
    }
    times = timed_in_turns(calls, budget)
    return unknowns, {name: each.per(unknowns) for name, each in times.items()}


def counted(patch: Patch) -> dict[str, Operations]:
    """Operations of the force kernel per element, by its stages."""
    lanes, steps = corner_kernel.LANES, corner_kernel.STEPS
    chunks = -(-patch.elements_around // (lanes * steps))
    data = chunks * (patch.elements_along + 1) * corner_kernel.VALUES * lanes * (steps + 1)
    points = np.broadcast_to(0.0, patch.shape)  # shapes decide, and no memory is needed
    found = operations(
        corner_kernel.internal_force, points, patch.elements_around, np.broadcast_to(0.0, data),
        None, (patch.size_around, patch.size_along), FOIL.thickness**2 / 12, points,
    )  # fmt: skip
    elements = patch.elements_around * patch.elements_along
    return {name.strip("_"): each.per(elements) for name, each in found.items()}


def counted_total(patch: Patch) -> float:
    """All of them."""
    return sum(counted(patch).values(), Operations()).total


def needed_bytes() -> int:
    """Bytes per element that the force kernel must move: element data, points, forces, once."""
    return NUMBER * (corner_kernel.VALUES + 3 + 3)


def touched_bytes(patch: Patch) -> float:
    """Bytes per element that it moves as things are laid out.

    Lanes are filled up, every chunk of a row has one place more and every mesh one row of vertices;
    a force is set to zero and added to.
    """
    lanes, steps = corner_kernel.LANES, corner_kernel.STEPS
    piece = -(-patch.elements_around // lanes)
    places = lanes * (piece + -(-piece // steps)) * (patch.elements_along + 1)
    points = patch.rows * patch.columns
    elements = patch.elements_around * patch.elements_along
    return NUMBER * (corner_kernel.VALUES * places + (3 + 3 * 3) * points) / elements


def roofline_point(case: Case, time: Timed, limits: Machine) -> Point:
    """Where the force kernel stands on one mesh."""
    total = counted_total(case.patch)
    level = limits.level_of(needed_bytes() * case.elements)
    return Point(
        f"{case.size_mm:g} mm", level, total, needed_bytes(), total / time.median,
        total / time.least,
    )  # fmt: skip


@dataclass(frozen=True)
class Measured:
    """Everything about one mesh."""

    case: Case
    steps: dict[str, Timed]
    shares: Shares
    unknowns: int
    tangent: dict[str, Timed]
    point: Point

    @classmethod
    def of(cls, case: Case, limits: Machine, budget: float) -> Measured:
        """Measure it, each time for so many seconds."""
        steps, shares = step_times(case, limits, budget)
        point = roofline_point(case, steps[FORCE], limits)
        return cls(case, steps, shares, *tangent_times(case, budget), point)


def _words(time: Timed, unit: float) -> str:
    return f"{time.median / unit:.3g} ({time.least / unit:.3g})"


def _columns(name: str, cells: Iterator[str]) -> list[str]:
    return [name, *cells]


def time_tables(meshes: Sequence[Measured]) -> list[str]:
    """Times per element and step, and per unknown, with what they are of each other."""
    heads = [str(mesh.case) for mesh in meshes]
    steps = [
        _columns(name, (_words(mesh.steps[name], 1e-9) for mesh in meshes))
        for name in (FORCE, DOUBLE, SINGLE, STEP)
    ]
    ratios = {
        "step less force and mass solve": lambda t: f"{1e9 * (t[STEP] - t[FORCE] - t[DOUBLE]):.3g}",
        "force kernel of the step": lambda t: f"{t[FORCE] / t[STEP]:.0%}",
        "mass solve, single of double": lambda t: f"{t[SINGLE] / t[DOUBLE]:.0%}",
    }
    medians = [{name: time.median for name, time in mesh.steps.items()} for mesh in meshes]
    steps += [_columns(name, map(ratio, medians)) for name, ratio in ratios.items()]
    tangent = [
        _columns(name, (_words(mesh.tangent[name], 1e-6) for mesh in meshes))
        for name in (ASSEMBLED, FACTORISED, SOLVED)
    ]
    tangent.append(_columns("unknowns", (str(mesh.unknowns) for mesh in meshes)))
    return [
        markdown_table(["ns per element and step", *heads], steps),
        markdown_table(["µs per unknown", *heads], tangent),
    ]


def limit_table(limits: Machine) -> str:
    """What this machine can do."""
    rows = [
        (f"multiply-adds in a loop, vectors of {limits.vector_bits} bits",
         f"{limits.flops / 1e9:.1f} Gflop/s"),
        ("matrix product of the library", f"{limits.product_flops / 1e9:.1f} Gflop/s"),
    ]  # fmt: skip
    rows += [
        (f"a = b + s c, {name}", f"{speed / 1e9:.1f} GB/s")
        for name, speed in limits.bandwidths.items()
    ]
    return markdown_table(["one core, double precision", "at most"], rows)


def share_table(meshes: Sequence[Measured]) -> str:
    """The force kernel against the limits, by medians."""
    rows = {
        "operations per element": lambda p, s: f"{p.operations:.0f}",
        "bytes per element, at least": lambda p, s: f"{p.bytes:.0f}",
        "operations per byte": lambda p, s: f"{p.intensity:.2f}",
        "Gflop/s": lambda p, s: f"{p.flops / 1e9:.1f}",
        "share of the machine's peak": lambda p, s: f"{s.peak:.0%}",
        "share of the peak of such vectors": lambda p, s: f"{s.vectors:.0%}",
        "lies in": lambda p, s: p.level,
        "GB/s": lambda p, s: f"{p.bandwidth / 1e9:.1f}",
        "share of the bandwidth there": lambda p, s: f"{s.bandwidth:.0%}",
    }
    cells = [
        _columns(name, (word(mesh.point, mesh.shares) for mesh in meshes))
        for name, word in rows.items()
    ]
    return markdown_table(["force kernel", *(mesh.point.name for mesh in meshes)], cells)


def count_table(patch: Patch) -> str:
    """Operations of the force kernel by its stages."""
    stages = counted(patch)
    stages = {name: each for name, each in stages.items() if each.total >= 0.5}
    stages["all"] = sum(stages.values(), Operations())
    rows = [
        (name, *(f"{n:.1f}" for n in (o.additions, o.multiplications, o.divisions, o.total)))
        for name, o in stages.items()
    ]
    heads = ["per element", "additions", "multiplications", "divisions", "all"]
    return markdown_table(heads, rows)


def section(meshes: Sequence[Measured], limits: Machine, got: float, folders: list[Path]) -> str:
    """The text of the section."""
    finest = meshes[-1].case
    how = (
        f"{machine()}. The published cylinder, {1e6 * FOIL.thickness:g} µm; processor time on one "
        f"core, medians of {REPEATS} or more repetitions, the least in brackets. The script had "
        f"{got:.0%} of a core."
    )
    steps, tangent = time_tables(meshes)
    touched = ", ".join(f"{touched_bytes(mesh.case.patch):.0f}" for mesh in meshes)
    counts = (
        f"Counted in the source as it runs on {finest}, padding included "
        "(`benchmarks/operations.py`); a division is one operation. Shares are of the same loops "
        "in turns with the kernel. Bytes at least: "
        f"{corner_kernel.VALUES} numbers of an element, three of a control point, three of a "
        f"force; as laid out they are {touched}."
    )
    parts = [how, steps, tangent, limit_table(limits), share_table(meshes)]
    parts += [f"![roofline]({PICTURE.name})", counts, count_table(finest.patch)]
    if folders:
        rows = [(f"`{folder.name}`", str(physics_share(folder))) for folder in folders]
        parts.append(markdown_table(["study", "physics of the time of its jobs"], rows))
    return "\n\n".join(part.strip() for part in parts)


def main() -> None:
    """Measure, draw and write the section."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("studies", nargs="*", type=Path, help="folders of finished studies")
    parser.add_argument("--seconds", type=float, default=2.0, help="for each time")
    parser.add_argument("--sizes-mm", nargs="+", type=float, default=SIZES_MM)
    options = parser.parse_args()
    clock, processor = time.perf_counter(), time.process_time()
    limits = measured_machine(options.seconds)
    meshes = [Measured.of(Case.on(size), limits, options.seconds) for size in options.sizes_mm]
    got = (time.process_time() - processor) / (time.perf_counter() - clock)
    draw([mesh.point for mesh in meshes], limits, PICTURE)
    write_section("Kernels", section(meshes, limits, got, options.studies))


if __name__ == "__main__":
    main()
