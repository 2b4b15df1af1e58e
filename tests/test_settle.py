"""From a relaxing sheet to a stable equilibrium between its rings."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import (
    DIAMETER,
    FEP,
    FOIL,
    GAP_HEIGHT,
    REFERENCE_HEIGHT,
    THICKNESS,
    cylinder,
    imperfect_sheet,
    relaxed,
)

from foilstudy.linalg import factorise
from foilstudy.model.patch import RING_ROWS, Patch, cylinder_control_points
from foilstudy.model.shell.shell import Shell
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.shape import Shape
from foilstudy.solve.equilibrium.settle import HeldSheet, SettleOptions, settle, stopped_at
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import Ramp, Scheme, StoppingRule, relax
from foilstudy.solve.relaxation.damping.adaptive_viscous import AdaptiveViscousDamping

FREE = slice(RING_ROWS, -RING_ROWS)


def started(problem):
    """Damped more than in a study."""
    scheme = Scheme(relaxation_damping=AdaptiveViscousDamping(0.25))
    return scheme.start(problem)


def settled_from(sheet, points, options=None):
    problem = Problem(sheet)
    return settle(problem, started(problem), points, options)


def relative_residual(sheet, points):
    force = np.empty_like(points)
    sheet.force(points, force)
    free = np.linalg.norm(force[:, FREE])
    return free / np.sqrt(np.linalg.norm(force) ** 2 - free**2)


def negative_eigenvalues(sheet, points):
    owned = 3 * RING_ROWS * sheet.patch.columns
    return factorise(sheet.tangent(points)[owned:-owned, owned:-owned].tocsr()).negative_eigenvalues


@pytest.fixture(scope="module")
def after_ramp():
    """The coarse crumple of conftest when its ring has come to rest."""
    sheet = imperfect_sheet(10e-3)
    result = relaxed(sheet, REFERENCE_HEIGHT - GAP_HEIGHT, ramp_steps=1000, steps_max=0)
    return sheet, result.points


@pytest.fixture(scope="module")
def settled(after_ramp):
    sheet, points = after_ramp
    return settled_from(sheet, points)


def test_settled_crumple_is_a_stable_equilibrium(after_ramp, settled):
    sheet, start = after_ramp
    assert settled.status == "converged", settled.message
    assert relative_residual(sheet, settled.points) <= 1e-8
    assert settled.residual == pytest.approx(relative_residual(sheet, settled.points), rel=1e-6)
    assert settled.negative_eigenvalues == negative_eigenvalues(sheet, settled.points) == 0
    assert sheet.energies(settled.points).total < sheet.energies(start).total


def test_rings_do_not_move_in_any_bit(after_ramp, settled):
    _, start = after_ramp
    for rows in (slice(0, RING_ROWS), slice(-RING_ROWS, None)):
        assert np.array_equal(settled.points[:, rows], start[:, rows])


def test_settling_ends_in_the_basin_of_the_relaxation(coarse_crumple):
    """Where the relaxation of the study gives way, and where it would have gone by itself."""
    sheet = imperfect_sheet(10e-3)
    problem = Problem(sheet)
    motion = Scheme().start(problem)
    rule = StoppingRule(SettleOptions().switch_residual, 20_000)
    near = relax(problem, motion, Ramp(REFERENCE_HEIGHT - GAP_HEIGHT, 1000), rule)
    ended = settle(problem, motion, near.points)
    assert np.abs(ended.points - coarse_crumple.points).max() < 1e-6
    assert (ended.relaxation_steps, ended.hessians) == (0, 1)
    assert near.steps < coarse_crumple.result.steps - 500


def test_settled_again_it_stays_where_it_is(after_ramp, settled):
    sheet, _ = after_ramp
    again = settled_from(sheet, settled.points)
    assert (again.status, again.relaxation_steps, again.hessians) == ("converged", 0, 0)
    assert np.array_equal(again.points, settled.points)


def test_the_same_bits_every_time(after_ramp, settled):
    sheet, points = after_ramp
    assert np.array_equal(settled_from(sheet, points).points, settled.points)


def mirrored(points):
    """Reflection theta -> -theta: column i goes to -i."""
    return np.roll(points[:, :, ::-1], 1, axis=2) * np.array([1, -1, 1])[:, None, None]


def test_mirrored_sheet_settles_into_the_mirrored_crumple():
    """Through snaps: the factorisation, whose order is not symmetric, must not choose the basin."""
    patch = Patch(32, 9, np.pi * DIAMETER / 32, REFERENCE_HEIGHT / 9)
    perfect = cylinder_control_points(patch, DIAMETER)
    deviation = np.zeros(patch.shape)
    deviation[:, FREE] = 1e-4 * np.random.default_rng(0).standard_normal(deviation[:, FREE].shape)
    shapes = []
    for reference in (perfect + deviation, mirrored(perfect + deviation)):
        sheet = Shell.elastic(patch, reference, FEP, THICKNESS)
        start = relaxed(sheet, 10e-3, ramp_steps=300, steps_max=0).points
        result = settled_from(sheet, start)
        assert result.status == "converged", result.message
        shapes.append(result.points)
    moved = np.abs(np.hypot(*shapes[0][:2]) - np.hypot(*perfect[:2])).max()
    assert moved > 5e-3  # ten times the thickness: it has buckled
    np.testing.assert_allclose(shapes[1], mirrored(shapes[0]), rtol=0, atol=1e-5 * moved)


def test_axisymmetric_state_of_a_buckled_cylinder_is_left():
    """Beyond the classical load the axisymmetric state is an equilibrium, but a saddle."""
    sheet = cylinder(20e-3)
    # damped more than in a study, lest rounding errors grow along the buckling modes
    problem = Problem(sheet)
    ring = relax(problem, started(problem), Ramp(2e-3, 200), StoppingRule(1e-8, 2000))
    radius = np.hypot(*ring.points[:2])
    assert np.ptp(radius, axis=1).max() < 1e-9
    assert negative_eigenvalues(sheet, ring.points) > 0
    result = settled_from(sheet, ring.points)
    assert (result.status, result.negative_eigenvalues) == ("converged", 0)
    assert np.ptp(np.hypot(*result.points[:2]), axis=1).max() > THICKNESS
    assert sheet.energies(result.points).total < sheet.energies(ring.points).total


def test_held_sheet_differentiates_its_energy():
    sheet = imperfect_sheet(30e-3)
    rng = np.random.default_rng(3)
    start = sheet.reference.copy()
    start[:, FREE] += 2e-3 * rng.standard_normal(start[:, FREE].shape)
    held = HeldSheet(Problem(sheet), start)
    q = held.unknowns(start)
    assert np.array_equal(held.points(q), start)
    direction = rng.standard_normal(q.size) / np.sqrt(q.size)
    step = 1e-6
    ahead, behind = (held.value_and_gradient(q + s * direction) for s in (step, -step))
    _, gradient = held.value_and_gradient(q)
    assert (ahead[0] - behind[0]) / (2 * step) == pytest.approx(gradient @ direction, rel=1e-6)
    difference = (ahead[1] - behind[1]) / (2 * step)
    np.testing.assert_allclose(
        held.hessian(q) @ direction, difference, rtol=0, atol=1e-6 * np.abs(difference).max()
    )


def test_shapes_at_falling_residuals_come_closer_to_the_equilibrium(after_ramp, settled):
    sheet, points = after_ramp
    wanted = (1e-2, 1e-4, 1e-6)
    problem = Problem(sheet)
    stops = list(stopped_at(problem, started(problem), points, wanted))
    assert tuple(residual for residual, _ in stops) == wanted
    assert all(relative_residual(sheet, shape) <= residual for residual, shape in stops)
    distance = [np.abs(shape - settled.points).max() for _, shape in stops]
    assert distance[0] > distance[1] > distance[2]


def test_residual_that_is_not_reached_ends_the_series(after_ramp):
    sheet, points = after_ramp
    problem = Problem(sheet)
    assert not list(stopped_at(problem, started(problem), points, [1e-9], 20))


def test_what_the_minimisation_does_not_end_is_relaxed_further(after_ramp):
    sheet, points = after_ramp
    assert relative_residual(sheet, points) < 1
    options = SettleOptions(switch_residual=1.0, hessians_per_round=1)
    result = settled_from(sheet, points, options)
    assert (result.status, result.negative_eigenvalues) == ("converged", 0)
    assert result.relaxation_steps > 0


def test_without_steps_left_the_tangent_takes_over(after_ramp):
    sheet, points = after_ramp
    result = settled_from(sheet, points, SettleOptions(relaxation_steps_max=20))
    assert (result.status, result.relaxation_steps) == ("converged", 20), result.message
    assert relative_residual(sheet, result.points) <= 1e-8
    assert negative_eigenvalues(sheet, result.points) == 0
    assert result.hessians > SettleOptions().hessians_per_round


def test_too_little_work_is_no_success(after_ramp):
    sheet, points = after_ramp
    options = SettleOptions(relaxation_steps_max=20, hessians_last=1)
    result = settled_from(sheet, points, options)
    assert (result.status, result.relaxation_steps) == ("not_converged", 20)
    assert result.residual > 1e-8
    assert "wanted 1.0e-08" in result.message


def test_minimisation_that_ends_early_is_no_success(after_ramp):
    sheet, points = after_ramp
    options = SettleOptions(residual_tolerance=1e-16, hessians_per_round=1, rounds_max=2)
    result = settled_from(sheet, points, options)
    assert result.status == "not_converged"
    assert result.hessians <= 2
    assert "wanted 1.0e-16" in result.message


def test_a_symmetric_start_leaves_its_saddle_by_relaxation():
    """Six even waves stay even down to the gap, where up to eleven eigenvalues are negative.

    Quasi-Newton steps crawl from there: 123 on this mesh, each as dear as forty of relaxation.
    """
    height, gap = 0.135, 0.13
    foil = replace(FOIL, reference_height=height, gap_height=gap)
    mesh = Mesh(10e-3)
    patch = mesh.patch(foil)
    points = cylinder_control_points(patch, DIAMETER)
    angle = np.arctan2(points[1], points[0])
    wave = 0.2e-3 * np.cos(6 * angle) * np.sin(np.pi * points[2] / height)
    wave[[0, 1, -2, -1]] = 0.0
    points += np.stack([wave * np.cos(angle), wave * np.sin(angle), 0 * wave])
    start = Shape(foil, patch, points, points, mesh.element_at_work())
    arrival = Method().path.follow(start.problem(), foil.shortening)
    assert arrival.status == "converged", arrival.message
    assert arrival.residual <= 1e-8 and arrival.negative_eigenvalues == 0
    assert arrival.newton_steps < 40
    assert arrival.steps < 3 * Method().path.ramp_steps
