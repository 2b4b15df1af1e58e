"""Dynamic relaxation: mass, stability, ramp, verdicts and the equilibria it finds."""

import numpy as np
import pytest
from conftest import (
    DIAMETER,
    FEP,
    GAP_HEIGHT,
    REFERENCE_HEIGHT,
    THICKNESS,
    cylinder,
    imperfect_sheet,
    relaxed,
)

from foilstudy.linalg import factorise
from foilstudy.measure.stiffness import InterfaceSystem, Rings, condense
from foilstudy.model.materials import Material
from foilstudy.model.patch import RING_ROWS, Patch, cylinder_control_points
from foilstudy.model.shell.shell import Shell
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import Ramp, Scheme, StoppingRule, relax
from foilstudy.solve.relaxation.damping.adaptive_viscous import AdaptiveViscousDamping
from foilstudy.solve.relaxation.mass.spectral import SpectralMassScaling
from foilstudy.solve.residual import relative_residual as solve_residual

FREE = slice(RING_ROWS, -RING_ROWS)
SAFETY = 1.5


def force_of(sheet, points):
    out = np.empty_like(points)
    sheet.force(points, out)
    return out


def reaction(sheet, points):
    """Axial force of the sheet on the top ring, positive when it pushes up."""
    return -force_of(sheet, points)[2, -RING_ROWS:].sum()


def relative_residual(sheet, points):
    force = force_of(sheet, points)
    free = np.linalg.norm(force[:, FREE])
    return free / np.sqrt(np.linalg.norm(force) ** 2 - free**2)


# --- mass ----------------------------------------------------------------------------------------


def dense_mass(sheet, safety):
    """(s/4) (C L + D L^2) h1 h2, the Laplacian assembled densely with Dirichlet rows."""
    patch = sheet.patch
    rows, columns = patch.rows - 2 * RING_ROWS, patch.columns
    around = 2 * np.eye(columns) - np.roll(np.eye(columns), 1, 0) - np.roll(np.eye(columns), -1, 0)
    along = 2 * np.eye(rows) - np.eye(rows, k=1) - np.eye(rows, k=-1)
    laplacian = np.kron(along / patch.size_along**2, np.eye(columns))
    laplacian += np.kron(np.eye(rows), around / patch.size_around**2)
    material, t = sheet.material, sheet.thickness
    membrane = material.youngs_modulus * t / (1 - material.poisson_ratio**2)
    stiffness = membrane * (laplacian + t**2 / 12 * laplacian @ laplacian)
    return 0.25 * safety * patch.size_around * patch.size_along * stiffness


@pytest.mark.parametrize("columns, along", [(8, 5), (9, 5), (12, 11), (7, 4)])
@pytest.mark.parametrize("thickness", [1e-4, 2e-2])
@pytest.mark.parametrize("single", [False, True])
def test_spectral_solution_equals_the_dense_one(columns, along, thickness, single):
    patch = Patch(columns, along, np.pi * DIAMETER / columns, 0.03)
    sheet = Shell.elastic(patch, cylinder_control_points(patch, DIAMETER), FEP, thickness)
    momentum = np.random.default_rng(0).standard_normal((3, patch.rows - 4, columns))
    dense = dense_mass(sheet, SAFETY)
    expected = np.linalg.solve(dense, momentum.reshape(3, -1).T).T.reshape(momentum.shape)
    velocity = SpectralMassScaling(SAFETY, single).start(Problem(sheet)).velocity(momentum)
    tolerance = 10 * np.finfo(velocity.dtype).eps * np.linalg.cond(dense) * np.abs(expected).max()
    np.testing.assert_allclose(velocity, expected, rtol=0, atol=tolerance)


def largest_frequency_squared(sheet, safety, iterations=300):
    """Largest eigenvalue of M^-1 K by power iteration, from below."""
    rows, columns = sheet.patch.rows, sheet.patch.columns
    stiffness = sheet.tangent()
    mass = SpectralMassScaling(safety).start(Problem(sheet))
    motion = np.zeros((3, rows, columns))
    motion[:, FREE] = np.random.default_rng(0).standard_normal(motion[:, FREE].shape)
    for _ in range(iterations):
        motion /= np.linalg.norm(motion)
        force = stiffness @ np.moveaxis(motion, 0, -1).ravel()
        force = np.moveaxis(force.reshape(rows, columns, 3), -1, 0)[:, FREE]
        motion[:, FREE] = mass.velocity(np.ascontiguousarray(force))
    return np.linalg.norm(motion)


