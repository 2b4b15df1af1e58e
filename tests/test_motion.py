"""Masses and dampings of the relaxation that are not the default ones, by what theory says."""

import numpy as np
import pytest
from conftest import FEP, cylinder, imperfect_sheet

from foilstudy.base.errors import Refusal
from foilstudy.linalg import SolveError
from foilstudy.model.patch import RING_ROWS
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import Ramp, Scheme, StoppingRule, relax
from foilstudy.solve.relaxation.mass.courant import CourantMass
from foilstudy.solve.relaxation.mass.nodal import NodalMassScaling
from foilstudy.solve.relaxation.mass.physical import PhysicalSheet
from foilstudy.solve.relaxation.mass.selective import SelectiveMassScaling

SIZE = 20e-3
MASSES = [
    CourantMass(),
    CourantMass(step_factor=0.3),
    NodalMassScaling(),
    NodalMassScaling(step_factor=1.2),
    SelectiveMassScaling(beta=0.0),
    SelectiveMassScaling(beta=3.0),
    SelectiveMassScaling(beta=3e3),
]


@pytest.fixture(scope="module")
def problem():
    return Problem(imperfect_sheet(SIZE))


def vector(array):
    """In the order of the matrices: row, column, component."""
    return np.moveaxis(array, 0, -1).ravel()


def matrix_of(mass):
    """The mass that is stepped with, assembled."""
    if hasattr(mass, "matrix"):
        return mass.matrix().toarray()
    return np.diag(np.repeat((mass.masses / mass.time_step**2).ravel(), 3))


def free_shape(problem):
    return 3, problem.patch.rows - 2 * RING_ROWS, problem.patch.columns


@pytest.mark.parametrize("scaling", MASSES, ids=repr)
def test_a_mass_is_definite_bounds_the_stiffness_and_is_what_is_solved_for(problem, scaling):
    mass = scaling.start(problem)
    dense = matrix_of(mass)
    np.testing.assert_allclose(dense, dense.T, atol=1e-14 * np.abs(dense).max())
    factor = np.linalg.cholesky(dense)
    stiffness = PhysicalSheet(problem).stiffness.toarray()
    scaled = np.linalg.solve(factor, np.linalg.solve(factor, stiffness).T)
    largest = np.linalg.eigvalsh(scaled)[-1]
    assert largest <= 4 / getattr(scaling, "safety", scaling.step_factor**-2) * 1.001
    if not isinstance(scaling, NodalMassScaling):  # no heavier than it takes
        assert largest == pytest.approx(4 * scaling.step_factor**2, rel=1e-3)
    rng = np.random.default_rng(0)
    for _ in range(3):  # the second solution starts from the first
        momentum = rng.standard_normal(free_shape(problem))
        left = dense @ vector(mass.velocity(momentum)) - vector(momentum)
        assert np.linalg.norm(left) <= 1.01e-6 * np.linalg.norm(momentum)


def test_the_physical_mass_is_that_of_the_foil():
    sheet = cylinder(SIZE)
    physical = PhysicalSheet(Problem(sheet))
    area = sheet.patch.size_around * sheet.patch.size_along
    element = FEP.density * sheet.thickness * area
    np.testing.assert_allclose(physical.masses, element, rtol=1e-3)  # all is theirs but the rings'
    assert physical.element_mass == pytest.approx(element, rel=1e-3)


def test_the_courant_step_is_the_time_a_wave_takes_across_an_element():
    """Of the speed c = sqrt(E/(rho (1 - nu^2))); in one direction it were sqrt(8/3) as long.

    There a quadratic spline with lumped mass has omega^2 <= 3/2 (c/h)^2, at three elements a wave.
    """
    speed = np.sqrt(FEP.youngs_modulus / FEP.density / (1 - FEP.poisson_ratio**2))
    steps = [PhysicalSheet(Problem(cylinder(size))).courant_step for size in (SIZE, SIZE / 2)]
    assert 0.5 < steps[0] * speed / SIZE < np.sqrt(8 / 3)
    assert steps[0] / steps[1] == pytest.approx(2.0, rel=0.02)


def test_a_translation_sees_the_physical_mass_alone(problem):
    scaling = SelectiveMassScaling(beta=1e3)
    mass = scaling.start(problem)
    rows, columns = free_shape(problem)[1:]
    for direction in np.eye(3):
        inertia = matrix_of(mass) @ np.tile(direction, rows * columns)
        inertia = inertia.reshape(rows, columns, 3)[1:-1] * mass.time_step**2
        physical = PhysicalSheet(problem).masses[1:-1, :, None] * direction
        np.testing.assert_allclose(inertia, physical, atol=1e-9 * physical.max())
    # a checkerboard sees (1 + 4/3 beta) of it
    board = (-1.0) ** np.add.outer(np.arange(rows), np.arange(columns))
    assert columns % 2 == 0
    inertia = matrix_of(mass) @ np.repeat(board.ravel(), 3)
    inertia = inertia.reshape(rows, columns, 3)[1:-1] * mass.time_step**2
    ratio = inertia / (board[1:-1, :, None] * PhysicalSheet(problem).element_mass)
    np.testing.assert_allclose(ratio, 1 + 4e3 / 3, rtol=1e-3)


def test_a_nodal_mass_says_how_much_was_added(problem):
    light, heavy = (NodalMassScaling(step_factor=f).start(problem) for f in (100.0, 200.0))
    physical = PhysicalSheet(problem).masses
    assert light.added == pytest.approx(light.masses.sum() / physical.sum() - 1, rel=1e-12)
    assert heavy.added + 1 == pytest.approx(4 * (light.added + 1), rel=1e-12)
    # in pseudo-time, once all are raised, it is the same mass
    np.testing.assert_allclose(matrix_of(heavy), matrix_of(light), rtol=1e-12)
    none = NodalMassScaling(step_factor=0.1).start(problem)
    assert none.added == 0 and np.array_equal(none.masses, physical)


def test_steps_beyond_the_courant_step_are_reported_as_divergence(problem):
    rule = StoppingRule(1e-8, 300)
    status = {}
    for factor in (0.8, 1.1):
        motion = Scheme(CourantMass(factor)).start(problem)
        status[factor] = relax(problem, motion, Ramp(1e-4, 100), rule).status
    assert status[0.8] != "diverged" and status[1.1] == "diverged"


def test_a_mass_that_is_not_solved_for_is_a_verdict_with_the_step(problem):
    scheme = Scheme(SelectiveMassScaling(beta=1e3, iterations_max=5))
    result = relax(problem, scheme.start(problem), Ramp(1e-2, 100), StoppingRule(1e-8, 100))
    assert result.status == "diverged"
    assert "5 iterations left" in result.message
    assert result.message.endswith(f"(step {result.steps})")
    assert result.history.step[-1] == result.steps
    assert np.isfinite(result.points).all()


def test_a_momentum_that_is_not_finite_is_no_solution(problem):
    mass = SelectiveMassScaling().start(problem)
    with pytest.raises(SolveError, match="not finite"):
        mass.velocity(np.full(free_shape(problem), np.nan))
    assert not mass.velocity(np.zeros(free_shape(problem))).any()


@pytest.mark.parametrize("kind", [CourantMass, NodalMassScaling, SelectiveMassScaling])
def test_a_step_that_is_none_is_refused(kind):
    with pytest.raises(Refusal, match="step factor of .* is 0; give a finite number above 0"):
        kind(step_factor=0.0)
