"""Interface stiffness of the sheet between its rigid rings."""

import numpy as np
import pytest
from conftest import DIAMETER, FEP, THICKNESS, cylinder

from foilstudy.measure.stiffness import (
    DOF_NAMES,
    InterfaceSystem,
    Rings,
    condense,
    fixed_stiffness,
    free_stiffness,
    transfer_stiffness,
)
from foilstudy.measure.stiffness.rings import interface_rigid_modes, rigid_motion
from foilstudy.measure.stiffness.transfer import _pulls
from foilstudy.model.materials import Material
from foilstudy.model.patch import refine
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.model.shell.elements.one_point import OnePoint
from foilstudy.model.shell.held import held_blocks
from foilstudy.model.shell.shell import Shell

RADIUS = DIAMETER / 2
LENGTHS = np.diag(np.tile([1.0, 1.0, 1.0, 1 / RADIUS, 1 / RADIUS, 1 / RADIUS], 2))
"""Makes rotations comparable with translations: as motions of the ring's edge."""


def condensed(sheet):
    rings = Rings.of(sheet.patch, sheet.reference)
    return condense(InterfaceSystem.split(sheet.tangent(), rings)).stiffness


def ring_distance(points):
    return points[2, -2:].mean() - points[2, :2].mean()


def test_stiffness_matrix_does_not_resist_rigid_motion(coarse_crumple):
    sheet = coarse_crumple.stress_free
    matrix = sheet.tangent()
    arms = np.moveaxis(sheet.reference, 0, -1).reshape(-1, 3) / RADIUS
    force = matrix @ rigid_motion(arms)
    # rounding of the sums over a row
    assert np.abs(force).max() < 1e-14 * abs(matrix).sum(axis=1).max()


def test_constraint_modes_are_in_equilibrium(coarse_crumple, coarse_static):
    system = coarse_crumple.stiffness
    residual = system.interior @ coarse_static.constraint_modes + system.coupling
    assert np.linalg.norm(residual) < 1e-11 * np.linalg.norm(system.coupling)


def test_condensation_equals_the_dense_schur_complement():
    sheet = cylinder(25e-3)
    rings = Rings.of(sheet.patch, sheet.reference)
    matrix = sheet.tangent().toarray()
    moved = np.zeros((matrix.shape[0], 12))
    moved[rings.boundary] = rings.motion
    free = np.ix_(rings.interior, rings.interior)
    moved[rings.interior] = -np.linalg.solve(matrix[free], matrix[rings.interior] @ moved)
    expected = moved.T @ matrix @ moved
    np.testing.assert_allclose(
        condensed(sheet), expected, rtol=0, atol=1e-11 * np.abs(expected).max()
    )


def test_interface_stiffness_has_exactly_six_rigid_motions(coarse_crumple, coarse_static):
    stiffness = LENGTHS @ coarse_static.stiffness @ LENGTHS
    assert np.array_equal(stiffness, stiffness.T)
    values = np.linalg.eigvalsh(stiffness)
    # rounding scales with the membrane stiffness of the wall, far above that of the crumple
    rounding = 1e-12 * abs(coarse_crumple.stiffness.interior).max()
    assert np.abs(values[:6]).max() < rounding
    assert values[6] > 1e-3 * values[-1] > 1e3 * rounding
    rigid = np.linalg.inv(LENGTHS) @ interface_rigid_modes(ring_distance(coarse_crumple.points))
    assert np.abs(stiffness @ rigid).max() < rounding
    assert np.linalg.matrix_rank(rigid) == 6


def test_rigid_motion_of_a_point():
    """u = translation + rotation x arm, column by column."""
    arm = np.array([0.3, -0.5, 0.7])
    motion = rigid_motion(arm[None])
    np.testing.assert_array_equal(motion[:, :3], np.eye(3))
    for axis in range(3):
        np.testing.assert_array_equal(motion[:, 3 + axis], np.cross(np.eye(3)[axis], arm))


def test_interface_motions_are_named_in_order():
    assert DOF_NAMES[2] == "bottom_uz" and DOF_NAMES[6] == "top_ux" and DOF_NAMES[11] == "top_rz"


def test_stiffness_is_proportional_to_youngs_modulus(coarse_crumple, coarse_static):
    stiff = Material(4 * FEP.youngs_modulus, FEP.poisson_ratio, FEP.density, FEP.yield_stress)
    sheet = Shell.elastic(coarse_crumple.sheet.patch, coarse_crumple.points, stiff, THICKNESS)
    # to the last bit for a power of two
    assert np.array_equal(condensed(sheet), 4 * coarse_static.stiffness)


def test_stiffness_scales_with_size():
    """Ten times everything: ten times the translational stiffness."""
    small = cylinder(20e-3)
    patch = small.patch
    large = Shell.elastic(
        type(patch)(patch.elements_around, patch.elements_along, 10 * patch.size_around,
                    10 * patch.size_along),
        10 * small.reference, FEP, 10 * THICKNESS,
    )  # fmt: skip
    scale = np.diag(np.tile([1.0, 1, 1, 10, 10, 10], 2))
    first, second = condensed(small), condensed(large)
    expected = 10 * scale @ first @ scale
    weight = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
    np.testing.assert_allclose(second / weight, expected / weight, rtol=0, atol=1e-11)


def test_prestress_free_tangent_gives_the_stress_free_stiffness(coarse_crumple, coarse_static):
    sheet = coarse_crumple.stress_free
    tangent = sheet.tangent(sheet.reference)
    rings = Rings.of(sheet.patch, sheet.reference)
    stiffness = condense(InterfaceSystem.split(tangent, rings)).stiffness
    scale = np.abs(coarse_static.stiffness).max()
    np.testing.assert_allclose(stiffness, coarse_static.stiffness, rtol=0, atol=1e-10 * scale)


