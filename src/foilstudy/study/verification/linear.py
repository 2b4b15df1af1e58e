"""Linear statics: plates with series solutions, the Scordelis-Lo roof, the pinched cylinder.

The order to expect is that of energies (`Candidate.order`), of which the displacement under a load
is one; strains sampled at the middle or at the corners of elements add an error of second order.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg import factorise
from foilstudy.model.materials import Material
from foilstudy.model.patch import Patch, fitted_control_points, knot_points
from foilstudy.model.supports.edges import (
    SIMPLY_SUPPORTED,
    Constraints,
    clamped,
    constraints,
    diaphragm,
    symmetric,
)
from foilstudy.model.supports.interpolation import along_weights, around_weights
from foilstudy.model.supports.loads import DeadLoad, area_load, point_load
from foilstudy.study.verification import theory_plate
from foilstudy.study.verification.candidates import Candidate
from foilstudy.study.verification.records import Benchmark, Checked, Picture
from foilstudy.study.verification.theory_cylinder import Cylinder, pinched_deflection
from foilstudy.study.verification.theory_roof import Roof, edge_deflection

_SIDE, _PLATE_THICKNESS = 1.0, 0.001
_PLATE_MATERIAL = Material(1.0e9, 0.3, 1000.0, 1.0e6)
_SKEW = 0.08
"""How far, in sides, the lines of the skewed grid bend; in the middle they meet at 37 degrees."""


def solve(sheet, held: Constraints, load: DeadLoad) -> np.ndarray:
    """Displacement of the control points in linear statics, shape (3, rows, columns), m."""
    factor = factorise(held.reduced_matrix(sheet.tangent()))
    return held.displacement(factor.solve(held.reduced(load.force)))


def displacement_at(patch: Patch, field: np.ndarray, at: tuple[float, float]) -> np.ndarray:
    """Displacement (3,) of the sheet at parameters around and along."""
    along = along_weights(patch, np.array([at[1]]))[0]
    around = around_weights(patch, np.array([at[0]]))[0]
    return np.einsum("j,i,cji->c", along, around, field)


def plate_points(patch: Patch, skewed: bool) -> np.ndarray:
    """Square plate of side 1 with straight or with skewed lines; edges and middle are alike."""
    skew = _SKEW * skewed

    def surface(x, y):
        bent_x = x - skew * np.sin(np.pi * x) * np.sin(2 * np.pi * y)
        bent_y = y - skew * np.sin(2 * np.pi * x) * np.sin(np.pi * y)
        return np.stack([bent_x, bent_y, np.zeros_like(x)])

    return fitted_control_points(patch, surface)


def plate_edges(patch: Patch, reference: np.ndarray, clamp: bool) -> Constraints:
    """All four edges clamped or simply supported."""
    edges = {}
    for edge in ("bottom", "top", "left", "right"):
        edges[edge] = clamped(patch, reference, edge) if clamp else SIMPLY_SUPPORTED
    return constraints(patch, edges)


def square_patch(elements: int) -> Patch:
    """Open patch of the plate."""
    return Patch(elements, elements, _SIDE / elements, _SIDE / elements, periodic=False)


def plates(candidate: Candidate, meshes: tuple[int, ...] = (8, 16, 32, 64)) -> Benchmark:
    """Square plates under uniform load, clamped and simply supported, straight and skewed grids."""
    rigidity = plate_rigidity(_PLATE_MATERIAL, _PLATE_THICKNESS)
    quantities, pictures = [], []
    cases = (
        (True, theory_plate.clamped_deflection(), "Taylor Govindjee 2004, 0.00126532"),
        (False, theory_plate.simply_supported_deflection(), "Levy's series, 0.00406235"),
    )
    for clamp, reference, source in cases:
        for skewed in (False, True):
            name = (
                f"{'clamped' if clamp else 'simply supported'}, {'skewed' * skewed or 'straight'}"
            )
            values = []
            for elements in meshes:
                patch = square_patch(elements)
                points = plate_points(patch, skewed)
                sheet = candidate.sheet(patch, points, _PLATE_MATERIAL, _PLATE_THICKNESS)
                load = area_load(patch, points, np.array([0.0, 0.0, 1.0]))
                field = solve(sheet, plate_edges(patch, points, clamp), load)
                deflection = displacement_at(patch, field, (0.5 * _SIDE, 0.5 * _SIDE))[2]
                values.append(float(deflection * rigidity))
                if elements == meshes[-2] and skewed:
                    pictures.append(_picture(patch, points, field, f"{name} grid"))
            quantities.append(
                Checked(
                    f"centre deflection, {name} grid", "q a^4/D", reference, source, "side",
                    meshes, tuple(values), exact=True,
                )
            )  # fmt: skip
    return Benchmark(
        "plates", "Square plates under uniform load", candidate.name, tuple(quantities),
        pictures=tuple(pictures),
    )  # fmt: skip


def plate_rigidity(material: Material, thickness: float) -> float:
    """D = E t^3 / (12 (1 - nu^2)), N m."""
    return material.youngs_modulus * thickness**3 / (12 * (1 - material.poisson_ratio**2))


def scordelis_lo(candidate: Candidate, meshes: tuple[int, ...] = (6, 12, 24, 48)) -> Benchmark:
    """Barrel vault under its weight between two diaphragms: deflection amid a free edge.

    One quarter; R 25, L 50, t 0.25, E 4.32e8, nu 0, weight 90 per area, half angle 40 degrees.
    """
    radius, length, angle, thickness = 25.0, 50.0, np.radians(40.0), 0.25
    material = Material(4.32e8, 0.0, 1.0, 1.0)

    def model(elements: int):
        patch = Patch(
            elements, elements, radius * angle / elements, 0.5 * length / elements, periodic=False
        )
        points = fitted_control_points(patch, _arc(radius))
        held = constraints(
            patch, {"bottom": diaphragm(0, 1), "top": symmetric(2), "left": symmetric(1)}
        )
        load = area_load(patch, points, np.array([-90.0, 0.0, 0.0]))
        at = (radius * angle, 0.5 * length)
        return patch, points, held, load, lambda field: -displacement_at(patch, field, at)[0]

    values, picture = _sequence(candidate, meshes, model, (material, thickness))
    roof = Roof(Cylinder(radius, length, thickness, material), angle, 90.0)
    order = candidate.order(free_edge=True)
    quantities = (
        Checked(
            "deflection amid the free edge, published", "1", 0.3006,
            "Kirchhoff-Love value of isogeometric literature", "half arc", meshes, values,
            expected_rate=order,
        ),
        Checked(
            "deflection amid the free edge, exact", "1", edge_deflection(roof),
            "Koiter's theory, Fourier-Ritz series", "half arc", meshes, values, exact=True,
            expected_rate=order,
        ),
    )  # fmt: skip
    return Benchmark(
        "scordelis_lo", "Scordelis-Lo roof", candidate.name, quantities, pictures=(picture,)
    )


def pinched_cylinder(
    candidate: Candidate, meshes: tuple[int, ...] = (16, 32, 64, 128)
) -> Benchmark:
    """Cylinder between diaphragms, pinched by two opposite forces at mid-length.

    One octant; R 300, L 600, t 3, E 3e6, nu 0.3, P 1. The published value is the series solution
    164.24 P / (E t) of G. M. Lindberg, M. D. Olson, G. R. Cowper, New developments in the finite
    element analysis of shells, Nat. Research Council of Canada, Q. Bull. Div. Mech. Engng 4 (1969).
    The series of Koiter's theory, summed to the end, is 0.19 % larger. Under a force the curvature
    grows like a logarithm, and the order of 2 carries a logarithm of the element size.
    """
    radius, length, thickness = 300.0, 600.0, 3.0
    material = Material(3.0e6, 0.3, 1.0, 1.0)

    def model(elements: int):
        patch = Patch(
            elements, elements, 0.5 * np.pi * radius / elements, 0.5 * length / elements,
            periodic=False,
        )  # fmt: skip
        points = fitted_control_points(patch, _arc(radius))
        held = constraints(
            patch,
            {
                "bottom": diaphragm(0, 1),
                "top": symmetric(2),
                "left": symmetric(1),
                "right": symmetric(0),
            },
        )
        at = (0.0, 0.5 * length)
        load = point_load(patch, points, at, np.array([-0.25, 0.0, 0.0]))
        return patch, points, held, load, lambda field: -displacement_at(patch, field, at)[0]

    values, picture = _sequence(candidate, meshes, model, (material, thickness))
    series = pinched_deflection(Cylinder(radius, length, thickness, material))
    quantities = (
        Checked(
            "deflection under the force, published", "1", 1.8248e-5,
            "164.24 P/(E t), Lindberg, Olson, Cowper 1969", "quarter circumference",
            meshes, values, expected_rate=None,
        ),
        Checked(
            "deflection under the force, exact", "1", series,
            "Koiter's theory, double Fourier series", "quarter circumference",
            meshes, values, exact=True,
        ),
    )  # fmt: skip
    return Benchmark(
        "pinched_cylinder", "Pinched cylinder with diaphragms", candidate.name, quantities,
        pictures=(picture,),
    )  # fmt: skip


def rigid_motions(candidate: Candidate) -> Benchmark:
    """Rigid-body modes of a free, doubly curved sheet with non-orthogonal coordinates: six."""
    material = Material(650e6, 0.4, 2150.0, 1.0e6)

    def surface(x, y):
        return np.stack([x + 0.3 * y, y + 2 * x**2, 0.5 * x**2 - 1.5 * x * y + np.sin(4 * y) / 4])

    meshes = (4, 8, 12)
    counts = []
    for elements in meshes:
        patch = Patch(elements, elements, 0.2 / elements, 0.3 / elements, periodic=False)
        sheet = candidate.sheet(patch, fitted_control_points(patch, surface), material, 5e-3)
        counts.append(float(count_rigid_modes(sheet.tangent())))
    quantity = Checked(
        "modes without energy", "1", 6.0, "three translations, three rotations", "side",
        meshes, tuple(counts), expected_rate=None, exact=True, tolerance=0.0,
    )  # fmt: skip
    return Benchmark(
        "rigid_motions", "Rigid motions of a free curved sheet", candidate.name, (quantity,)
    )


def count_rigid_modes(stiffness: sparse.csr_matrix) -> int:
    """Eigenvalues that are zero to working precision; small matrices only."""
    values = np.linalg.eigvalsh(stiffness.toarray())
    return int(np.sum(np.abs(values) < 1e-12 * values[-1]))


def _arc(radius: float) -> Callable:
    """Circular arc around z, starting at the x axis."""

    def surface(around, along):
        angle = around / radius
        return np.stack([radius * np.cos(angle), radius * np.sin(angle), along])

    return surface


def _sequence(candidate, meshes, model, foil) -> tuple[tuple[float, ...], Picture]:
    """Value on every mesh, and the picture of the finest but one."""
    values = []
    for elements in meshes:
        patch, points, held, load, read = model(elements)
        field = solve(candidate.sheet(patch, points, *foil), held, load)
        values.append(float(read(field)))
        if elements == meshes[-2]:
            picture = _picture(patch, points, field, f"{elements} elements")
    return tuple(values), picture


def _picture(patch: Patch, points: np.ndarray, field: np.ndarray, title: str) -> Picture:
    """The deflected surface, the largest displacement drawn as a tenth of its extent."""
    surface, motion = drawn_points(patch, points), drawn_points(patch, field)
    size = np.linalg.norm(motion, axis=0)
    extent = np.ptp(surface.reshape(3, -1), axis=1).max()
    return Picture.of(title, surface + 0.1 * extent / size.max() * motion, size)


def drawn_points(patch: Patch, field: np.ndarray) -> np.ndarray:
    """Values at the knots, those at the seam of a closed patch on both sides."""
    values = knot_points(field, patch.periodic)
    return np.concatenate([values, values[:, :, :1]], axis=2) if patch.periodic else values
