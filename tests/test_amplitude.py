"""How far a stiffness holds: sweeps of a ring, normal forms of modes, harmonic balance."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sparse
from conftest import DIAMETER, FEP, FOIL
from scipy.special import ellipk
from side_study import write_results
from small_study import SECTIONS

from foilstudy.base.errors import Refusal
from foilstudy.base.record import read_record
from foilstudy.config import load_config
from foilstudy.linalg import factorise, lowest_modes
from foilstudy.measure.amplitude.curve import ForceCurve, Side
from foilstudy.measure.amplitude.harmonic_balance import HarmonicBalance
from foilstudy.measure.amplitude.normal_form import condensed_force, normal_form
from foilstudy.measure.amplitude.oscillator import Oscillator
from foilstudy.measure.amplitude.release import released
from foilstudy.measure.stiffness import condense
from foilstudy.model.foil import Imperfection
from foilstudy.model.patch import Patch, cylinder_control_points, fitted_control_points
from foilstudy.model.shell.shell import Shell
from foilstudy.model.shell.tangent import mass_matrix
from foilstudy.model.supports.edges import SIMPLY_SUPPORTED, constraints, symmetric
from foilstudy.pipeline.amplitude import (
    MOTIONS,
    SweepPlan,
    clamped_modes,
    linear_amplitude,
    ring_sweep,
)
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.structures import prestressed_stiffness, stress_free_stiffness
from foilstudy.solve.equilibrium.swept import RingMotion, swept
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.study.amplitude import measure, tables
from foilstudy.study.amplitude.plan import LETTINGS, STUDY
from foilstudy.study.kernel.files import present, read_records
from foilstudy.study.sweep.crumple import crumple_job
from foilstudy.study.sweep.cube import gather
from foilstudy.study.sweep.cylinder import cylinder_bounds
from foilstudy.study.sweep.origins import cell_folder
from foilstudy.study.sweep.respond import respond_job


def crumpled_on(element_size, foil=FOIL):
    method = Method(RelaxationPath(ramp_steps=500, check_interval=5))
    crumpled = crumple(foil, Mesh(element_size), Imperfection(), method)
    assert crumpled.status == "converged", crumpled.message
    return crumpled


@pytest.fixture(scope="module")
def small():
    return crumpled_on(15e-3)


# --- sweeps ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("axis", range(6))
def test_a_ring_moves_as_a_rigid_body(axis):
    ring = np.random.default_rng(0).standard_normal((3, 7))
    motion = RingMotion(axis, 0.1)

    def moved(way):
        return motion.moved(ring, 0.3 + way)

    gaps = [np.linalg.norm(x[:, :, None] - x[:, None], axis=0) for x in (ring, moved(0))]
    np.testing.assert_allclose(gaps[1], gaps[0], atol=1e-14)
    slope = (moved(1e-5) - moved(-1e-5)) / 2e-5
    bend = (moved(1e-3) - 2 * moved(0) + moved(-1e-3)) / 1e-6
    np.testing.assert_allclose(motion.velocity(moved(0)), slope, atol=1e-7)
    np.testing.assert_allclose(motion.acceleration(moved(0)), bend, atol=1e-2)


@pytest.mark.parametrize("stressed", [False, True])
@pytest.mark.parametrize("motion", MOTIONS)
def test_the_tangent_at_rest_is_the_condensed_stiffness(small, motion, stressed):
    system = prestressed_stiffness if stressed else stress_free_stiffness
    axis = 6 + MOTIONS[motion]
    expected = condense(system(small)).stiffness[axis, axis]
    expected /= 1.0 if axis < 9 else (DIAMETER / 2) ** 2
    curve = ring_sweep(small, motion, SweepPlan(1e-4, 1, 1e-5, stressed))
    assert curve.stiffness == pytest.approx(expected, rel=1e-9)
    for side in curve.sides:  # and small motions have it
        assert abs(side.secant[0] / expected - 1) < 3e-4


@pytest.mark.parametrize("motion", ["axial", "radial_x", "tilt_y", "twist"])
def test_the_force_is_the_derivative_of_the_energy(small, motion):
    """Boole's rule on the forces of equal steps, and the cubic between forces and tangents."""
    curve = ring_sweep(small, motion, SweepPlan(1e-3, 4, 5e-4))
    for side in curve.sides:
        assert side.status == ("converged",) * 4
        rest = ring_rest(small, motion)
        forces = np.append(0, side.force) + rest
        step = side.motion[0]
        work = np.array([7, 32, 12, 32, 7]) @ forces * 2 * step / 45
        spring = 0.5 * curve.stiffness * side.motion[-1] ** 2
        assert abs(work - side.energy[-1]) < 1e-6 * spring
        assert (np.abs(side.released) < 1e-6 * spring).all()