@pytest.mark.parametrize("height", [0.17, 0.03])
def test_three_loads_give_the_stiffness_of_all_twelve(height):
    """Also where one ring is within the reach of the other."""
    sheet = cylinder(height / 3 if height < 0.1 else 20e-3, height=height)
    expected = fixed_stiffness(condensed(sheet))
    np.testing.assert_allclose(transfer_stiffness(sheet), expected, rtol=1e-9)


def test_moving_both_rings_and_all_between_costs_nothing(coarse_crumple):
    """The blocks of a row, those of the rings summed, leave no force under a translation."""
    sheet = coarse_crumple.stress_free
    blocks = sheet.tangent_blocks()
    held = held_blocks(sheet.patch, blocks)
    pulls = sum(_pulls(blocks, ring) for ring in (slice(0, 2), slice(-2, None)))[2:-2]
    for axis in range(3):
        moved = np.tile(np.eye(3)[axis], held.shape[0] // 3)
        force = held @ moved + pulls[..., axis].ravel()
        assert np.abs(force).max() < 1e-12 * (abs(held) @ moved).max()


def test_transfer_stiffness_of_a_crumple(coarse_crumple, coarse_static):
    expected = fixed_stiffness(coarse_static.stiffness)
    np.testing.assert_allclose(transfer_stiffness(coarse_crumple.stress_free), expected, rtol=1e-9)


def test_fixed_and_free_stiffness_of_a_known_matrix():
    """One spring per direction at an offset that couples it to a rotation."""
    spring = np.diag([3.0, 5.0, 7.0, 11.0, 13.0, 17.0])
    spring[2, 4] = spring[4, 2] = 2.0
    rigid = interface_rigid_modes(0.5)
    to_top = np.hstack([-rigid[6:] @ np.linalg.inv(rigid[:6]), np.eye(6)])
    stiffness = to_top.T @ spring @ to_top
    np.testing.assert_allclose(fixed_stiffness(stiffness), [7.0, 4.0], rtol=1e-14)
    axial = 7.0 - 2.0**2 / 13.0
    radial = 2 / (1 / 3.0 + 1 / 5.0)
    np.testing.assert_allclose(free_stiffness(stiffness), [axial, radial], rtol=1e-14)


def test_released_motions_cannot_stiffen(coarse_static):
    fixed, free = fixed_stiffness(coarse_static.stiffness), free_stiffness(coarse_static.stiffness)
    assert (0 < free).all() and (free <= fixed).all()


def test_directions_are_those_of_the_interface(coarse_static):
    """The rigid-body relation between the rings makes transfer and driving stiffness equal."""
    driving = np.diag(coarse_static.stiffness)[6:]
    fixed = fixed_stiffness(coarse_static.stiffness)
    np.testing.assert_allclose(fixed, [driving[2], driving[:2].mean()], rtol=1e-8)


@pytest.fixture(scope="module")
def published_cylinder():
    """Uncrumpled cylinder of 500 um and 0.17 m at 5 mm."""
    return condensed(cylinder(5e-3, element=OnePoint()))


def test_cylinder_agrees_with_independent_codes(published_cylinder):
    """1.214 MN/m and 198 kN/m: three independent codes agree on them within 0.6 % (design, 4)."""
    axial, radial = fixed_stiffness(published_cylinder)
    assert axial == pytest.approx(1.214e6, rel=0.01)
    assert radial == pytest.approx(198e3, rel=0.01)


def test_cylinder_lies_between_the_bounds_of_membrane_theory(published_cylinder):
    """E A / L with free, and over 1 - nu^2 with suppressed lateral contraction."""
    axial, radial = fixed_stiffness(published_cylinder)
    area = np.pi * DIAMETER * THICKNESS
    bar = FEP.youngs_modulus * area / 0.17
    assert bar < axial < bar / (1 - FEP.poisson_ratio**2)
    # the wall's membrane shear flow alone, cos^2 theta around, without bending of the tube
    shear = FEP.youngs_modulus / (2 * (1 + FEP.poisson_ratio)) * area / 2 / 0.17
    assert radial < shear


def test_cylinder_is_symmetric_about_its_axis(published_cylinder):
    stiffness = LENGTHS @ published_cylinder @ LENGTHS
    scale = stiffness.max()
    np.testing.assert_allclose(stiffness[0, 0], stiffness[1, 1], rtol=1e-9)
    np.testing.assert_allclose(stiffness[3, 3], stiffness[4, 4], rtol=1e-9)
    for i, j in ((0, 1), (0, 2), (2, 4), (2, 5), (0, 5), (3, 4), (0, 3)):
        assert abs(stiffness[i, j]) < 1e-9 * scale


@pytest.mark.parametrize("element", [OnePoint(), Corner()], ids=lambda element: element.name)
def test_cylinder_stiffness_converges_at_first_order(element):
    """A ring owns value and slope of its edge, so the edge cannot stretch axially either.

    Kirchhoff-Love theory clamps the rotation only; holding the axial strain of the edge as well
    stiffens a strip whose width is that of the elements.
    """
    sheet = cylinder(20e-3, thickness=5e-3, element=element)
    patch, points, values = sheet.patch, sheet.reference, []
    for _ in range(4):
        values.append(fixed_stiffness(condensed(Shell.elastic(patch, points, FEP, 5e-3, element))))
        patch, points = patch.refined(), refine(points)
    steps = -np.diff(values, axis=0)
    assert (steps > 0).all()  # from above
    np.testing.assert_allclose(np.log2(steps[:-1] / steps[1:]), 1.0, atol=0.3)
