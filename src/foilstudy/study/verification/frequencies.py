"""Natural frequencies of plates and of cylinders of foil, with the consistent mass matrix.

The order to expect is that of energies (`Candidate.order`), which squares of frequencies are
(Rayleigh quotients); the mass adds an error of order 4 to 6.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from foilstudy.linalg import Modes, SolveError, modes_below
from foilstudy.model.materials import Material
from foilstudy.model.patch import Patch, cylinder_control_points
from foilstudy.model.shell.tangent import mass_matrix
from foilstudy.model.supports.edges import (
    Constraints,
    EdgeCondition,
    clamped,
    constraints,
    diaphragm,
)
from foilstudy.study.published import FEP, HEIGHT, RADIUS
from foilstudy.study.verification import theory_cylinder, theory_plate
from foilstudy.study.verification.candidates import Candidate
from foilstudy.study.verification.linear import (
    drawn_points,
    plate_edges,
    plate_points,
    plate_rigidity,
    square_patch,
)
from foilstudy.study.verification.records import Benchmark, Checked, Picture
from foilstudy.study.verification.theory_cylinder import Cylinder

ELEMENTS_ALONG = 10 / 37
"""Elements along per element around, on this cylinder nearly square ones."""
_SEARCH = 1.4
"""Modes are sought up to this multiple of the highest frequency of interest."""

_PLATE_MESHES = (8, 16, 32)
_PLATE_MATERIAL = Material(1.0e9, 0.3, 1000.0, 1.0e6)
_PLATE_THICKNESS = 0.001


def natural_modes(sheet, held: Constraints, highest: float) -> Modes:
    """Modes up to a frequency in Hz; shapes on all control points, order row, column, component."""
    foil_mass = sheet.material.density * sheet.thickness * sheet.section.areas
    modes = modes_below(
        held.reduced_matrix(sheet.tangent()),
        held.reduced_matrix(mass_matrix(sheet.patch, foil_mass)),
        (2 * np.pi * highest) ** 2,
    )
    return Modes(modes.eigenvalues, held.matrix @ modes.shapes)


def plate_frequencies(candidate: Candidate, meshes: tuple[int, ...] = _PLATE_MESHES) -> Benchmark:
    """Lowest bending frequencies of square plates, free, simply supported and clamped."""
    cases = {
        "free": (theory_plate.FREE, 4, "Ritz; Leissa 1973: 13.489, 19.789, 24.432, 35.024"),
        "simply supported": (theory_plate.SIMPLY_SUPPORTED, 3, "pi^2 (m^2 + n^2)"),
        "clamped": (theory_plate.CLAMPED, 4, "Ritz; Leissa 1973: 35.992, 73.413, 108.27"),
    }
    scale = np.sqrt(
        _PLATE_MATERIAL.density
        * _PLATE_THICKNESS
        / plate_rigidity(_PLATE_MATERIAL, _PLATE_THICKNESS)
    )
    quantities, pictures = [], []
    for name, (condition, count, source) in cases.items():
        exact = theory_plate.frequencies(condition, _PLATE_MATERIAL.poisson_ratio, count)
        rigid = 6 if name == "free" else 0
        values = []
        for elements in meshes:
            patch = square_patch(elements)
            points = plate_points(patch, skewed=True)
            sheet = candidate.sheet(patch, points, _PLATE_MATERIAL, _PLATE_THICKNESS)
            held = (
                constraints(patch, {})
                if name == "free"
                else plate_edges(patch, points, name == "clamped")
            )
            modes = natural_modes(sheet, held, _SEARCH * exact[-1] / scale / (2 * np.pi))
            values.append(np.sqrt(modes.eigenvalues[rigid : rigid + count]) * scale)
        shape = modes.shapes[:, rigid].reshape(patch.rows, patch.columns, 3)
        pictures.append(mode_picture(patch, points, shape.transpose(2, 0, 1), f"{name} plate"))
        for k in _distinct(exact):
            quantities.append(
                Checked(
                    f"{name} plate, frequency {k + 1}", "sqrt(D/(rho t))/a^2", float(exact[k]),
                    source, "side", meshes, tuple(float(v[k]) for v in values), exact=True,
                )
            )  # fmt: skip
    return Benchmark(
        "plate_frequencies",
        "Natural frequencies of square plates on a skewed grid",
        candidate.name,
        tuple(quantities),
        pictures=tuple(pictures),
    )


@dataclass(frozen=True)
class CylinderCase:
    """Cylinder frequencies to compare: mesh sequence and circumferential orders."""

    edges: str
    thickness: float
    meshes: tuple[int, ...]
    orders: tuple[int, ...]
    kinds: int = 1
    """How many of the lowest modes of each order."""

    def theory(self, n: int) -> np.ndarray:
        """Exact frequencies of order n, Hz."""
        cylinder = Cylinder(RADIUS, HEIGHT, self.thickness, FEP)
        conditions = {
            "clamped": theory_cylinder.CLAMPED,
            "diaphragm": theory_cylinder.DIAPHRAGM,
            "free": theory_cylinder.FREE,
        }
        return theory_cylinder.frequencies(cylinder, conditions[self.edges], n, self.kinds)


def cylinder_frequencies(
    candidate: Candidate, edges: str, cases: Sequence[CylinderCase] | None = None
) -> Benchmark:
    """Frequencies of the uncrumpled foil cylinder, both edges alike.

    Parameters
    ----------
    edges : str
        ``clamped``, ``diaphragm`` or ``free``.
    cases : sequence of CylinderCase, optional
        Others than `CASES`, 500 and 50 um.
    """
    order = candidate.order(free_edge=edges == "free")
    quantities, pictures = [], []
    for case in cases or CASES[edges]:
        found = [_by_order(candidate, case, around) for around in case.meshes]
        label = f"{1e6 * case.thickness:g} um"
        for n in case.orders:
            for kind, exact in enumerate(case.theory(n)):
                values = tuple(float(mesh[n].frequencies[kind]) for mesh, _ in found)
                suffix = f" ({kind + 1})" if case.kinds > 1 else ""
                quantities.append(
                    Checked(
                        f"{edges} cylinder {label}, n = {n}{suffix}", "Hz", float(exact),
                        "Koiter's shell theory, Ritz to 6 digits", "circumference",
                        case.meshes, values, order, exact=True,
                        family=f"{edges} cylinder {label}",
                    )
                )  # fmt: skip
        pictures += [
            mode_picture(*found[-1][1], found[-1][0][n].shape, f"{edges} {label}, n = {n}")
            for n in case.orders[:2]
        ]
    return Benchmark(
        f"{edges}_cylinder",
        f"Natural frequencies of the foil cylinder, edges {edges}",
        candidate.name,
        tuple(quantities),
        pictures=tuple(pictures),
    )


@dataclass(frozen=True)
class _Family:
    """Frequencies of one circumferential order, Hz, and the displacement of its lowest mode."""

    frequencies: Sequence[float]
    shape: np.ndarray


def _by_order(
    candidate: Candidate, case: CylinderCase, around: int
) -> tuple[Mapping[int, _Family], tuple]:
    """Modes of one mesh sorted by circumferential order, and patch and points of the mesh."""
    along = round(around * ELEMENTS_ALONG)
    patch = Patch(around, along, 2 * np.pi * RADIUS / around, HEIGHT / along)
    points = cylinder_control_points(patch, 2 * RADIUS)
    sheet = candidate.sheet(patch, points, FEP, case.thickness)
    held = constraints(patch, {e: _condition(case.edges, patch, points, e) for e in _ENDS})
    highest = max(case.theory(n)[-1] for n in case.orders)
    modes = natural_modes(sheet, held, _SEARCH * highest)
    orders = circumferential_orders(patch, points, modes.shapes)
    families = {}
    for n in case.orders:
        mine = np.flatnonzero(orders == n)[::2]  # every mode comes twice, as cosine and as sine
        if len(mine) < case.kinds:
            raise SolveError(
                f"{len(mine)} of {case.kinds} modes of circumferential order {n} lie below "
                f"{_SEARCH * highest:.4g} Hz on {around} elements around: the mesh is too coarse"
            )
        shape = modes.shapes[:, mine[0]].reshape(patch.rows, patch.columns, 3).transpose(2, 0, 1)
        families[n] = _Family(np.sqrt(modes.eigenvalues[mine]) / (2 * np.pi), shape)
    return families, (patch, points)


def circumferential_orders(patch: Patch, points: np.ndarray, shapes: np.ndarray) -> np.ndarray:
    """Strongest circumferential wave number of every mode, in all components together.

    Rigid motions have some without any radial displacement.
    """
    x, y = points[:2] / np.linalg.norm(points[:2], axis=0)
    motion = shapes.reshape(patch.rows, patch.columns, 3, -1).transpose(2, 3, 0, 1)
    radial, tangential = x * motion[0] + y * motion[1], x * motion[1] - y * motion[0]
    waves = np.fft.rfft([radial, tangential, motion[2]], axis=-1)
    return np.argmax(np.sum(np.abs(waves) ** 2, axis=(0, 2)), axis=-1)


def mode_picture(patch: Patch, points: np.ndarray, shape: np.ndarray, title: str) -> Picture:
    """A mode, its largest displacement drawn as a twelfth of the extent, coloured by its size."""
    surface, motion = drawn_points(patch, points), drawn_points(patch, shape)
    normal = np.cross(np.gradient(surface, axis=2), np.gradient(surface, axis=1), axis=0)
    across = np.sum(normal / np.linalg.norm(normal, axis=0) * motion, axis=0)
    extent = np.ptp(surface.reshape(3, -1), axis=1).max()
    peak = np.linalg.norm(motion, axis=0).max()
    return Picture.of(title, surface + extent / 12 / peak * motion, across)


_ENDS = ("bottom", "top")


def _condition(edges: str, patch: Patch, points: np.ndarray, edge: str) -> EdgeCondition:
    if edges == "clamped":
        return clamped(patch, points, edge)
    return diaphragm(0, 1) if edges == "diaphragm" else EdgeCondition()


def _distinct(values: np.ndarray) -> list[int]:
    """Places of the values that differ from the one before."""
    return [k for k in range(len(values)) if k == 0 or values[k] > values[k - 1] * (1 + 1e-6)]


_MESHES = (37, 74, 148, 222)
_FINE_MESHES = (111, 148, 222, 296)
CASES = {
    "clamped": (
        CylinderCase("clamped", 500e-6, _MESHES, (7, 8, 6)),
        CylinderCase("clamped", 50e-6, _FINE_MESHES, (14, 15, 13)),
    ),
    "diaphragm": (
        CylinderCase("diaphragm", 500e-6, _MESHES, (7, 6, 8)),
        CylinderCase("diaphragm", 50e-6, _FINE_MESHES, (12, 13, 11)),
    ),
    "free": (
        CylinderCase("free", 500e-6, _MESHES, (2, 3, 4), 2),
        CylinderCase("free", 50e-6, _FINE_MESHES, (2, 4, 6), 2),
    ),
}
"""The coarsest mesh of each is not yet where the order is seen: quadratic splines lock there."""