@pytest.mark.parametrize("height", [0.135, 0.25, 0.6])
@pytest.mark.parametrize("thickness", [50e-6, 5e-3])
@pytest.mark.parametrize("size", [20e-3, 10e-3])
def test_mass_bounds_the_stiffness_of_the_cylinder(thickness, size, height):
    """A step of 1 is stable for omega^2 < 4; the factor s leaves 4/s, on every mesh.

    Hoop stretch, which the Laplacian does not know, couples to an axial wave k >= pi/h by
    [[1, nu x], [nu x, x^2]] with x = 1/(R k), whose eigenvalues are below max(1, x^2) + nu x.
    """
    sheet = cylinder(size, thickness=thickness, height=height)
    x = height / (np.pi * DIAMETER / 2)
    hoop = max(1.0, x**2) + FEP.poisson_ratio * x
    assert largest_frequency_squared(sheet, SAFETY) <= min(4 / SAFETY * hoop, 4.0)


# --- loading -------------------------------------------------------------------------------------


def test_ramp_starts_and_ends_at_rest():
    ramp = Ramp(0.04, 1000)
    path = np.array([ramp.shortening_at(step) for step in range(1005)])
    assert path[0] == 0.0
    assert (path[1000:] == 0.04).all()
    np.testing.assert_allclose(path[:1001] + path[1000::-1], 0.04, atol=1e-16)  # antisymmetric
    assert (np.diff(path[:1001]) > 0).all()
    # 10 tau^3: velocity and acceleration vanish with the step
    assert path[1] == pytest.approx(0.04 * 10e-9, rel=2e-3)
    slope = np.diff(path[:1001]) * 1000
    assert slope.max() == pytest.approx(0.04 * 15 / 8, rel=1e-5)


def test_ring_moves_by_the_shortening_and_stays_rigid(coarse_crumple):
    moved = coarse_crumple.points - coarse_crumple.sheet.reference
    assert not moved[:, :RING_ROWS].any()
    assert not moved[:2, -RING_ROWS:].any()
    shortening = REFERENCE_HEIGHT - GAP_HEIGHT
    np.testing.assert_allclose(moved[2, -RING_ROWS:], -shortening, rtol=1e-12)
    history = coarse_crumple.result.history
    assert history.height[0] == pytest.approx(REFERENCE_HEIGHT, rel=1e-12)
    assert history.height[-1] == pytest.approx(GAP_HEIGHT, rel=1e-12)


def test_damping_is_critical_for_the_current_motion():
    # one oscillator, omega = 0.3: v (f - f_old) = omega^2 m v^2 for a step of 1
    damping = AdaptiveViscousDamping().start()
    assert damping.coefficient(0.0, 0.0) == 0.0
    assert damping.coefficient(0.09 * 2.0, 2.0) == pytest.approx(2 * 0.3, rel=1e-14)
    assert damping.coefficient(-0.09 * 2.0, 2.0) == pytest.approx(2 * 0.3, rel=1e-14)
    assert AdaptiveViscousDamping(0.25).start().coefficient(0.18, 2.0) == pytest.approx(
        0.15, rel=1e-14
    )
    # a larger one would reverse the motion
    assert AdaptiveViscousDamping().start().coefficient(100.0, 1.0) < 2.0


def test_damping_follows_a_change_over_its_memory():
    damping = AdaptiveViscousDamping(memory=50).start()
    for _ in range(1000):
        damping.coefficient(1.0, 1.0)
    for _ in range(50):
        coefficient = damping.coefficient(0.0, 1.0)
    assert coefficient == pytest.approx(2 * 0.98**25, rel=1e-9)


# --- verdicts ------------------------------------------------------------------------------------


