"""Friction of contacts: Coulomb's law, what it spends, and that rigid motions cost nothing."""

import numpy as np
import pytest
from conftest import DIAMETER, FEP, rotation
from test_contact import flattened
from test_contact_study import BARRIER, refusal, study_with

from foilstudy.base.errors import Refusal
from foilstudy.base.record import read_record
from foilstudy.measure.stiffness import prestressed_stiffness
from foilstudy.model.contact import sliding
from foilstudy.model.contact.friction import Friction
from foilstudy.model.contact.options import BarrierContact
from foilstudy.model.contact.planes import RingPlanes
from foilstudy.model.contact.term import SelfContact
from foilstudy.model.patch import Patch
from foilstudy.model.shell.shell import Shell
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.solve.problem import Problem
from foilstudy.study.sweep.crumple import crumple_job

MU = 0.3


def rolled(rough=2e-5):
    """A cylinder whose foil bulges onto the planes of its rings."""
    patch = Patch(24, 6, np.pi * DIAMETER / 24, 0.02)
    angle = 2 * np.pi * (np.arange(24) + 0.5) / 24
    height, bulge = 0.02 * (np.arange(patch.rows) - 0.5), 0.1 * np.ones(patch.rows)
    bulge[3:-3] = 0.12
    height[2:4], height[-4:-2] = 5e-4, 0.12 - 5e-4
    points = np.empty(patch.shape)
    points[0], points[1] = bulge[:, None] * np.cos(angle), bulge[:, None] * np.sin(angle)
    points[2] = height[:, None]
    sheet = Shell.elastic(patch, points, FEP, 1e-4)
    return sheet, points + rough * np.random.default_rng(2).standard_normal(points.shape)


def on_itself():
    sheet, points = flattened()
    return SelfContact(sheet.section), points, (points[1] > 0)


def on_planes():
    sheet, points = rolled()
    ring = np.zeros(points.shape[1:], dtype=bool)
    ring[:2] = True
    return RingPlanes(sheet.section), points, ring


either = pytest.mark.parametrize("make", [on_itself, on_planes])


def begun(make):
    """A term of friction, the shape in which it is first committed, its state and what is moved."""
    contact, points, moved = make()
    force = np.empty_like(points)
    assert contact.force(points, force)[0] > 0
    term = Friction(contact, MU)
    return term, points, term.evolved(points, term.start()), moved


def force_of(term, points, state):
    out = np.empty_like(points)
    (energy,) = term.force(np.ascontiguousarray(points), out, state)
    return energy, out


def pulls(term, state, points):
    """Force along every contact, N."""
    slid = sliding.slides(term._contact.surface.knots(points), *state.geometry)
    return term.stiffness * np.linalg.norm(state.stretched + slid - state.slipped, axis=1)


def slack(term, state):
    """By how much a spring is stretched when it lets go, m."""
    return np.median(state.limit) / term.stiffness


def rubbed(make):
    """The same after some rubbing, so that some contacts stick and others slip."""
    term, points, state, _ = begun(make)
    rng = np.random.default_rng(0)
    for _ in range(4):
        points = points + slack(term, state) * rng.standard_normal(points.shape)
        state = term.evolved(points, state)
    return term, points, state


@either
def test_first_touch_exerts_nothing(make):
    term, points, state, _ = begun(make)
    assert len(state) > 10
    assert state.limit.min() > 0
    energy, force = force_of(term, points, state)
    assert energy < 1e-25 and np.abs(force).max() < 1e-9  # rounding of the gap


@either
def test_force_and_tangent_within_a_step(make):
    """Of springs that stick, of those that slip, and of energy and what is spent together."""
    term, committed, before = rubbed(make)
    rng = np.random.default_rng(7)
    points = committed + 0.7 * slack(term, before) * rng.standard_normal(committed.shape)
    state = term.led(points, before)
    slipping = np.linalg.norm(state.slipped, axis=1) > 0
    assert 0.1 < slipping.mean() < 0.9

    def led(shape):
        at = term.led(shape, before)
        energy, force = force_of(term, shape, at)
        return energy + at.spent, force

    step = 1e-4 * slack(term, before)
    for at, follow in ((state, led), (before, lambda shape: force_of(term, shape, before))):
        _, force = force_of(term, points, at)
        tangent = term.tangent(points, at)
        assert abs(tangent - tangent.T).max() < 1e-9 * abs(tangent).max()
        for seed in range(3):
            way = np.random.default_rng(seed).standard_normal(points.shape)
            (high, rise), (low, fall) = follow(points + step * way), follow(points - step * way)
            assert (high - low) / (2 * step) == pytest.approx(np.sum(force * way), rel=1e-6)
            slope = np.moveaxis(rise - fall, 0, -1).ravel() / (2 * step)
            expected = tangent @ np.moveaxis(way, 0, -1).ravel()
            assert np.linalg.norm(slope - expected) < 1e-5 * np.linalg.norm(expected)


