"""A deterministic post-buckling case: one dimple with sharp ridges, the same on every mesh.

A quarter of a cylinder with mirror symmetry at both straight edges and rigid rings at both curved
ones is shortened by 15 % of its height. A smooth dimple in the stress-free shape, eight times as
deep as the foil is thick and not quite in the middle (or else the panel could choose between
mirrored shapes), decides how it buckles; so there is one path, which every element follows from
the undeformed shape.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.linalg import SolveError
from foilstudy.model.patch import Patch, fitted_control_points, refine
from foilstudy.model.shell.elements.protocol import Element
from foilstudy.model.shell.shell import Shell
from foilstudy.model.supports.edges import RIGID_LINES, Constraints, constraints, symmetric
from foilstudy.model.supports.loads import DeadLoad
from foilstudy.solve.equilibrium.newton import NewtonOptions, NewtonResult, minimise
from foilstudy.solve.loading.loaded_sheet import LoadedSheet
from foilstudy.study.elements.plan import COARSE_MM
from foilstudy.study.elements.variants import VARIANTS
from foilstudy.study.published import FEP

THICKNESS = 500e-6
"""m."""
RADIUS, HEIGHT, SHORTENING, DEPTH = 0.1, 0.1, 0.015, 0.004
"""m."""
_TILT = 0.25
_AROUND, _ALONG = 32, 20
"""Elements of the coarse mesh, `COARSE_MM`."""
LEVELS = (1, 2, 4)
"""Refinements at which the reference is computed: 5, 2.5 and 1.25 mm."""
_HESSIANS = 60


@dataclass(frozen=True)
class Way:
    """How the shortening is followed.

    Attributes
    ----------
    size_mm : float
        Of the elements.
    increments : int
        Of the shortening.
    residual, residual_on_the_way : float
        At which the last equilibrium counts, and those before it.
    """

    size_mm: float = COARSE_MM
    increments: int = 8
    residual: float = 1e-6
    residual_on_the_way: float = 1e-3


@dataclass(frozen=True, eq=False)
class Panel:
    """The panel at the end of a way.

    Attributes
    ----------
    energy : float
        J; NaN where no stable equilibrium was found.
    points : ndarray, shape (3, rows, columns)
        m.
    """

    energy: float
    points: np.ndarray


def buckled(element: Element, way: Way | None = None) -> Panel:
    """Follow the shortening from the undeformed shape, by default on the 5 mm mesh."""
    way = way or Way()
    sheet, held = _panel(element, COARSE_MM / way.size_mm)
    unknowns = np.zeros(held.free)
    for step in range(1, way.increments + 1):
        problem = _shortened(sheet, held, SHORTENING * step / way.increments)
        last = step == way.increments
        result = _minimum(problem, unknowns, way.residual if last else way.residual_on_the_way)
        unknowns = result.q
    points = problem.points(unknowns)
    found = result.status == "converged"
    return Panel(float(sheet.energies(points).total) if found else np.nan, points)


def refined_panels(element: Element) -> list[Panel]:
    """Follow the path on the coarse mesh, then refine: a panel for each of `LEVELS`.

    The equilibrium on a finer mesh is sought from that on the coarser one, refined.

    Raises
    ------
    SolveError
        If one is not found.
    """
    panels = [buckled(element)]
    for level in LEVELS[1:]:
        sheet, held = _panel(element, level)
        problem = _shortened(sheet, held, SHORTENING)
        refined = refine(panels[-1].points, periodic=False)
        result = _minimum(problem, problem.unknowns(refined), Way.residual)
        if result.status != "converged":
            raise SolveError(f"no equilibrium on the mesh refined {level} times: {result.message}")
        points = problem.points(result.q)
        panels.append(Panel(float(sheet.energies(points).total), points))
    return panels


def reference_energies(name: str) -> dict[str, list[float]]:
    """Of `refined_panels` by one of the variants: ``energies``, J."""
    return {"energies": [panel.energy for panel in refined_panels(VARIANTS[name].element)]}


def _surface(around: np.ndarray, along: np.ndarray) -> np.ndarray:
    angle = around / RADIUS
    dimple = np.sin(np.pi * along / HEIGHT) ** 2 * np.sin(2 * angle) ** 2
    dimple *= 1 + _TILT * (np.cos(2 * angle) + np.cos(np.pi * along / HEIGHT))
    radius = RADIUS - DEPTH * dimple
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), along])


def _panel(element: Element, level: float) -> tuple[Shell, Constraints]:
    """The stress-free panel on the coarse mesh refined by a factor, and what holds it."""
    around, along = round(level * _AROUND), round(level * _ALONG)
    patch = Patch(around, along, np.pi / 2 * RADIUS / around, HEIGHT / along, periodic=False)
    points = fitted_control_points(patch, _surface)
    # `symmetric` needs the exact mirror image, to the last bit
    points[:, :, 0] = points[:, :, 1] * np.array([1.0, -1.0, 1.0])[:, None]
    points[:, :, -1] = points[:, :, -2] * np.array([-1.0, 1.0, 1.0])[:, None]
    edges = {
        "bottom": RIGID_LINES,
        "top": RIGID_LINES,
        "left": symmetric(1),
        "right": symmetric(0),
    }
    sheet = Shell.elastic(patch, points, FEP, THICKNESS, element)
    return sheet, constraints(patch, edges)


def _shortened(sheet: Shell, held: Constraints, shortening: float) -> LoadedSheet:
    """The panel with its top ring lowered; unknowns count from an even shortening."""
    share = np.clip(sheet.reference[2].mean(axis=1) / HEIGHT, 0.0, 1.0)
    share[:2], share[-2:] = 0.0, 1.0
    base = sheet.reference.copy()
    base[2] -= shortening * share[:, None]
    return LoadedSheet(sheet, held, DeadLoad(base, np.zeros_like(base)), base=base)


def _minimum(problem: LoadedSheet, unknowns: np.ndarray, residual: float) -> NewtonResult:
    options = NewtonOptions(residual, problem.internal_force_size, _HESSIANS)
    return minimise(problem, unknowns, options)
