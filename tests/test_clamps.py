"""Clamps that let the foil slip: against closed forms, their invariants, and in a crumple."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import FEP, FOIL, rotation

from foilstudy.base.errors import Refusal
from foilstudy.base.record import read_record
from foilstudy.base.spec import dumped, loaded
from foilstudy.config import load_config
from foilstudy.config.foils import foil_of
from foilstudy.measure.verdicts import Evidence
from foilstudy.measure.verdicts.evidence import Way, work_over_energy
from foilstudy.model.contact.options import BarrierContact
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.patch import RING_ROWS, Patch, cylinder_control_points, refine
from foilstudy.model.shell.shell import Shell
from foilstudy.model.specimen import Clamps, Specimen
from foilstudy.model.supports.grip import Grip
from foilstudy.model.supports.moves import Move
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.evidence import evidence_of
from foilstudy.pipeline.lesser import crumple_lesser
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.spring_back import sprung_back
from foilstudy.solve.paths.installation import InstallationPath
from foilstudy.solve.paths.newton import NewtonPath
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.loop import Ramp, StoppingRule, relax
from foilstudy.solve.relaxation.scheme import Scheme
from foilstudy.study.sweep.crumple import crumple_job, values_of

COARSE, QUICK = Mesh(20e-3), Method(RelaxationPath(ramp_steps=400))
RINGS = slice(0, RING_ROWS), slice(-RING_ROWS, None)
RADIUS, GRIP = 0.1, 1000.0


def cylinder():
    patch = Patch.for_cylinder(2 * RADIUS, 0.15, 20e-3)
    return Shell.elastic(patch, cylinder_control_points(patch, 2 * RADIUS), FEP, 500e-6)


def crumpled(clamps, method=QUICK):
    foil = replace(FOIL, specimen=Specimen(clamps=clamps))
    return crumple(foil, COARSE, Imperfection(seed=3), method)


def grip_width(shape):
    """Of the rim that a column of control points stands for, m."""
    return shape.patch.size_around


def force_at(problem, points):
    force = np.empty_like(points)
    problem.force(points, force)
    return force


# --- closed forms --------------------------------------------------------------------------------


def pulled(slip, way):
    """A straight cylinder, its top ring pulled up: force on it, what has slipped, and the work."""
    shell = cylinder()
    problem = Problem(shell, *([Grip(shell, slip, GRIP)] if slip else []))
    rule = StoppingRule(1e-4, 4000)
    found = relax(problem, Scheme().start(problem), Ramp(-way, 200), rule)
    assert found.status == "converged", found.message
    force = force_at(problem, found.points)[2, -RING_ROWS:].sum()
    return force, problem.state[1] if slip else None


def test_a_cylinder_pulled_apart_slips_by_what_it_need_not_stretch():
    """Up to the grip it stretches; then it slips at that force; at the stops it stretches on."""
    limit, stop = GRIP * 2 * np.pi * RADIUS, 0.2e-3
    yields_at = 0.1e-3 * limit / pulled(0.0, 0.1e-3)[0]
    force, held = pulled(stop, 0.5 * yields_at)
    assert force == pytest.approx(0.5 * limit, rel=0.01) and not held.out.any()
    for over in (0.2e-3, 0.6e-3):
        force, slipped = pulled(stop, yields_at + over)
        way = min(over, 2 * stop)
        assert slipped.out.sum(axis=0).mean() == pytest.approx(way, rel=0.03)
        assert np.ptp(slipped.out, axis=1).max() <= 1e-3 * stop  # alike all around
        assert slipped.work == pytest.approx(limit * slipped.out.sum(axis=0).mean(), rel=1e-6)
        assert force == pytest.approx(limit * (1 + (over - way) / yields_at), rel=0.02)


def test_work_of_a_slow_ring_is_what_is_stored_and_what_the_clamps_use_up():
    """As much of either: pulled twice as far as the cylinder bears without slip."""
    problem = Problem(shell := cylinder(), Grip(shell, 1e-3, GRIP))
    ramp, rule = Ramp(-0.6e-3, 3000), StoppingRule(1e-4, 4000)
    found = relax(problem, Scheme().start(problem), ramp, rule)
    history, stored = found.history, problem.value(found.points)
    assert problem.work_spent() == pytest.approx(stored, rel=0.1)
    way = Way(history.step, history.height, history.reaction_force, history.kinetic_energy)
    assert work_over_energy(way, stored + problem.work_spent()) == pytest.approx(1, abs=0.03)


# --- invariants ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def at_work():
    """A grip and a deformed shape, with the forces of the shell on it."""
    shell = cylinder()
    rng = np.random.default_rng(0)
    points = shell.reference + 1e-3 * rng.standard_normal(shell.reference.shape)
    points[:, RINGS[0]], points[:, RINGS[1]] = (shell.reference[:, ring] for ring in RINGS)
    force = np.empty_like(points)
    shell.force(points, force)
    return shell, Grip(shell, 0.3e-3, GRIP), points, force


def test_slipping_uses_up_work_and_takes_more_out_of_the_foil(at_work):
    shell, grip, points, force = at_work
    points, force, state = points.copy(), force.copy(), grip.start()
    energy, work = shell.energies(points).total, 0.0
    for _ in range(30):
        before = points.copy()
        state = grip.given_way(points, force, state, at_rest=True)
        assert np.array_equal(points[:, RING_ROWS:-RING_ROWS], before[:, RING_ROWS:-RING_ROWS])
        assert np.abs(state.out).max() <= 0.3e-3
        assert state.work >= work
        here = shell.energies(points).total
        assert energy - here >= 0.7 * (state.work - work)
        energy, work = here, state.work
        shell.force(points, force)
    assert work > 0 and 0.2 < np.mean(np.abs(state.out) == 0.3e-3) < 1
    for ring, sign, out in zip(RINGS, (1, -1), state.out, strict=True):
        moved = points[:, ring] - shell.reference[:, ring]
        np.testing.assert_allclose(moved[2], np.stack([sign * out] * 2), atol=1e-15)
        assert np.abs(moved[:2]).max() < 1e-15  # along the generators, and nothing else


def test_a_rigid_motion_changes_nothing(at_work):
    _, grip, points, force = at_work
    turn = rotation([1, 2, 3], 0.7)

    def turned(field):
        return np.ascontiguousarray(np.einsum("ij,jrc->irc", turn, field))

    here, there = points.copy(), turned(points) + 0.3
    state = grip.given_way(here, force, grip.start(), True)
    again = grip.given_way(there, turned(force), grip.start(), True)
    assert state.out.any()
    np.testing.assert_allclose(again.out, state.out, rtol=1e-9, atol=1e-15)
    assert np.abs(there - turned(here) - 0.3).max() < 1e-12
    unheld = grip.unheld(points, force, grip.start())
    assert grip.unheld(there, turned(force), grip.start()) == pytest.approx(unheld, rel=1e-9)


def test_what_it_bears_does_not_slip(at_work):
    shell, _, points, force = at_work
    firm = Grip(shell, 1e-3, 1e9)
    here = points.copy()
    assert firm.given_way(here, force, firm.start(), True).work == 0
    assert np.array_equal(here, points) and firm.unheld(points, force, firm.start()) == 0


def test_a_finer_mesh_has_slipped_as_the_coarse_one(at_work):
    """Knot insertion of the rings with what has slipped: the same curves."""
    shell, grip, points, force = at_work
    state = grip.given_way(here := points.copy(), force, grip.start(), True)
    finer = grip.restored(grip.split(state))
    assert finer.out.shape == (2, 2 * shell.patch.columns) and finer.work == state.work
    moved = (refine(here) - refine(points))[2]
    for ring, sign, out in zip(RINGS, (1, -1), finer.out, strict=True):
        np.testing.assert_allclose(moved[ring], np.stack([sign * out] * 2), atol=1e-15)


# --- in a crumple --------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def slipped():
    return crumpled(Clamps(slip=1e-3, grip=600.0))


def test_a_grip_out_of_reach_changes_no_bit(slipped):
    held, firm = crumpled(Clamps()), crumpled(Clamps(slip=1e-3, grip=1e9))
    assert np.array_equal(held.points, firm.points)
    assert not np.array_equal(held.points, slipped.points)


def test_a_crumple_rests_in_clamps_that_slip(slipped):
    assert slipped.status == "converged", slipped.message
    problem = slipped.problem()
    state = problem.state[1]
    assert 0 < np.abs(state.out).max() <= 1e-3 and state.work > 0
    force = force_at(problem, slipped.points)
    stopped = np.abs(state.out) == 1e-3
    line_force = np.stack([force[2, ring].sum(axis=0) for ring in RINGS]) / grip_width(slipped)
    assert np.mean(stopped) < 0.5
    assert 500 < np.abs(line_force[~stopped]).max() <= 600 * 1.03
    rings = [force[:, ring].sum(axis=(1, 2)) for ring in RINGS]
    assert np.abs(sum(rings)).max() < 1e-6 * np.abs(rings[0]).max()  # they balance
    flat = slipped.points[2, -RING_ROWS:] + state.out[1]
    assert np.ptp(flat, axis=1).max() < 1e-12
    assert flat.mean() == pytest.approx(FOIL.gap_height, rel=1e-9)
    again = slipped.settled()
    assert (again.arrival.steps, again.arrival.hessians) == (0, 0)
    assert loaded(Foil, dumped(slipped.foil)) == slipped.foil


def height_of_ring(shape):
    """Where its control points were without slip: all at one height, so this is the ring's, m."""
    flat = shape.points[2, -RING_ROWS:] + shape.problem().state[1].out[1]
    assert np.ptp(flat, axis=1).max() < 1e-12
    return flat.mean()