@either
def test_a_rigid_motion_of_the_whole_costs_nothing(make):
    term, points, state = rubbed(make)
    energy, force = force_of(term, points, state)
    assert energy > 0
    arms, forces = points.reshape(3, -1).T, force.reshape(3, -1).T
    assert np.abs(forces.sum(axis=0)).max() < 1e-11 * np.abs(forces).max()
    assert np.abs(np.cross(arms, forces).sum(axis=0)).max() < 1e-11 * np.abs(forces).max()
    turn = rotation([1, 2, 3], 0.9)
    there = np.einsum("ij,jrc->irc", turn, points) + np.array([0.1, -0.2, 0.3])[:, None, None]
    led = term.led(there, state)
    assert led.spent == pytest.approx(state.spent, rel=1e-9)
    again, turned = force_of(term, there, led)
    assert again == pytest.approx(energy, rel=1e-7)
    assert np.abs(turned - np.einsum("ij,jrc->irc", turn, force)).max() < 1e-7 * np.abs(force).max()
    committed = term.evolved(there, state)
    np.testing.assert_allclose(
        pulls(term, committed, there), pulls(term, state, points), rtol=1e-6, atol=1e-9
    )


@either
def test_dissipation_never_falls_and_the_law_holds_in_every_committed_shape(make):
    """The work done on the springs is what they hold and what has been spent."""
    term, points, state, _ = begun(make)
    rng, work, force = np.random.default_rng(3), 0.0, np.zeros_like(points)
    for _ in range(6):
        way = 0.3 * slack(term, state) * rng.standard_normal(points.shape)
        if make is on_planes:
            way[2] = 0.0  # the planes are stiff
        for _ in range(10):
            points = points + way
            within = term.led(points, state)
            assert (pulls(term, within, points) <= within.limit * (1 + 1e-9) + 1e-12).all()
            work += 0.5 * np.sum((force + force_of(term, points, within)[1]) * way)
            state, spent = term.evolved(points, state), state.spent
            assert state.spent >= within.spent >= spent
            held = pulls(term, state, points)
            assert (held <= MU * state.contacts.force * (1 + 1e-9) + 1e-12).all()
            energy, force = force_of(term, points, state)
    assert state.spent > 0.2 * work
    assert energy + state.spent == pytest.approx(work, rel=0.02)


@either
def test_what_is_dragged_sticks_until_the_limit_and_then_slips_at_it(make):
    """Coulomb: force = min(k u, mu N), and back along the same line, 2 mu N lower.

    The force is that of the whole contact in a motion of one side; what it does is the power.
    """
    term, points, state, moved = begun(make)
    along = np.zeros_like(points)
    along[0 if make is on_planes else 2] = moved
    knots = term._contact.surface.knots(along)

    def rates():
        """How fast the contacts slide in that motion."""
        of = state.contacts
        rate = np.einsum("pi,pic->pc", of.weights, knots[of.stencils])
        return np.linalg.norm(rate - np.sum(rate * of.direction, 1)[:, None] * of.direction, axis=1)

    slid = MU * state.contacts.force.max() / term.stiffness  # where the last contact slips
    step = slid / 10

    def drag(way):
        nonlocal points, state
        points = points + way * along
        state = term.evolved(points, state)
        return np.sum(force_of(term, points, state)[1] * along)

    stick = term.stiffness * np.sum(rates() ** 2)
    assert drag(1e-4 * step) == pytest.approx(1e-4 * step * stick, rel=1e-2)
    shares = []  # of the limit
    for _ in range(40):
        force = drag(step)
        limit = MU * state.contacts.force @ rates()
        shares.append(force / limit)
    assert np.diff(shares).min() > -1e-3 and max(shares) < 1 + 1e-9
    assert shares[0] < 0.96 and shares[-1] > 0.999
    spent = state.spent
    drag(step)
    assert state.spent - spent == pytest.approx(limit * step, rel=2e-2)
    before, little = drag(0.0), -1e-3 * MU * state.contacts.force.min() / term.stiffness
    assert drag(little) - before == pytest.approx(little * stick, rel=0.05)
    for _ in range(40):
        force = drag(-step)
    assert force == pytest.approx(-MU * state.contacts.force @ rates(), rel=1e-3)


