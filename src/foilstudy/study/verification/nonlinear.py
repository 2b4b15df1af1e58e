"""Shells in large displacement, against K. Y. Sze, X. H. Liu and S. H. Lo, 'Popular benchmark
problems for geometric nonlinear analysis of shells', Finite Elements in Analysis and Design 40
(2004) 1551-1569, doi:10.1016/j.finel.2003.11.001.

The published displacements are those of Abaqus S4R on fine meshes, given to three decimals; the
tables are those of that paper as they are reproduced in the demonstrations of FEniCS-Shell
(pinched cylinder) and Project Chrono (cantilevers, slit annulus) and in public codes for
isogeometric shells (open cylinder). The roll-up is a circle exactly, but for the small
strain of the middle surface. The units are those of the publication, which gives none.
"""

from __future__ import annotations

import numpy as np

from foilstudy.model.materials import Material
from foilstudy.model.patch import Patch, fitted_control_points
from foilstudy.model.supports.edges import clamped, constraints, symmetric
from foilstudy.model.supports.loads import EdgeMoment, edge_load, point_load
from foilstudy.solve.loading.loaded_sheet import LoadedSheet
from foilstudy.study.verification.candidates import Candidate
from foilstudy.study.verification.load_path import NonlinearCase, Probe

SOURCE = "Sze, Liu and Lo 2004"

_CANTILEVER = Material(youngs_modulus=1.2e6, poisson_ratio=0.0, density=1.0, yield_stress=1.0)


def _half_strip(candidate: Candidate, elements: int, length: float):
    """Half of a clamped strip of width 1 and thickness 0.1, cut along its plane of symmetry.

    The other half is left out because a strip that is rolled up by a moment about a fixed axis is
    unstable to tilting out of that plane.
    """
    across = elements // 8
    patch = Patch(across, elements, 0.5 / across, length / elements, periodic=False)
    points = fitted_control_points(patch, lambda y, x: np.stack([x, y, np.zeros_like(x)]))
    held = {"bottom": clamped(patch, points, "bottom"), "left": symmetric(1)}
    return candidate.sheet(patch, points, _CANTILEVER, 0.1), constraints(patch, held)


def _end_shear(candidate: Candidate, elements: int) -> LoadedSheet:
    sheet, held = _half_strip(candidate, elements, 10.0)
    load = edge_load(sheet.patch, sheet.reference, "top", np.array([0, 0, 4.0]))
    return LoadedSheet(sheet, held, load)


def _roll_up(candidate: Candidate, elements: int) -> LoadedSheet:
    sheet, held = _half_strip(candidate, elements, 12.0)
    # a full circle: 2 pi E I / L, half of it on half the width
    moment = 0.5 * 50 * np.pi / 3
    load = EdgeMoment(sheet.patch, sheet.reference, "top", np.array([0, -moment, 0]))
    return LoadedSheet(sheet, held, load)


def _quarter_cylinder(patch: Patch, radius: float):
    """A quarter of a cylinder along y, from the crown (z) to the side (x)."""
    return fitted_control_points(
        patch,
        lambda s, y: np.stack([radius * np.sin(s / radius), y, radius * np.cos(s / radius)]),
    )


def _open_cylinder(candidate: Candidate, elements: int) -> LoadedSheet:
    """An octant: the load sits at the crown in the middle of the length."""
    radius, length = 4.953, 10.35
    patch = Patch(
        elements, elements, radius * np.pi / 2 / elements, length / 2 / elements, periodic=False
    )
    points = _quarter_cylinder(patch, radius)
    held = {"left": symmetric(0), "right": symmetric(2), "bottom": symmetric(1)}
    material = Material(youngs_modulus=10.5e6, poisson_ratio=0.3125, density=1.0, yield_stress=1.0)
    sheet = candidate.sheet(patch, points, material, 0.094)
    load = point_load(patch, points, (0.0, 0.0), np.array([0, 0, 40e3 / 4]))
    return LoadedSheet(sheet, constraints(patch, held), load)


def _pinched_cylinder(candidate: Candidate, elements: int) -> LoadedSheet:
    """A quarter: the published half cylinder on its plane of symmetry, cut once more."""
    radius, length = 101.6, 304.8
    patch = Patch(
        elements, elements, radius * np.pi / 2 / elements, length / elements, periodic=False
    )
    points = _quarter_cylinder(patch, radius)
    held = {
        "left": symmetric(0),
        "right": symmetric(2),
        "top": clamped(patch, points, "top"),
    }
    material = Material(youngs_modulus=2068.5, poisson_ratio=0.3, density=1.0, yield_stress=1.0)
    sheet = candidate.sheet(patch, points, material, 3.0)
    load = point_load(patch, points, (0.0, 0.0), np.array([0, 0, -2000.0 / 2]))
    return LoadedSheet(sheet, constraints(patch, held), load)


def _slit_annulus(candidate: Candidate, elements: int) -> LoadedSheet:
    """Polar coordinates, so that the elements outside are longer than those inside."""
    inner, outer, middle = 6.0, 10.0, 8.0
    across = elements // 8
    patch = Patch(
        across, elements, (outer - inner) / across, 2 * np.pi * middle / elements, periodic=False
    )
    points = fitted_control_points(
        patch,
        lambda r, s: np.stack(
            [
                (inner + r) * np.cos(s / middle),
                (inner + r) * np.sin(s / middle),
                np.zeros_like(r),
            ]
        ),
    )
    material = Material(youngs_modulus=21e6, poisson_ratio=0.0, density=1.0, yield_stress=1.0)
    sheet = candidate.sheet(patch, points, material, 0.03)
    held = constraints(patch, {"bottom": clamped(patch, points, "bottom")})
    load = edge_load(patch, points, "top", np.array([0, 0, 0.8]))
    return LoadedSheet(sheet, held, load)