def test_what_the_clamps_have_used_up_is_no_loss_on_the_way(slipped):
    """Live and of a record alike; a record that does not tell it is read without."""
    live = evidence_of(slipped, slipped.arrival).work_over_energy
    values = values_of(slipped)
    assert values["work_spent"] == values["clamp_work"] > 0
    assert Evidence.of(slipped.status, values).work_over_energy == pytest.approx(live, rel=1e-9)
    del values["work_spent"]
    assert Evidence.of(slipped.status, values).work_over_energy > 1.01 * live


def test_a_ring_that_turns_keeps_what_has_slipped():
    moves = (Move(shorten=0.9, tilt=0.05), Move(shorten=1.05, tilt=-0.03))
    path = InstallationPath(ramp_steps=300, moves=moves)
    fitted = crumpled(Clamps(slip=1e-3, grip=600.0), Method(path))
    assert fitted.status == "converged", fitted.message
    out = fitted.arrival.state[1].out[1]
    assert np.ptp(out) > 1e-4
    # about its own centre, so that it stands upright and in the middle again
    assert height_of_ring(fitted) == pytest.approx(FOIL.gap_height, abs=1e-12)
    assert np.abs((fitted.points - fitted.reference)[:2, -RING_ROWS:]).max() < 1e-12


def test_a_ring_that_is_let_go_stands_elsewhere_than_what_has_slipped(slipped):
    free = sprung_back(slipped)
    assert free.status == "converged"
    assert free.height == pytest.approx(height_of_ring(free.foil), abs=1e-9)
    assert abs(free.height - free.foil.points[2, -RING_ROWS:].mean()) > 1e-4