def test_converged_means_a_small_residual_and_a_stable_equilibrium(coarse_crumple):
    result = coarse_crumple.result
    assert result.status == "converged"
    residual = relative_residual(coarse_crumple.sheet, result.points)
    assert residual == pytest.approx(result.residual, rel=1e-6)
    assert residual <= 1e-8
    assert result.kinetic_energy_ratio <= 1e-8
    tangent = coarse_crumple.sheet.tangent(result.points)
    rings = Rings.of(coarse_crumple.sheet.patch, result.points)
    assert factorise(InterfaceSystem.split(tangent, rings).interior).negative_eigenvalues == 0


def test_history_ends_at_the_result(coarse_crumple):
    sheet, result = coarse_crumple.sheet, coarse_crumple.result
    history = result.history
    energies = sheet.energies(result.points)
    assert history.step[0] == 0 and history.step[-1] == result.steps
    assert history.energies["membrane"][-1] == pytest.approx(energies.membrane, rel=1e-12)
    assert history.energies["bending"][-1] == pytest.approx(energies.bending, rel=1e-12)
    assert history.energies["stabilisation"][-1] == pytest.approx(energies.stabilisation, rel=1e-12)
    assert history.reaction_force[-1] == pytest.approx(reaction(sheet, result.points), rel=1e-9)
    assert history.residual[-1] == result.residual


def test_step_limit_is_a_verdict_that_names_both_numbers():
    sheet = imperfect_sheet(20e-3)
    result = relaxed(sheet, 0.04, ramp_steps=100, steps_max=37)
    assert result.status == "not_converged"
    assert result.steps == 137
    assert f"{result.residual:.1e} (wanted 1.0e-08)" in result.message
    assert "137" in result.message
    assert relative_residual(sheet, result.points) == pytest.approx(result.residual, rel=1e-9)


def test_an_unstable_mass_is_reported_as_divergence():
    result = relaxed(imperfect_sheet(20e-3), 0.04, ramp_steps=500, steps_max=500, safety=0.05)
    assert result.status == "diverged"
    assert "unstable" in result.message
    assert not result.residual < 1  # what is not a number must not look like an equilibrium


@pytest.mark.parametrize(
    ("norm", "scale", "residual"),
    [(0.0, 0.0, 0.0), (1.0, 0.0, np.inf), (1.0, 4.0, 0.25), (1.0, np.nan, np.nan)],
)
def test_a_residual_without_a_scale_is_zero_only_where_nothing_acts(norm, scale, residual):
    np.testing.assert_equal(solve_residual(norm, scale), residual)


# --- invariance of the result --------------------------------------------------------------------


def test_shape_is_independent_of_youngs_modulus_and_force_proportional():
    """To the last bit for a power of two: a stiffness scale is a scale of the mass too."""
    stiff = Material(4 * FEP.youngs_modulus, FEP.poisson_ratio, FEP.density, FEP.yield_stress)
    first, second = (
        relaxed(imperfect_sheet(20e-3, material=m), 0.04, ramp_steps=300, steps_max=300)
        for m in (FEP, stiff)
    )
    assert np.array_equal(first.points, second.points)
    assert np.array_equal(4 * first.history.reaction_force, second.history.reaction_force)
    bending = first.history.energies["bending"], second.history.energies["bending"]
    assert np.array_equal(4 * bending[0], bending[1])
    assert first.residual == second.residual


def test_the_same_bits_every_time():
    first, second = (
        relaxed(imperfect_sheet(20e-3), 0.04, ramp_steps=200, steps_max=100) for _ in range(2)
    )
    assert np.array_equal(first.points, second.points)


def mirrored(points):
    """Reflection theta -> -theta: column i goes to -i."""
    return np.roll(points[:, :, ::-1], 1, axis=2) * np.array([1, -1, 1])[:, None, None]