END_SHEAR = NonlinearCase(
    "cantilever_end_shear",
    "Cantilever under end shear",
    "length",
    (8, 16, 32, 64),
    _end_shear,
    tuple(np.round(0.05 * np.arange(1, 21), 2).tolist()),
    (
        Probe(
            "tip deflection",
            (0.0, 1.0),
            (0, 0, 1),
            (0.663, 1.309, 1.922, 2.493, 3.015, 3.488, 3.912, 4.292, 4.631, 4.933, 5.202, 5.444,
             5.660, 5.855, 6.031, 6.190, 6.335, 6.467, 6.588, 6.698),
            SOURCE,
        ),
        Probe(
            "tip shortening",
            (0.0, 1.0),
            (-1, 0, 0),
            (0.026, 0.103, 0.224, 0.381, 0.563, 0.763, 0.971, 1.184, 1.396, 1.604, 1.807, 2.002,
             2.190, 2.370, 2.541, 2.705, 2.861, 3.010, 3.151, 3.286),
            SOURCE,
        ),
    ),
)  # fmt: skip

_ROLL_FACTORS = tuple((np.arange(1, 17) / 16).tolist())
_TURN = 2 * np.pi * np.array(_ROLL_FACTORS)
_CIRCLE = "arc of a circle; Sze, Liu and Lo 2004"

ROLL_UP = NonlinearCase(
    "cantilever_roll_up",
    "Cantilever rolled up by an end moment",
    "length",
    (16, 32, 64, 128),
    _roll_up,
    _ROLL_FACTORS,
    (
        Probe(
            "tip deflection",
            (0.0, 1.0),
            (0, 0, 1),
            tuple((12 * (1 - np.cos(_TURN)) / _TURN).tolist()),
            _CIRCLE,
            compared=(0.5,),  # at full load it is zero, against which nothing has a share
        ),
        Probe(
            "tip shortening",
            (0.0, 1.0),
            (-1, 0, 0),
            tuple((12 * (1 - np.sin(_TURN) / _TURN)).tolist()),
            _CIRCLE,
        ),
    ),
)

# Theory promises no order under a point load, around which the solution is not smooth. What is
# published comes from elements that are flexible in shear; the part of shear in the displacement
# under the load, P / (2 pi k G t) = 0.02 for every factor e between the size of an element and that
# of the shell, does not exist in Kirchhoff-Love theory and is a likely cause of the 0.6 % by which
# this displacement stays behind at full load with both elements extrapolated; the error of the
# meshes comes on top, 0.8 % with one point and 1.4 % with corners. Meshes finer than the thickness
# lead elsewhere: the load then draws out a spike with strains of order one.
_UNDER_LOAD = 0.02

OPEN_CYLINDER = NonlinearCase(
    "open_cylinder_pull_out",
    "Pull-out of an open cylinder",
    "quarter circumference",
    (16, 32, 64),
    _open_cylinder,
    (0.025, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.525, 0.55, 0.6, 0.8, 1),
    (
        Probe(
            "displacement under the load",
            (0.0, 0.0),
            (0, 0, 1),
            (0.819, 1.260, 1.707, 1.936, 2.079, 2.257, 2.376, 2.473, 2.543, 2.577, 2.618, 2.710,
             2.768),
            SOURCE,
            smooth=False,
            tolerance=_UNDER_LOAD,
        ),
        Probe(
            "narrowing in the middle",
            (1.0, 0.0),
            (-1, 0, 0),
            (0.864, 1.471, 2.217, 2.641, 2.904, 3.227, 3.443, 3.653, 4.061, 4.171, 4.274, 4.455,
             4.551),
            SOURCE,
            smooth=False,
        ),
        Probe(
            "narrowing at the end",
            (1.0, 1.0),
            (-1, 0, 0),
            (0.872, 1.493, 2.293, 2.792, 3.106, 3.452, 3.632, 3.718, 3.580, 3.518, 3.452, 3.332,
             3.269),
            SOURCE,
            smooth=False,
            monotone=False,  # from 0.2 % away: at full load to 0.1 % the same on all meshes
        ),
    ),
)  # fmt: skip

PINCHED_CYLINDER = NonlinearCase(
    "pinched_clamped_cylinder",
    "Clamped cylinder pinched at its free end",
    "quarter circumference",
    (16, 32, 64),
    _pinched_cylinder,
    (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.5, 0.6, 0.8, 1),
    (
        Probe(
            "displacement under the load",
            (0.0, 0.0),
            (0, 0, -1),
            (5.421, 16.100, 27.657, 37.582, 48.537, 66.410, 94.669, 113.704, 132.653, 144.185,
             160.015, 171.505),
            SOURCE,
            smooth=False,
            monotone=False,  # from 0.3 % away; at full load to 0.004 % the same on two meshes
        ),
    ),
)  # fmt: skip

SLIT_ANNULUS = NonlinearCase(
    "slit_annular_plate",
    "Slit annular plate lifted at one side of the slit",
    "circumference",
    (32, 64, 128, 256),
    _slit_annulus,
    (0.025, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0),
    (
        Probe(
            "rise of the outer corner",
            (1.0, 1.0),
            (0, 0, 1),
            (1.789, 5.876, 9.160, 11.213, 12.661, 13.768, 14.674, 15.469, 16.202, 16.886, 17.528),
            SOURCE,
            free_edge=True,
        ),
        Probe(
            "rise of the inner corner",
            (0.0, 1.0),
            (0, 0, 1),
            (1.305, 4.277, 6.725, 8.340, 9.529, 10.468, 11.257, 11.970, 12.642, 13.282, 13.891),
            SOURCE,
            free_edge=True,
        ),
    ),
)
