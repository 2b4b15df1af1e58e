"""Small scenes shared by the physics tests; lengths in m."""

from __future__ import annotations

import os

# As in a job of a study, and before any library reads them: the order of sums, and with it the last
# bits, depends on the number of threads.
for variable in ("OMP", "MKL", "OPENBLAS", "NUMBA"):
    os.environ[f"{variable}_NUM_THREADS"] = "1"

from dataclasses import dataclass  # noqa: E402

import numpy as np  # noqa: E402
import pytest  # noqa: E402

from foilstudy.measure.stiffness import InterfaceSystem, Rings, condense  # noqa: E402
from foilstudy.model.foil import Foil, Imperfection  # noqa: E402
from foilstudy.model.imperfections.cylinder import imperfect_cylinder  # noqa: E402
from foilstudy.model.materials import Material  # noqa: E402
from foilstudy.model.patch import Patch, cylinder_control_points  # noqa: E402
from foilstudy.model.shell.shell import Shell  # noqa: E402
from foilstudy.model.shell.tangent import mass_matrix  # noqa: E402
from foilstudy.solve.problem import Problem  # noqa: E402
from foilstudy.solve.relaxation import (  # noqa: E402
    Ramp,
    RelaxationResult,
    Scheme,
    StoppingRule,
    relax,
)
from foilstudy.solve.relaxation.mass.spectral import SpectralMassScaling  # noqa: E402

DIAMETER, REFERENCE_HEIGHT, GAP_HEIGHT = 0.2, 0.17, 0.13
THICKNESS = 500e-6
FEP = Material(youngs_modulus=650e6, poisson_ratio=0.4, density=2150.0, yield_stress=12e6)
FOIL = Foil(DIAMETER, REFERENCE_HEIGHT, GAP_HEIGHT, THICKNESS, FEP)


def cylinder(
    element_size,
    *,
    material=FEP,
    thickness=THICKNESS,
    height=REFERENCE_HEIGHT,
    element=None,
):
    """Perfect cylinder as a sheet."""
    patch = Patch.for_cylinder(DIAMETER, height, element_size)
    points = cylinder_control_points(patch, DIAMETER)
    return Shell.elastic(patch, points, material, thickness, element)


def imperfect_sheet(element_size, *, material=FEP, thickness=THICKNESS, seed=0):
    """Cylinder with a Gaussian imperfection of 10 um."""
    foil = Foil(DIAMETER, REFERENCE_HEIGHT, GAP_HEIGHT, thickness, material)
    patch = Patch.for_cylinder(DIAMETER, REFERENCE_HEIGHT, element_size)
    imperfection = Imperfection(seed=seed)
    points = imperfect_cylinder(patch, foil, imperfection)
    return Shell.elastic(patch, points, material, thickness)


def relaxed(sheet, shortening, *, ramp_steps, steps_max, tolerance=1e-8, safety=1.5):
    """Relaxation with the damping of a study."""
    problem = Problem(sheet)
    motion = Scheme(SpectralMassScaling(safety)).start(problem)
    rule = StoppingRule(tolerance, steps_max)
    return relax(problem, motion, Ramp(shortening, ramp_steps), rule)


def rotation(axis, angle):
    """Rotation matrix about an axis (Rodrigues)."""
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


@dataclass(frozen=True)
class Crumple:
    """A crumpled equilibrium and the sheet that is stress-free in its shape."""

    sheet: Shell
    result: RelaxationResult
    stress_free: Shell
    stiffness: InterfaceSystem
    mass: InterfaceSystem

    @property
    def points(self):
        return self.result.points


@pytest.fixture(scope="session")
def coarse_crumple() -> Crumple:
    """500 um, 170 mm, 10 mm elements: a converged crumple that takes a second."""
    sheet = imperfect_sheet(10e-3)
    result = relaxed(sheet, REFERENCE_HEIGHT - GAP_HEIGHT, ramp_steps=1000, steps_max=20000)
    assert result.status == "converged", result.message
    patch, points = sheet.patch, result.points
    stress_free = Shell.elastic(patch, points, FEP, THICKNESS)
    rings = Rings.of(patch, points)
    mass = mass_matrix(patch, FEP.density * THICKNESS * sheet.section.areas)
    return Crumple(
        sheet,
        result,
        stress_free,
        InterfaceSystem.split(stress_free.tangent(), rings),
        InterfaceSystem.split(mass, rings),
    )


@pytest.fixture(scope="session")
def coarse_static(coarse_crumple):
    """Static condensation of the stress-free coarse crumple."""
    return condense(coarse_crumple.stiffness)
