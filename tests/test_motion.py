"""Masses and dampings of the relaxation that are not the default ones, by what theory says."""

from dataclasses import dataclass

import numpy as np
import pytest
from conftest import FEP, cylinder, imperfect_sheet

from foilstudy.base.errors import Refusal
from foilstudy.base.spec import dumped, loaded
from foilstudy.config import load_config
from foilstudy.config.scene import method_of
from foilstudy.linalg import SolveError
from foilstudy.model.patch import RING_ROWS
from foilstudy.pipeline.method import Method
from foilstudy.solve import choices
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import Ramp, Scheme, StoppingRule, relax
from foilstudy.solve.relaxation.damping import Damper, Halt
from foilstudy.solve.relaxation.damping.adaptive_viscous_plain import PlainAdaptiveViscousDamping
from foilstudy.solve.relaxation.damping.fixed_viscous import FixedViscousDamping
from foilstudy.solve.relaxation.damping.kinetic import KineticDamping
from foilstudy.solve.relaxation.damping.kinetic_reset import KineticResetDamping
from foilstudy.solve.relaxation.damping.none import NoDamping
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


# --- dampings ------------------------------------------------------------------------------------

STEP = 0.8


class Watched(Problem):
    """A problem that notes the amplitude of one mode whenever it is asked for the force."""

    def __init__(self, sheet, weights):
        super().__init__(sheet)
        self._weights, self.amplitudes = weights, []

    def force(self, points, out):
        self._note(points)
        return super().force(points, out)

    def gradient(self, points, out):
        self._note(points)
        super().gradient(points, out)

    def _note(self, points):
        moved = points - self.reference
        self.amplitudes.append(self._weights @ vector(moved[:, RING_ROWS:-RING_ROWS]))


@dataclass(frozen=True)
class Mode:
    """Frequency per step, shape, and what finds its amplitude in a motion."""

    omega: float
    shape: np.ndarray
    weights: np.ndarray


@pytest.fixture(scope="module")
def modes():
    """The lowest and the highest mode of a cylinder with its lumped mass."""
    problem = Problem(cylinder(SIZE))
    mass = CourantMass(STEP).start(problem)
    root = np.sqrt(np.repeat((mass.masses / mass.time_step**2).ravel(), 3))
    stiffness = PhysicalSheet(problem).stiffness.toarray()
    values, vectors = np.linalg.eigh(stiffness / np.outer(root, root))
    return [Mode(np.sqrt(values[k]), vectors[:, k] / root, vectors[:, k] * root) for k in (0, -1)]


AMPLITUDE = 1e-9
"""Largest motion of a control point, m: so small that the sheet is linear."""


def let_go(mode, damping, steps):
    """Amplitudes of the mode along a relaxation from it, over the first one."""
    problem = Watched(cylinder(SIZE), mode.weights)
    _, rows, columns = free_shape(problem)
    start = problem.reference.copy()
    moved = AMPLITUDE * mode.shape / np.abs(mode.shape).max()
    start[:, RING_ROWS:-RING_ROWS] += np.moveaxis(moved.reshape(rows, columns, 3), -1, 0)
    motion = Scheme(CourantMass(STEP), damping, damping).start(problem)
    relax(problem, motion, Ramp(0.0, 0), StoppingRule(0.0, steps), start)
    return np.array(problem.amplitudes) / problem.amplitudes[0]


def test_a_mode_is_at_rest_a_quarter_period_after_it_was_let_go(modes):
    mode, omega = modes[0], modes[0].omega
    quarter = 0.5 * np.pi / omega
    assert omega < 0.1
    amplitudes = let_go(mode, KineticDamping(), round(4 * quarter))
    after = int(quarter) + 3
    assert amplitudes[after - 6] > 2 * omega  # until then it moved
    assert np.abs(amplitudes[after:]).max() < 0.1 * omega**3
    # and it stays: a reset half a step or more behind the peak leaves what moves on
    reset = let_go(mode, KineticResetDamping(), round(4 * quarter))
    left = np.abs(reset[after:]).max()
    assert 0.4 * omega < left < 1.6 * omega


class Stopping(Damper):
    """Stops in every second step, at the shape that has been reached."""

    def __init__(self, push):
        self._push, self._calls = push, 0

    def start(self):
        return Stopping(self._push)

    def coefficient(self, work_rate, momentum_norm):
        return 0.0

    def halt(self, momentum_norm):
        self._calls += 1
        return Halt(0.0, self._push) if self._calls % 2 == 0 else None


@pytest.mark.parametrize("push", [0.5, 1.0])
def test_the_first_step_from_rest_takes_its_share_of_the_force(modes, push):
    for mode in modes:
        amplitudes = let_go(mode, Stopping(push), 21)
        factor = 1 - push * mode.omega**2
        np.testing.assert_allclose(amplitudes[3::2] / amplitudes[1:-2:2], factor, rtol=1e-3)


