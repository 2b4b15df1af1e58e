"""Our element against the 4-node shell of a library on the same shapes."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

from foilstudy.measure.stiffness import fixed_stiffness
from foilstudy.measure.stiffness.rings import interface_rigid_modes
from foilstudy.model.foil import Imperfection
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.study.published import HEIGHT, RADIUS, foil

pytest.importorskip(
    "KratosMultiphysics.StructuralMechanicsApplication",
    reason="Kratos is a requirement of development, and on Linux only",
)
_SCRIPT = Path(__file__).parents[1] / "benchmarks" / "four_node_shell.py"


@pytest.fixture(scope="module")
def shells():
    spec = importlib.util.spec_from_file_location("four_node_shell", _SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_rigid_motion_costs_their_shell_nothing(shells):
    start = uncrumpled(foil(500), Mesh(18e-3), Imperfection(amplitude=0.0))
    stiffness = shells.theirs(start)
    resistance = np.abs(stiffness @ interface_rigid_modes(HEIGHT)).max()
    assert resistance < 1e-10 * np.abs(stiffness).max()


def test_both_shells_have_the_same_cylinder_at_the_limit(shells):
    """Thick enough that both meshes resolve what its held edges do.

    A ring of ours holds the axial strain at its edge, too: first order, and a matter of cylinders.
    """
    start = uncrumpled(foil(5000), Mesh(12e-3), Imperfection(amplitude=0.0))
    coarse, fine = (fixed_stiffness(shells.ours(each)) for each in (start, start.refined()))
    theirs = fixed_stiffness(shells.theirs(start.refined()))
    assert 2 * fine - coarse == pytest.approx(theirs, rel=0.015)


def test_their_shell_is_too_stiff_on_a_crumple_and_nears_our_limit(shells):
    method = Method.following(foil(500), shells.RAMP_SLOWNESS)
    shape = crumple(foil(500), Mesh(15e-3), Imperfection(seed=0), method)
    limit, over = shape.mesh_limit(2).stiffness, []
    for _ in range(2):
        over.append(fixed_stiffness(shells.theirs(shape)) / limit - 1)
        shape = shape.refined()
    assert np.max(over[0]) > 3 * np.max(over[1]) > 0
    assert np.abs(over[1]).max() < 0.5


def test_distances_count_rotations_by_the_rim(shells):
    stiffness = np.diag(np.tile([1.0, 1.0, 1.0, RADIUS**2, RADIUS**2, RADIUS**2], 2))
    assert shells.apart(1.5 * stiffness, stiffness, RADIUS) == pytest.approx(0.5)
    stiffer = stiffness.copy()
    stiffer[3, 3] *= 2
    assert shells.apart(stiffer, stiffness, RADIUS) == pytest.approx(1 / np.sqrt(12))