def quarter_turn(points):
    """Rotation by 90 degrees: a quarter of the columns."""
    turned = np.roll(points, points.shape[2] // 4, axis=2)
    return np.stack([-turned[1], turned[0], turned[2]])


@pytest.mark.parametrize("symmetry", [mirrored, quarter_turn])
def test_symmetry_of_the_cylinder_carries_over_to_the_crumple(symmetry):
    """Beyond buckling: the damping must not amplify rounding errors."""
    patch = Patch(32, 9, np.pi * DIAMETER / 32, REFERENCE_HEIGHT / 9)
    perfect = cylinder_control_points(patch, DIAMETER)
    deviation = np.zeros(patch.shape)
    deviation[:, FREE] = 1e-4 * np.random.default_rng(0).standard_normal(deviation[:, FREE].shape)
    shapes = []
    for reference in (perfect + deviation, symmetry(perfect + deviation)):
        sheet = Shell.elastic(patch, reference, FEP, THICKNESS)
        problem = Problem(sheet)
        motion = Scheme(
            SpectralMassScaling(SAFETY), relaxation_damping=AdaptiveViscousDamping(0.25)
        ).start(problem)
        rule = StoppingRule(1e-8, relaxation_steps_max=200)
        shapes.append(relax(problem, motion, Ramp(5e-3, 300), rule).points)
    moved = np.abs(np.hypot(*shapes[0][:2]) - np.hypot(*perfect[:2])).max()
    assert moved > 5e-3  # ten times the thickness: it has buckled
    np.testing.assert_allclose(shapes[1], symmetry(shapes[0]), rtol=0, atol=1e-10 * moved)


# --- equilibrium path ----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def path(coarse_crumple):
    """Energy and reaction of equilibria at small motions of the top ring, by Newton's method."""
    sheet, step = coarse_crumple.sheet, 1e-6
    rings = Rings.of(sheet.patch, coarse_crumple.points)
    states = {}
    for multiple in (-2, -1, 0, 1, 2):
        points = coarse_crumple.points.copy()
        points[2, -RING_ROWS:] += multiple * step
        for _ in range(12):
            force = np.moveaxis(force_of(sheet, points), 0, -1).ravel()[rings.interior]
            interior = InterfaceSystem.split(sheet.tangent(points), rings).interior
            correction = factorise(interior).solve(-force)
            moved = np.zeros(points.size)
            moved[rings.interior] = correction
            points += np.moveaxis(moved.reshape(*points.shape[1:], 3), -1, 0)
            if np.abs(correction).max() < 1e-14:
                break
        assert relative_residual(sheet, points) < 1e-11
        states[multiple] = sheet.energies(points).total, reaction(sheet, points), points
    return step, states


def richardson(values, step):
    """Fourth-order central derivative from values at -2, -1, 1, 2 steps."""
    return (values[-2] - 8 * values[-1] + 8 * values[1] - values[2]) / (12 * step)


def test_relaxation_has_found_the_equilibrium_that_newton_finds(coarse_crumple, path):
    _, states = path
    _, force, points = states[0]
    tangent = coarse_crumple.sheet.tangent(points)
    rings = Rings.of(coarse_crumple.sheet.patch, points)
    assert np.abs(points - coarse_crumple.points).max() < 1e-6
    assert force == pytest.approx(coarse_crumple.result.history.reaction_force[-1], rel=1e-5)
    assert factorise(InterfaceSystem.split(tangent, rings).interior).negative_eigenvalues == 0


def test_reaction_is_the_work_per_motion_of_the_ring(path):
    """Virtual work: dE = -F dh along the path of equilibria."""
    step, states = path
    slope = richardson({k: state[0] for k, state in states.items()}, step)
    # the energy of some joules is known to its rounding, which the step divides
    rounding = 1e-15 * states[0][0] / step
    assert -slope == pytest.approx(states[0][1], abs=4 * rounding, rel=1e-6)


def test_prestressed_stiffness_is_the_slope_of_the_reaction(coarse_crumple, path):
    step, states = path
    slope = -richardson({k: state[1] for k, state in states.items()}, step)
    sheet, points = coarse_crumple.sheet, states[0][2]
    tangent = InterfaceSystem.split(sheet.tangent(points), Rings.of(sheet.patch, points))
    assert condense(tangent).stiffness[8, 8] == pytest.approx(slope, rel=1e-5)