def ring_rest(crumpled, motion):
    force = np.empty_like(crumpled.points)
    crumpled.problem().force(crumpled.points, force)
    ring = crumpled.points[:, -2:].reshape(3, -1)
    velocity = RingMotion(MOTIONS[motion], DIAMETER / 2).velocity(ring)
    return float((force[:, -2:].reshape(3, -1) * velocity).sum())


def test_the_force_of_a_symmetric_structure_is_odd():
    """A straight cylinder does not know left from right, but pulled from pushed."""
    start = uncrumpled(FOIL, Mesh(18e-3))
    points = cylinder_control_points(start.patch, DIAMETER)
    cylinder = replace(start, points=points, reference=points)
    plan = SweepPlan(2e-4, 2, 1e-4)
    _, odd, even = ring_sweep(cylinder, "twist", plan).parts()
    assert (np.abs(even) < 1e-7 * odd).all()
    _, odd, even = ring_sweep(cylinder, "axial", plan).parts()
    assert (np.abs(even) > 1e-5 * odd).all()


def side_of(motion, stiffness, status=None):
    force = stiffness * motion
    none = np.zeros_like(motion)
    return Side(motion, force, none, none, none, status or ("converged",) * len(motion))


def test_the_linear_amplitude_of_known_laws():
    ways = 1e-6 * 2.0 ** np.arange(10)
    for power in (1, 2):
        sides = (side_of(s * ways, 5.0 * (1 - (s * ways / 1e-2) ** power)) for s in (1, -1))
        curve = ForceCurve(5.0, tuple(sides))
        # 1 % at a hundredth of 1e-2, or at a tenth, which is beyond the sweep
        expected = 1e-4 if power == 1 else np.inf
        assert curve.linear_amplitude() == pytest.approx(expected, rel=1e-9)
    amplitudes, odd, even = ForceCurve(
        5.0, tuple(side_of(s * ways, 5.0 + s * 1e3 * ways) for s in (1, -1))
    ).parts()
    np.testing.assert_allclose(odd, 5 * ways)
    np.testing.assert_allclose(even, 1e3 * ways**2)
    assert np.array_equal(amplitudes, ways)


def test_a_side_that_ended_early_has_no_linear_amplitude():
    ways = np.array([1e-5, 2e-5, 3e-5])
    short = side_of(-ways, np.full(3, 5.0), ("converged", "converged", "not_converged"))
    late = side_of(ways, 5 * np.array([1.0, 1.0, 1.02]))
    assert np.isnan(ForceCurve(5.0, (late, short)).linear_amplitude())
    early = side_of(ways, 5 * np.array([1.02, 1.03, 1.04]))
    assert ForceCurve(5.0, (early, short)).linear_amplitude() == pytest.approx(5e-6, rel=1e-9)


def test_a_change_within_the_first_step_begins_at_rest():
    """Force 5 x - 500 x^2: 1 % at 0.1 mm, of which the first step sees the double."""
    ways = np.array([2e-4, 4e-4])
    side = side_of(ways, 5.0 * (1 - ways / 1e-2))
    assert ForceCurve(5.0, (side,)).linear_amplitude() == pytest.approx(1e-4, rel=1e-9)


def test_the_linear_amplitude_of_a_crumple_ends_the_sweep(small):
    plan = SweepPlan(2e-3, 4)
    whole = ring_sweep(small, "axial", plan)
    assert linear_amplitude(small, "axial", plan) == whole.linear_amplitude()
    cut = ring_sweep(small, "axial", replace(plan, until=0.01))
    assert max(len(side.motion) for side in cut.sides) < len(whole.sides[0].motion)
    with pytest.raises(Refusal, match="axial or radial"):
        linear_amplitude(small, "twist")
    with pytest.raises(Refusal, match="no motion 'up'; give one of radial_x"):
        ring_sweep(small, "up")


@pytest.fixture(scope="module")
def tall():
    return crumpled_on(18e-3)


def test_a_snap_is_told_and_the_sweep_goes_on(tall):
    curve = ring_sweep(tall, "axial", SweepPlan(1e-2, 10, 1e-3))
    up = curve.sides[0]
    assert "snapped" in up.status and up.found.all()
    k = up.status.index("snapped")
    assert up.released[k] > 0 and "snapped before +" in curve.message


