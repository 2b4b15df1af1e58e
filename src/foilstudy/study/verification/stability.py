"""Buckling of a perfect cylinder of foil under axial load, against the exact (m, n) spectrum.

The edges slide in planes normal to the axis that stay plane, and expand freely: the state before
buckling is then uniform, and modes are products of cosines. One cell of a mode is modelled, half a
wave along and half a wave around between planes of symmetry; of all modes that fit into it, with
multiples of both wave numbers, the one of the cell itself is compared.

The order to expect is that of energies (`Candidate.order`), which buckling loads are (Rayleigh
quotients). It is fitted to the differences between meshes: the corner element measures bending by
b_ab J_0/J in place of b_ab, which shifts its limit by the order of the strain at buckling, 0.3 %.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse
from scipy.fft import dctn

from foilstudy.linalg import SolveError
from foilstudy.model.patch import Patch, fitted_control_points, knot_points
from foilstudy.model.supports.edges import (
    Constraints,
    EdgeCondition,
    constraints,
    edge_offset,
    symmetric,
)
from foilstudy.model.supports.interpolation import as_vector
from foilstudy.model.supports.loads import edge_load
from foilstudy.solve.loading.buckling import buckling_modes
from foilstudy.solve.loading.loaded_sheet import LoadedSheet
from foilstudy.study.published import FEP, HEIGHT, RADIUS
from foilstudy.study.verification.candidates import Candidate
from foilstudy.study.verification.records import Benchmark, Checked, Picture
from foilstudy.study.verification.theory_cylinder import (
    Cylinder,
    buckling_strain,
    classical_buckling_stress,
)

FOIL_CYLINDER = Cylinder(RADIUS, HEIGHT, 500e-6, FEP)
_COUNT = 40
"""Lowest modes among which the one of the cell is looked for."""
_SWELLING = 0.06
"""Largest radial displacement of a picture over the radius."""


@dataclass(frozen=True)
class ModeCell:
    """Half a wave of a mode along and around.

    Attributes
    ----------
    m : int
        Half waves along the cylinder.
    n : int
        Waves around; 0 for rings, of which a piece about as wide as high is modelled.
    """

    cylinder: Cylinder
    m: int
    n: int

    @property
    def height(self) -> float:
        """m."""
        return self.cylinder.length / self.m

    @property
    def around(self) -> int:
        """How many cells make half the circumference."""
        return self.n or round(np.pi * self.cylinder.radius / self.height)

    @property
    def width(self) -> float:
        """Along the arc, m."""
        return np.pi * self.cylinder.radius / self.around

    def critical_stress(self) -> float:
        """Over the classical one."""
        strain = buckling_strain(self.cylinder, self.m, self.n)
        modulus = self.cylinder.material.youngs_modulus
        return modulus * strain / classical_buckling_stress(self.cylinder)

    def patch(self, elements: int, coarsest: int) -> Patch:
        """So many elements along, nearly square on the coarsest mesh, halved with it on others."""
        across = max(round(coarsest * self.width / self.height), 3) * elements // coarsest
        return Patch(across, elements, self.width / across, self.height / elements, periodic=False)


CASES = (
    (ModeCell(FOIL_CYLINDER, 2, 9), (16, 32, 64)),
    (ModeCell(FOIL_CYLINDER, 1, 7), (32, 64, 128)),
    (ModeCell(FOIL_CYLINDER, 5, 12), (8, 16, 32)),
    (ModeCell(FOIL_CYLINDER, 14, 0), (8, 16, 32)),
)
"""The three lowest modes and the lowest of rings; elements along half a wave."""


def axial_buckling(candidate: Candidate, cases: tuple = CASES) -> Benchmark:
    """Lowest buckling loads and modes of the foil cylinder, 500 um, and those of rings."""
    quantities, pictures = [], []
    for cell, meshes in cases:
        found = [cell_load(candidate, cell, cell.patch(k, meshes[0])) for k in meshes]
        name = f"m = {cell.m}, n = {cell.n}"
        quantities.append(
            Checked(
                f"axial buckling stress, {name}", "E t/R/sqrt(3(1-nu^2))", cell.critical_stress(),
                "exact mode of Koiter's theory; classical value 1", "axial half wave",
                meshes, tuple(load for load, _ in found), candidate.order(),
            )
        )  # fmt: skip
        pictures.append(_picture(cell, found[-1][1], name))
    return Benchmark(
        "axial_buckling",
        "Buckling of the foil cylinder under axial load, 500 um",
        candidate.name,
        tuple(quantities),
        pictures=tuple(pictures),
    )


def sliding_cell(patch: Patch, points: np.ndarray, angle: float) -> Constraints:
    """A cell from angle zero to `angle` between its planes of symmetry; the top one may move."""
    right = np.array([[-np.sin(angle), np.cos(angle), 0.0], [np.cos(angle), np.sin(angle), 0.0]])
    normal, outwards = np.repeat(right[:, None], patch.rows, axis=1)
    held = constraints(
        patch,
        {
            "bottom": symmetric(2),
            "top": symmetric(2),
            "left": symmetric(1),
            "right": EdgeCondition(held=(normal,), no_slope=(outwards, 2)),
        },
    )
    lift = edge_offset(patch, points, "top", lambda x: x + np.array([0.0, 0.0, 1.0]))
    column = as_vector(lift) / np.linalg.norm(lift)
    return Constraints(patch, sparse.hstack([held.matrix, column[:, None]]).tocsr())


def cell_load(candidate: Candidate, cell: ModeCell, patch: Patch) -> tuple[float, np.ndarray]:
    """Buckling stress of the mode of a cell over the classical one, and its radial displacement.

    Raises
    ------
    SolveError
        If the mode is not among the `_COUNT` lowest that fit into the cell.
    """
    cylinder = cell.cylinder

    def surface(around, height):
        angle = around / cylinder.radius
        return np.stack([cylinder.radius * np.cos(angle), cylinder.radius * np.sin(angle), height])

    points = fitted_control_points(patch, surface)
    sheet = candidate.sheet(patch, points, cylinder.material, cylinder.thickness)
    load = edge_load(patch, points, "top", np.array([0.0, 0.0, -1.0]))
    held = sliding_cell(patch, points, cell.width / cylinder.radius)
    modes = buckling_modes(LoadedSheet(sheet, held, load), _COUNT)
    wanted = (1, 1 if cell.n else 0)
    for factor, shape in zip(modes.factors, modes.shapes):
        radial = radial_displacement(points, shape)
        if half_waves(radial) == wanted:
            critical = classical_buckling_stress(cylinder) * cylinder.thickness
            return float(factor / critical), radial
    raise SolveError(
        f"mode m = {cell.m}, n = {cell.n} is not among the {_COUNT} lowest of its cell on "
        f"{patch.elements_along} elements along"
    )


def radial_displacement(points: np.ndarray, shape: np.ndarray) -> np.ndarray:
    """At the knots, shape (rows, columns)."""
    surface, motion = (knot_points(x, periodic=False) for x in (points, shape))
    return np.sum(surface[:2] * motion[:2], axis=0) / np.linalg.norm(surface[:2], axis=0)


def half_waves(radial: np.ndarray) -> tuple[int, int]:
    """Half waves along and around of the strongest product of cosines in a cell."""
    along, around = np.unravel_index(np.argmax(np.abs(dctn(radial, type=1))), radial.shape)
    return int(along), int(around)


def _picture(cell: ModeCell, radial: np.ndarray, title: str) -> Picture:
    """The radial displacement, mirrored from cell to cell, on the whole cylinder."""
    swelling = radial / np.abs(radial).max()
    for axis, cells in ((0, cell.m), (1, 2 * cell.around)):
        swelling = _mirrored(swelling, axis, cells)
    rows, columns = swelling.shape
    angle, height = np.linspace(0, 2 * np.pi, columns), np.linspace(0, cell.cylinder.length, rows)
    radius = cell.cylinder.radius * (1 + _SWELLING * swelling)
    surface = [radius * np.cos(angle), radius * np.sin(angle), height[:, None] + 0 * radius]
    return Picture.of(title, np.stack(surface), swelling)


def _mirrored(values: np.ndarray, axis: int, cells: int) -> np.ndarray:
    """Continued to so many cells, each the mirror image of the one before."""
    values = np.moveaxis(values, axis, 0)
    image = [values[::-1], values]
    whole = np.concatenate([values, *(image[k % 2][1:] for k in range(cells - 1))])
    return np.moveaxis(whole, 0, axis)