def test_a_plain_reset_drives_the_highest_mode_that_a_stop_at_the_peak_calms(modes):
    mode = modes[1]
    assert 2 < mode.omega**2 < 4
    assert np.abs(let_go(mode, KineticResetDamping(), 21)).max() > 10
    assert np.abs(let_go(mode, KineticDamping(), 60)[30:]).max() < 0.1


@pytest.mark.parametrize("peak", [-0.45, -0.1, 0.0, 0.3, 0.499])
def test_the_peak_of_a_parabola_is_found(peak):
    damper = KineticDamping().start()
    halts = [damper.halt(5.0 - (t - peak) ** 2) for t in (-1, 0, 1)]
    assert halts[:2] == [None, None]
    # the energies stand at the middle of steps, the shape at the end of the second step: 1/2
    assert halts[2].back == pytest.approx(0.5 - peak, abs=1e-14)
    assert halts[2].push == 0.5
    assert damper.halt(1e-9) is None  # it begins anew


@pytest.mark.parametrize("coefficient", [0.0, 0.003, 0.01])
def test_fixed_viscous_damping_takes_from_a_mode_what_theory_says(modes, coefficient):
    mode, omega, steps = modes[0], modes[0].omega, 400
    damping = FixedViscousDamping(coefficient) if coefficient else NoDamping()
    amplitudes = let_go(mode, damping, steps)
    # the recurrence x'' + c x' + omega^2 x = 0 by central differences
    decay = np.sqrt((1 - coefficient / 2) / (1 + coefficient / 2))
    turn = np.arccos((1 - 0.5 * omega**2) / np.sqrt(1 - coefficient**2 / 4))
    second = 1 - omega**2 / (1 + coefficient / 2)
    n = np.arange(steps + 1)
    sine = (second / decay - np.cos(turn)) / np.sin(turn)
    expected = decay**n * (np.cos(turn * n) + sine * np.sin(turn * n))
    np.testing.assert_allclose(amplitudes, expected, atol=1e-5)
    assert decay == pytest.approx(np.exp(-0.5 * coefficient), rel=1e-6)


def test_the_plain_coefficient_forgets():
    damper = PlainAdaptiveViscousDamping().start()
    damper.coefficient(100.0, 1.0)
    assert damper.coefficient(0.09 * 2.0, 2.0) == pytest.approx(2 * 0.3, rel=1e-14)


@pytest.mark.parametrize("coefficient", [-0.1, 2.0])
def test_a_coefficient_that_would_drive_or_reverse_the_motion_is_refused(coefficient):
    with pytest.raises(Refusal, match="coefficient of fixed viscous damping"):
        FixedViscousDamping(coefficient)


# --- ring alone ----------------------------------------------------------------------------------


def test_a_ring_that_moves_alone_leads_to_the_same_equilibrium_before_buckling():
    """There it is unique; only the way differs."""
    problem = Problem(imperfect_sheet(SIZE))
    reference, shortening = problem.reference, 2e-6
    first, last = [], []
    for spread in (True, False):
        ramp = Ramp(shortening, 100, spread)
        for steps, shapes in ((Ramp(shortening, 1, spread), first), (ramp, last)):
            rule = StoppingRule(1e-9, 20_000 if steps is ramp else 0)
            result = relax(problem, Scheme().start(problem), steps, rule)
            shapes.append(result.points - reference)
    assert result.status == "converged"
    np.testing.assert_allclose(last[1], last[0], atol=1e-4 * shortening)
    # after one step the sheet has followed, or none but the ring has moved
    assert np.all(first[0][2, 2 * RING_ROWS : -RING_ROWS] < 0)
    assert np.abs(first[1][:, :-RING_ROWS]).max() < 1e-9 * shortening
    np.testing.assert_allclose(first[1][2, -RING_ROWS:], -shortening)


# --- as data -------------------------------------------------------------------------------------


@pytest.mark.parametrize("mass", list(choices.MASSES))
@pytest.mark.parametrize("damping", list(choices.DAMPINGS))
def test_a_study_can_choose_it_and_its_record_says_so(mass, damping):
    section = {"mass": mass, "damping": damping, "path": "ring_alone"}
    sweep = {"thickness_um": [500], "reference_height_mm": [150]}
    study = load_config({"sweep": sweep, "method": section})
    method = method_of(study.crumple_task(study.cells()[0]))
    scheme = method.path.scheme
    assert (scheme.mass.kind, scheme.ramp_damping.kind) == (mass, damping)
    assert scheme.relaxation_damping.kind == damping
    assert loaded(Method, dumped(method)) == method and method.path.kind == "ring_alone"