def test_a_sweep_that_finds_no_equilibrium_says_so(small):
    plan = SweepPlan(0.05, 1, 0.05)
    curve = ring_sweep(small, "axial", replace(plan, solver=replace(plan.solver, hessians=1)))
    assert "no equilibrium at +50 mm" in curve.message
    assert np.isnan(curve.sides[0].force).all() and np.isnan(curve.linear_amplitude())


def test_a_state_that_is_no_minimum_is_told(small):
    pushed = replace(small, points=uncrumpled(FOIL, Mesh(15e-3)).points * [[[1]], [[1]], [[0.9]]])
    curve = ring_sweep(pushed, "axial")
    assert curve.sides == () and "no minimum" in curve.message
    assert np.isnan(curve.linear_amplitude())


def test_a_plastic_foil_is_loaded_either_way_from_its_state():
    foil = replace(FOIL, material=replace(FEP, law="plastic"))
    crumpled = crumpled_on(18e-3, foil)
    before = crumpled.problem().spent(crumpled.problem().state)
    curve = ring_sweep(crumpled, "axial", SweepPlan(3e-3, 3, 1e-3))
    assert curve.stiffness == pytest.approx(crumpled.prestressed_stiffness()[0], rel=1e-9)
    assert crumpled.problem().spent(crumpled.problem().state) == before
    problem = crumpled.problem()
    path = swept(problem, crumpled.points, RingMotion(2, 0.1), -1e-3 * np.arange(1, 4))
    spent, places = [before], [next(path)]
    for place in path:
        here = problem.state
        problem.commit(place.points)  # as the sweep itself does then
        spent.append(problem.spent(problem.state))
        problem.state = here
        places.append(place)
        step = places[-1].way - places[-2].way
        assert abs(place.released) < 5e-2 * 0.5 * curve.stiffness * step**2
    assert (np.diff(spent) > 0).all()  # it yields, and gets nothing back
    assert places[-1].force - places[0].force == pytest.approx(curve.sides[1].force[-1], rel=1e-6)


# --- one mode -------------------------------------------------------------------------------------


class Toy:
    """u1'' + u1 + 2 c u1 u2 = 0, u2'' + s2 u2 + c u1^2 = 0, and unknowns that do nothing."""

    def __init__(self, coupling, second, cubic=0.0):
        self._c, self._b = coupling, cubic
        self._k = np.array([1.0, second**2, 2e4, 2.1e4, 2.2e4, 2.3e4])
        self.mass = sparse.identity(6, format="csr")
        self.stiffness = sparse.diags(self._k, format="csr")

    def force(self, u):
        bent = np.zeros(6)
        bent[:2] = 2 * self._c * u[0] * u[1] + self._b * u[0] ** 3, self._c * u[0] ** 2
        return self._k * u + bent

    def tangent(self, u):
        more = np.zeros((6, 6))
        more[0, 0], more[0, 1] = 2 * self._c * u[1] + 3 * self._b * u[0] ** 2, 2 * self._c * u[0]
        more[1, 0] = more[0, 1]
        return sparse.csr_matrix(np.diag(self._k) + more)


def test_the_normal_form_of_a_known_system_holds_where_condensation_does_not():
    toy, shape = Toy(0.5, 2.6), np.eye(6)[0]
    form = normal_form(toy, factorise(toy.stiffness), 1.0, shape, 0.1)
    g2, s2 = 4 * 0.5**2, 2.6**2
    assert form.quadratic == pytest.approx(0, abs=1e-12)
    assert form.cubic == pytest.approx(-g2 / s2 / 2)
    assert form.duffing.period_frequency(0.1) - 1 == pytest.approx(form.bend * 0.1**2 / 2, rel=1e-2)
    assert form.bend == pytest.approx(-g2 / s2 / 4 - g2 / (s2 - 4) / 8)
    start = 0.1 * shape
    start[1] = -0.25 * g2**0.5 * 0.1**2 * (1 / s2 + 1 / (s2 - 4))  # on the normal mode
    found = released(toy, shape, start, 130.0).frequency
    shift = 2 * np.pi * found - 1
    assert shift == pytest.approx(2 * np.pi * form.backbone(np.array(0.1)) - 1, rel=0.03)
    condensed = form.oscillator.period_frequency(0.1) - 1
    assert abs(condensed / shift - 1) > 0.25 and form.condensation_error > 0.25