def test_a_ring_that_was_let_go_comes_back_to_the_gap():
    path = InstallationPath(ramp_steps=200, moves=(Move(shorten=1.0), Move(release=True)))
    fitted = crumpled(Clamps(slip=1e-3, grip=600.0), Method(path))
    assert fitted.status == "converged", fitted.message
    assert height_of_ring(fitted) == pytest.approx(FOIL.gap_height, abs=1e-9)
    history = fitted.arrival.history
    joined = np.diff(history.step) == 0  # where a part of the way ends and the next begins
    assert joined.sum() >= 2 and np.abs(np.diff(history.height)[joined]).max() < 1e-9


def test_a_record_keeps_what_has_slipped(tmp_path):
    """From a configuration to a record and back, and to a finer mesh."""
    study = load_config(
        {
            "specimen": {"clamp_slip_mm": 1, "clamp_grip_n_per_m": 600},
            "sweep": {"thickness_um": [500], "reference_height_mm": [170]},
            "mesh": {"element_size_mm": 20},
            "relaxation": {"ramp_steps": 400},
        }
    )
    task = study.crumple_task(study.cells()[0])
    assert foil_of(task).specimen.clamps == Clamps(slip=1e-3, grip=600)
    assert study.beyond_elastic
    crumple_job(task, tmp_path / "crumple.nc")
    values, attributes = read_record(tmp_path / "crumple.nc")
    assert attributes["status"] == "converged", attributes["message"]
    back = Crumpled.recorded(tmp_path / "crumple.nc")
    (state,) = (each for each in back.problem().state if each is not None)
    assert np.array_equal(values["clamp_slip"], state.out)
    assert values["clamp_work"] == state.work > 0
    assert values["clamp_slip_max"] == np.abs(state.out).max() > 0
    assert back.settled().arrival.hessians == 0
    split = back.refined().problem().state[1]
    assert split.work == state.work and split.out.mean() == pytest.approx(state.out.mean())


# --- what does not go together -------------------------------------------------------------------


@pytest.mark.parametrize(
    "clamps, method, words",
    [
        (Clamps(slip=1e-3), Method(NewtonPath()), "holds the edges"),
        (Clamps(slip=9e-3), QUICK, "lets the foil slip by 9 mm"),
        (
            Clamps(slip=1e-3),
            replace(QUICK, contact=BarrierContact(ring_planes=True)),
            "planes of the rings",
        ),
    ],
)
def test_what_does_not_go_with_slip_is_refused(clamps, method, words):
    with pytest.raises(Refusal, match=words):
        uncrumpled(replace(FOIL, specimen=Specimen(clamps=clamps)), COARSE, None, method)


def test_models_that_would_not_slip_refuse_it():
    with pytest.raises(Refusal, match="knows no clamps"):
        slipping = replace(FOIL, specimen=Specimen(clamps=Clamps(slip=1e-3)))
        crumple_lesser("mass_spring", slipping, COARSE, None, QUICK)
    with pytest.raises(Refusal):
        Clamps(slip=-1e-3)


@pytest.mark.parametrize(
    "sections, words",
    [
        ({"specimen": {"clamp_grip_n_per_m": 500}}, "nothing slips"),
        ({"specimen": {"clamp_slip_mm": 20}}, "clamp_slip_mm lets the foil slip"),
        ({"specimen": {"clamp_slip_mm": 1}, "method": {"path": "newton"}}, "holds the edges"),
        (
            {
                "specimen": {"clamp_slip_mm": 1},
                "contact": {"kind": "barrier", "ring_planes": True},
            },
            "three points of each edge",
        ),
    ],
)
def test_a_configuration_that_does_not_fit_is_refused(sections, words):
    with pytest.raises(ValueError, match=words):
        load_config({"sweep": {"thickness_um": [500], "reference_height_mm": [170]}, **sections})