# --- in a crumple --------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    path = tmp_path_factory.mktemp("rubbing") / "crumple.nc"
    study = study_with(
        contact=BARRIER | {"friction": MU},
        sweep=WIDE,
        mesh={"element_size_mm": 14},
        relaxation={"ramp_steps": 300},
    )
    crumple_job(study.crumple_task(study.cells()[0]), path)
    return path


WIDE = {"thickness_um": [500], "overlength_percent": [120], "realisations": 1}


def test_a_crumple_that_rubs_rests_with_the_law_held(record):
    values, attributes = read_record(record)
    assert attributes["status"] == "converged", attributes["message"]
    assert values["work_spent"] == values["contact_friction_work"] > 0
    assert values["contact_pairs"] > 0
    assert 0 <= values["contact_friction_slipping_share"] <= 1
    crumpled = Crumpled.recorded(record)
    problem, points, force = crumpled.problem(), crumpled.points, np.empty_like(crumpled.points)
    energies = dict(zip(problem.energy_names, problem.force(points, force), strict=True))
    assert energies["friction"] == pytest.approx(float(values["friction_energy"]), rel=1e-9)
    rings = np.linalg.norm(np.concatenate([force[:, :2], force[:, -2:]], axis=1))
    assert np.linalg.norm(force[:, 2:-2]) < 1e-8 * rings
    term, state = problem.terms[-1], problem.state[-1]
    now = term.evolved(points, state)
    held, limit = pulls(term, now, points), MU * now.contacts.force
    assert (held <= limit * (1 + 1e-6)).all() and held.max() > 0
    assert now.spent == pytest.approx(state.spent, rel=1e-9)


def test_sticking_contacts_stiffen_what_the_barrier_alone_leaves_free(record):
    crumpled = Crumpled.recorded(record)
    problem, points = crumpled.problem(), crumpled.points
    smooth = Problem(*problem.terms[:-1])
    smooth.force(points, np.empty_like(points))
    sticking = problem.tangent(points) - smooth.tangent(points)
    way = np.random.default_rng(0).standard_normal((20, sticking.shape[0]))
    assert np.einsum("ni,ni->n", way, (sticking @ way.T).T).min() > 0
    assert (prestressed_stiffness(problem, points) > prestressed_stiffness(smooth, points)).all()


def test_on_a_finer_mesh_contacts_begin_anew(record):
    """Their knots are those of the mesh on which they closed."""
    crumpled = Crumpled.recorded(record)
    assert len(crumpled.problem().state[-1]) > 0
    assert len(crumpled.refined().problem().state[-1]) == 0
    with pytest.raises(Refusal, match="contacts that rub held on the mesh of the crumple"):
        crumpled.refined().settled()


def test_what_a_recorded_crumple_knows_of_its_contacts_needs_no_force(record):
    values, _ = read_record(record)
    numbers = Crumpled.recorded(record).problem().numbers()
    assert numbers["contact_pairs"] == values["contact_pairs"] > 0
    assert numbers["contact_share"] == values["contact_share"]
    assert numbers["contact_gap_min"] == pytest.approx(float(values["contact_gap_min"]), rel=1e-9)


def test_a_foil_that_touches_nothing_is_recorded_and_read_back(tmp_path):
    part = {"kind": "barrier", "friction": MU, "ring_planes": True}
    config = study_with(contact=part, sweep={"thickness_um": [500], "reference_height_mm": [140]})
    path = tmp_path / "crumple.nc"
    crumple_job(config.crumple_task(config.cells()[0]), path)
    values, attributes = read_record(path)
    assert attributes["status"] == "converged", attributes["message"]
    assert values["contact_pairs"] == values["contact_friction_work"] == 0
    assert np.isnan(values["contact_friction_slipping_share"])
    problem = Crumpled.recorded(path).problem()
    assert [len(state) for state in problem.state[-2:]] == [0, 0]


def test_without_friction_there_is_no_such_term():
    section = flattened()[0].section
    assert [type(term) for term in BarrierContact().terms(section)] == [SelfContact]
    assert len(BarrierContact(friction=MU, ring_planes=True).terms(section)) == 4
    assert "contact.friction is given" in refusal(contact={"friction": 0.3})