class Strip:
    """A wide plate on hinges that do not come nearer, in cylindrical bending."""

    thickness, length = 1e-3, 0.2

    def __init__(self, elements=16):
        patch = Patch(elements, 2, self.length / elements, 0.02, periodic=False)
        flat = fitted_control_points(patch, lambda x, y: np.stack([x, y, np.zeros_like(x)]))
        self._shell, self._flat = Shell.elastic(patch, flat, FEP, self.thickness), flat
        edges = dict.fromkeys(("left", "right"), SIMPLY_SUPPORTED)
        edges |= dict.fromkeys(("bottom", "top"), symmetric(1))
        self._held = constraints(patch, edges)
        areas = self._shell.section.areas
        whole = mass_matrix(patch, FEP.density * self.thickness * areas)
        self.mass = self._held.reduced_matrix(whole)
        self.stiffness = self.tangent(np.zeros(self._held.free))

    def points(self, u):
        return self._flat + self._held.displacement(u)

    def force(self, u):
        out = np.empty_like(self._flat)
        self._shell.force(self.points(u), out)
        return self._held.reduced(out)

    def tangent(self, u):
        return self._held.reduced_matrix(self._shell.tangent(self.points(u)))


def test_a_hinged_strip_hardens_as_woinowsky_krieger_found():
    """w^2 = w0^2 (1 + 3/16 (A/r)^2), r = t / sqrt(12) (J. Appl. Mech. 17, 35-36, 1950)."""
    strip = Strip()
    static = factorise(strip.stiffness)
    modes = lowest_modes(strip.stiffness, strip.mass, static, 1)
    form = normal_form(strip, static, modes.eigenvalues[0], modes.shapes[:, 0], 1e-4)
    crest = np.abs(strip.points(modes.shapes[:, 0])[2]).max()
    form = replace(form, displacement=float(crest))
    amplitude = strip.thickness / 2
    hardened = (form.backbone(np.array(amplitude)) / form.frequency) ** 2 - 1
    assert hardened == pytest.approx(3 / 16 * 12 * 0.25, rel=0.03)
    assert form.condensation_error < 1e-3 and form.doubt < 1e-4


def test_coefficients_of_a_mode_against_energies_and_the_condensed_force(small):
    modes = clamped_modes(small, 3)
    form, shape = modes.normal_forms()[2], modes.shapes[:, 2]
    assert form.doubt < 1e-5
    problem, points, step = small.problem(), small.points, 2e-4 / form.displacement

    def energy(a):
        moved = points.copy()
        inner = moved[:, 2:-2]
        inner += (a * shape).reshape(*inner.shape[1:], 3).transpose(2, 0, 1)
        return problem.value(moved)

    odd = (energy(step) - energy(-step)) / 2
    assert odd == pytest.approx(form.quadratic / 3 * step**3, rel=5e-2)
    amplitudes = step * np.array([0.25, 0.5])
    ahead, behind = (condensed_force(modes.foil, shape, s * amplitudes)[0] for s in (1, -1))
    bent = (ahead - behind) / 2 - form.eigenvalue * amplitudes
    np.testing.assert_allclose(bent, form.cubic * amplitudes**3, rtol=1e-2)
    np.testing.assert_allclose((ahead + behind) / 2, form.quadratic * amplitudes**2, rtol=1e-2)


def test_a_mode_vibrates_as_its_normal_form_says_and_not_as_its_condensed_force(small):
    modes = clamped_modes(small, 3, stressed=False)
    form, shape = modes.normal_forms()[2], modes.shapes[:, 2]
    displacement = 1e-3
    amplitude = displacement / form.displacement
    start = condensed_force(modes.foil, shape, amplitude * np.array([0.5, 1.0]))[1][-1]
    found = released(modes.foil, shape, start, 3.2 / form.frequency).frequency
    shift = found / form.frequency - 1
    expected = form.backbone(np.array(displacement)) / form.frequency - 1
    assert shift == pytest.approx(expected, rel=0.05)
    condensed = form.oscillator.period_frequency(amplitude) / form.oscillator.frequency - 1
    assert abs(condensed / shift) < 0.5


def test_the_backbone_of_duffing():
    spring = Oscillator((4.0, 0.0, 3.0))
    for amplitude in (0.1, 1.0, 3.0):
        bend = 3 * amplitude**2 / 4
        exact = np.pi * np.sqrt(1 + bend) / ellipk(bend / (2 * (1 + bend)))
        assert spring.period_frequency(amplitude) == pytest.approx(exact, rel=1e-12)
    assert np.isnan(Oscillator((1.0, 0.0, -1.0)).period_frequency(1.2))  # out of its well


