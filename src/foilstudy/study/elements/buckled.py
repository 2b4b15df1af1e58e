"""A deterministic post-buckling case: one dimple with sharp ridges, the same on every mesh.

A quarter of a cylinder with mirror symmetry at both straight edges and rigid rings at both curved
ones is shortened by 15 % of its height. A smooth dimple in the stress-free shape, eight times as
deep as the foil is thick and not quite in the middle (or else the panel could choose between
mirrored shapes), decides how it buckles; so there is one path, which every element follows from
the undeformed shape.
"""

from __future__ import annotations

import numpy as np

from foilstudy.linalg import SolveError
from foilstudy.model.patch import Patch, fitted_control_points, refine
from foilstudy.model.shell.shell import Shell
from foilstudy.model.supports.edges import RIGID_LINES, Constraints, constraints, symmetric
from foilstudy.model.supports.loads import DeadLoad
from foilstudy.solve.equilibrium.newton import NewtonOptions, NewtonResult, minimise
from foilstudy.solve.loading.loaded_sheet import LoadedSheet
from foilstudy.study.elements.variants import VARIANTS, Variant
from foilstudy.study.published import FEP

THICKNESS = 500e-6
"""m."""
RADIUS, HEIGHT, SHORTENING, DEPTH = 0.1, 0.1, 0.015, 0.004
"""m."""
_TILT = 0.25
_AROUND, _ALONG = 32, 20
"""Elements of the coarse mesh, 5 mm."""
LEVELS = (1, 2, 4)
"""Refinements at which the reference is computed: 5, 2.5 and 1.25 mm."""
_INCREMENTS = 8
_RESIDUAL, _RESIDUAL_ON_THE_WAY = 1e-6, 1e-3
_HESSIANS = 60


def buckled(variant: Variant) -> tuple[float, np.ndarray]:
    """Follow the shortening on the 5 mm mesh.

    Returns
    -------
    energy : float
        At the end, J; NaN where no stable equilibrium was found.
    points : ndarray, shape (3, rows, columns)
        m.
    """
    sheet, held = _panel(variant, 1)
    unknowns = np.zeros(held.free)
    for step in range(1, _INCREMENTS + 1):
        problem = _shortened(sheet, held, SHORTENING * step / _INCREMENTS)
        last = step == _INCREMENTS
        result = _minimum(problem, unknowns, _RESIDUAL if last else _RESIDUAL_ON_THE_WAY)
        unknowns = result.q
    points = problem.points(unknowns)
    found = result.status == "converged"
    return float(sheet.energies(points).total) if found else np.nan, points


def reference_energies(name: str) -> dict[str, list[float]]:
    """Follow the path on the coarse mesh, then refine: ``energies`` on those of `LEVELS`, J.

    The equilibrium on a finer mesh is sought from that on the coarser one, refined.

    Raises
    ------
    SolveError
        If one is not found.
    """
    variant = VARIANTS[name]
    energy, points = buckled(variant)
    energies = [energy]
    for level in LEVELS[1:]:
        sheet, held = _panel(variant, level)
        problem = _shortened(sheet, held, SHORTENING)
        result = _minimum(problem, problem.unknowns(refine(points, periodic=False)), _RESIDUAL)
        if result.status != "converged":
            raise SolveError(f"no equilibrium on the mesh refined {level} times: {result.message}")
        points = problem.points(result.q)
        energies.append(float(sheet.energies(points).total))
    return {"energies": energies}


def _surface(around: np.ndarray, along: np.ndarray) -> np.ndarray:
    angle = around / RADIUS
    dimple = np.sin(np.pi * along / HEIGHT) ** 2 * np.sin(2 * angle) ** 2
    dimple *= 1 + _TILT * (np.cos(2 * angle) + np.cos(np.pi * along / HEIGHT))
    radius = RADIUS - DEPTH * dimple
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), along])


def _panel(variant: Variant, level: int) -> tuple[Shell, Constraints]:
    """The stress-free panel and what holds it."""
    around, along = level * _AROUND, level * _ALONG
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
    sheet = Shell.elastic(patch, points, FEP, THICKNESS, variant.element)
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