def test_harmonic_balance_holds_against_time_integration():
    spring = Oscillator((1.0, 0.4, 0.5))
    balance = HarmonicBalance(spring, force=0.05, damping=0.04)
    curve = balance.response(0.6, 1.6, 0.02)
    assert curve.status == "converged" and curve.amplitude.max() > 1
    series = curve.series()
    for k in (5, 40, len(curve.frequency) - 5):
        speed = (series[k, 1] - series[k, -1]) * 200 * curve.frequency[k] / (4 * np.pi)
        start = series[k, 0], speed
        truth = spring.driven(curve.frequency[k], 0.05, 0.04, 40, start)
        np.testing.assert_allclose(series[k], truth, atol=1e-5 * np.abs(truth).max())
    resonance = curve.frequency[curve.amplitude.argmax()]
    crest = series[curve.amplitude.argmax()].max()
    assert resonance == pytest.approx(spring.period_frequency(crest), rel=5e-3)


# --- in a study -----------------------------------------------------------------------------------


def test_a_study_asks_for_linear_amplitudes(tmp_path):
    sweep = {"thickness_um": [500], "reference_height_mm": [143], "realisations": 1}
    sections = SECTIONS | {"sweep": sweep}
    plain, asked = (
        load_config(sections | {"amplitude": {"directions": directions}})
        for directions in ([], ["axial"])
    )
    (cell,) = asked.cells()
    place = cell_folder(tmp_path, cell)
    assert plain.crumple_task(cell) == asked.crumple_task(cell)
    crumple_job(asked.crumple_task(cell), place / "crumple.nc")
    found = {}
    for study in (plain, asked):  # the latter stays for the cube
        respond_job(study.response_task(cell), place / "crumple.nc", place / "response.nc")
        found[study.amplitude.directions], _ = read_record(place / "response.nc")
    assert found["axial",].keys() - found[()].keys() == {"amplitude_1_percent"}
    for name in found[()].keys() - {"seconds_static", "seconds_dynamic", "peak_memory"}:
        np.testing.assert_array_equal(found["axial",][name], found[()][name], name)
    cylinder_bounds(asked, tmp_path / "cylinder.nc")
    amplitude = gather(asked, tmp_path, tmp_path / "cube.nc")["amplitude_1_percent"]
    assert amplitude.dims == ("thickness", "overlength", "seed", "direction")
    assert amplitude.units == "m" and np.isnan(amplitude.sel(direction="radial")).all()
    expected = linear_amplitude(Crumpled.recorded(place / "crumple.nc"), "axial")
    assert float(amplitude.sel(direction="axial")[0, 0, 0]) == expected > 0


def test_the_side_study_shows_what_it_measures(small, tmp_path, monkeypatch):
    monkeypatch.setattr(measure, "_crumple_of", lambda *_: small)
    monkeypatch.setattr(measure, "PERIODS", 2.0)
    swept_axially = {
        case.prestressed: measure.sweep(case, {})
        for case in STUDY.part("sweeps").cases
        if (case.thickness_um, case.motion) == (500, "axial")
    }
    formed = measure.modes(STUDY.part("modes").cases[0], {})
    results = {
        "sweeps": {c: swept_axially[c.prestressed] for c in STUDY.part("sweeps").cases},
        "modes": dict.fromkeys(STUDY.part("modes").cases, formed),
    }
    spread = STUDY.part("spreads").cases
    near = measure.spread(spread[0], {})
    assert near["linear_amplitude"] == pytest.approx(swept_axially[False]["linear_amplitude"])
    beyond = near | {"linear_amplitude": None}
    lost = beyond | {"ended_early": True}
    by_seed = {0: near, 1: near, 2: beyond, 3: beyond, 4: beyond, 5: lost}
    results["spreads"] = {case: by_seed[case.seed] for case in spread}
    let = measure.release(LETTINGS[0], {})
    results["releases"] = dict.fromkeys(LETTINGS, let)
    results["shapes"] = dict.fromkeys(STUDY.part("shapes").cases, {"points": small.points})
    write_results(STUDY, results, tmp_path)
    present(STUDY, tmp_path)
    assert {path.name for path in tmp_path.iterdir() if path.is_file()} >= set(STUDY.outputs())
    findings = STUDY.findings(read_records(STUDY, tmp_path))
    first, *_ = tables.linear(findings)
    curve = ring_sweep(small, first["motion"], SweepPlan(stressed=first["prestressed"]))
    assert first["linear_amplitude_mm"] == pytest.approx(1e3 * curve.linear_amplitude())
    assert next(iter(tables.steps(findings)))["way"] == curve.sides[0].motion[0]
    page = tables.page(findings)
    least = 1e3 * near["linear_amplitude"]
    assert f"| > 1 | {least:.2g} | > 1 | 5 of 6 |" in page  # of five three are beyond
    assert "| axial | 0 |" in page and "softens" in page
    assert let["integrated"] == pytest.approx(let["normal_form"], abs=1e-3)
