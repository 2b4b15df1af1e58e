"""Creases that relax: stress that falls in a held shape, and what that does to the stiffness."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import FEP, FOIL

from foilstudy.base.errors import Refusal
from foilstudy.base.record import read_record
from foilstudy.config import ConfigError, load_config
from foilstudy.measure.verdicts import Evidence
from foilstudy.model.contact.options import BarrierContact
from foilstudy.model.foil import Imperfection
from foilstudy.model.materials import RELAXATION_ONSET
from foilstudy.model.patch import RING_ROWS
from foilstudy.model.specimen import Specimen
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.evidence import seen_in
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.rest import Rest
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.study.sweep.crumple import _numbers, crumple_job, values_of

HOUR, DAY = 3600.0, 86400.0
RELAXING = replace(FEP, relaxation_per_decade=0.1)


@pytest.fixture(scope="module", params=["elastic", "plastic"])
def fitted(request):
    foil = replace(FOIL, material=replace(RELAXING, law=request.param))
    return crumple(foil, Mesh(20e-3), Imperfection(seed=3), Method(RelaxationPath(ramp_steps=400)))


def forces(crumpled):
    out = np.empty_like(crumpled.points)
    energies = crumpled.problem().force(crumpled.points, out)
    return energies.sum(), out


def test_the_law_is_logarithmic():
    kept = [RELAXING.stress_kept(RELAXATION_ONSET * (10**n - 1)) for n in range(4)]
    np.testing.assert_allclose(kept, [1.0, 0.9, 0.8, 0.7])
    assert RELAXING.stress_kept(1e30) == 0.0 and FEP.stress_kept(DAY) == 1.0


def test_without_waiting_nothing_changes(fitted):
    assert fitted.waited(0.0) is fitted and fitted.stress_kept == 1.0


def test_forces_and_energy_fall_by_the_share_and_the_shape_rests_on(fitted):
    energy, force = forces(fitted)
    before = 1.0
    for hours in (1.0, 24.0, 1000.0):
        rested = fitted.waited(hours * HOUR)
        share = rested.stress_kept
        assert 0 < share < before
        before = share
        now, less = forces(rested)
        assert now == pytest.approx(share * energy, rel=1e-12)
        np.testing.assert_allclose(less, share * force, atol=1e-10 * np.abs(force).max())
    again = rested.settled()
    assert again.status == "converged" and again.arrival.hessians == 0
    assert np.abs(again.points - rested.points).max() < 1e-12


def test_the_stiffness_goes_from_the_stressed_to_the_stress_free_one(fitted):
    stressed, free = fitted.prestressed_stiffness(), fitted.stiffness()
    rested = [fitted.waited(t).prestressed_stiffness() for t in (HOUR, DAY, 1000 * HOUR)]
    levels = np.array([stressed, *rested, free])
    assert (np.diff(levels, axis=0) > 0).all()
    all_gone = replace(fitted, rest=Rest(1e-9, fitted.points))
    np.testing.assert_allclose(all_gone.prestressed_stiffness(), free, rtol=1e-6)


def test_what_has_rested_resists_by_its_tangent(fitted):
    """The force away from the shape is that of both shares, old and new."""
    rested = fitted.waited(DAY)
    problem, points = rested.problem(), rested.points.copy()
    pull, settling = 5e-6, rested.method.path
    force = forces(rested)[1][2, -RING_ROWS:].sum()
    points[2, -RING_ROWS:] += pull
    arrived = settling.settle(problem, points)
    assert arrived.status == "converged", arrived.message
    moved = replace(rested, points=arrived.points, arrival=arrived)
    secant = (forces(moved)[1][2, -RING_ROWS:].sum() - force) / pull
    assert secant == pytest.approx(rested.prestressed_stiffness()[0], rel=0.01)


def test_it_goes_on_to_a_finer_mesh(fitted):
    finer = fitted.waited(DAY).refined()
    settled = finer.settled()
    assert settled.status == "converged", settled.message
    assert settled.stress_kept == fitted.waited(DAY).stress_kept


def test_a_study_waits(tmp_path):
    study = load_config(
        {
            "material": {"law": "plastic", "relaxation_per_decade": 0.1},
            "installation": {"waiting_hours": 24},
            "sweep": {"thickness_um": [500], "reference_height_mm": [170]},
            "mesh": {"element_size_mm": 20},
            "relaxation": {"ramp_steps": 400},
        }
    )
    assert study.beyond_elastic
    crumple_job(study.crumple_task(study.cells()[0]), tmp_path / "crumple.nc")
    values, _ = read_record(tmp_path / "crumple.nc")
    expected = 1 - 0.1 * np.log10(1 + DAY / RELAXATION_ONSET)
    assert values["stress_kept"] == pytest.approx(expected)
    back = Crumpled.recorded(tmp_path / "crumple.nc")
    energy, force = forces(back)
    assert back.stress_kept == values["stress_kept"]
    assert values["reaction_force"] == -force[2, -RING_ROWS:].sum()
    parts = ("membrane", "bending", "stabilisation", "plastic_relief", "renewed")
    assert energy == pytest.approx(sum(values[f"{name}_energy"] for name in parts))


@pytest.mark.parametrize(
    ("sections", "sentence"),
    [
        ({"installation": {"waiting_hours": 1}}, "without material.relaxation_per_decade nothing"),
        ({"material": {"relaxation_per_decade": 0.1}}, "without installation.waiting_hours"),
        ({"material": {"relaxation_per_decade": 1.5}}, "out of range"),
    ],
)
def test_half_of_it_is_refused(sections, sentence):
    sweep = {"thickness_um": [500], "reference_height_mm": [150]}
    with pytest.raises(ConfigError, match=sentence):
        load_config({"sweep": sweep} | sections)


def test_negative_time_is_refused():
    with pytest.raises(Refusal, match="waiting time of a method"):
        Method(waiting=-1.0)


def test_waiting_takes_back_nothing_that_was_done(fitted):
    waited = replace(fitted, recipe=replace(fitted.recipe, method=Method(waiting=DAY))).waited(DAY)
    before, after = _numbers(fitted), _numbers(waited)
    assert after["reaction_force"] < 0.8 * before["reaction_force"]
    for name in ("dissipated_work", "work_spent"):
        assert after.get(name) == before.get(name)
    assert seen_in(waited, waited.arrival) == seen_in(fitted, fitted.arrival)
    of_record = [
        Evidence.of(each.status, values_of(each)).work_over_energy for each in (fitted, waited)
    ]
    assert of_record[1] == pytest.approx(of_record[0], rel=1e-9)


def test_what_carries_a_weight_cannot_wait():
    heavy = replace(FOIL, material=RELAXING, specimen=Specimen(gravity=9.81))
    with pytest.raises(Refusal, match="weight of the foil"):
        crumple(heavy, Mesh(20e-3), method=Method(waiting=DAY))
    with pytest.raises(Refusal, match="weight of the foil"):
        uncrumpled(heavy, Mesh(20e-3)).waited(DAY)


# --- foil that touches itself --------------------------------------------------------------------

TALL = replace(FOIL, reference_height=2.2 * FOIL.gap_height, material=RELAXING)
RUBBING = {
    "material": {"law": "plastic", "relaxation_per_decade": 0.1},
    "installation": {"waiting_hours": 8760},
    "sweep": {"thickness_um": [500], "reference_height_mm": [250]},
    "mesh": {"element_size_mm": 12},
    "relaxation": {"ramp_steps": 800},
    "contact": {"kind": "barrier", "friction": 0.3},
}


def pressed_by(crumpled):
    """Force of the contacts, fresh ones at their full strength, in a shape."""
    return sum(each.pressing_at(crumpled.points).force.sum() for each in crumpled.contacts())


@pytest.fixture(scope="module")
def rubbing(tmp_path_factory):
    path = tmp_path_factory.mktemp("waiting") / "crumple.nc"
    study = load_config(RUBBING)
    crumple_job(study.crumple_task(study.cells()[0]), path)
    return path


def test_a_plastic_foil_that_rubs_waits_a_year(rubbing):
    values, attributes = read_record(rubbing)
    assert attributes["status"] == "converged", attributes["message"]
    assert values["equilibrium_residual"] <= 1e-8 and values["negative_eigenvalues"] == 0
    assert values["self_crossing_share"] == 0 and values["contact_gap_min"] > 0
    back = Crumpled.recorded(rubbing)
    energy, force = forces(back)
    parts = ("contact", "friction", "membrane", "bending", "stabilisation", "plastic_relief")
    told = sum(float(values[f"{name}_energy"]) for name in (*parts, "renewed"))
    assert energy == pytest.approx(told, rel=1e-9)
    assert float(values["reaction_force"]) == pytest.approx(-force[2, -RING_ROWS:].sum(), rel=1e-9)
    before = back.before_waiting()
    kept = float(values["stress_kept"])
    assert kept < pressed_by(back) / pressed_by(before) < 1
    # action is reaction: no force and no moment is left over
    assert np.abs(force.sum(axis=(1, 2))).max() < 1e-8 * np.abs(force).max()
    moment = np.cross(back.points.reshape(3, -1).T, force.reshape(3, -1).T).sum(axis=0)
    assert np.abs(moment).max() < 1e-8 * np.abs(force).max() * back.foil.diameter


def test_friction_keeps_its_law_while_the_foil_waits(rubbing):
    crumpled = Crumpled.recorded(rubbing)
    problem, points = crumpled.problem(), crumpled.points
    place = problem.energy_names.index("friction") - len(problem.energy_names)
    term, state = problem.terms[place], problem.state[place]
    now = term.evolved(points, state)
    held = term.stiffness * np.linalg.norm(now.stretched, axis=1)
    assert (held <= 0.3 * now.contacts.force * (1 + 1e-6)).all() and held.max() > 0
    assert now.spent == pytest.approx(state.spent, rel=1e-9)


@pytest.fixture(scope="module")
def touching():
    way = RelaxationPath(ramp_steps=400)
    return crumple(TALL, Mesh(14e-3), method=Method(way, contact=BarrierContact()))


def test_a_foil_of_other_modulus_waits_in_the_same_shape(touching):
    stiffer = replace(RELAXING, youngs_modulus=3 * RELAXING.youngs_modulus)
    other = replace(touching, foil=replace(TALL, material=stiffer))
    one, three = touching.waited(DAY), other.waited(DAY)
    assert one.status == three.status == "converged"
    assert np.abs(one.points - touching.points).max() > 1e-5
    np.testing.assert_allclose(three.points, one.points, atol=1e-9)
    force, tripled = forces(one)[1], forces(three)[1]
    np.testing.assert_allclose(tripled, 3 * force, atol=1e-6 * np.abs(force).max())


def test_contacts_and_forces_fall_as_time_goes_by(touching):
    rested = [touching.waited(hours * HOUR) for hours in (1.0, 1000.0)]
    pressed = [pressed_by(each) for each in (touching, *rested)]
    assert pressed == sorted(pressed, reverse=True)
    kept = np.array([each.stress_kept for each in rested])
    assert (np.array(pressed[1:]) > kept * pressed[0]).all()
    stiffness = [each.prestressed_stiffness() for each in (touching, *rested)]
    assert (np.diff(stiffness, axis=0) > 0).all()
    again = rested[0].waited(1000 * HOUR)  # since it came to rest
    assert np.array_equal(again.points, rested[1].points)


def test_where_nothing_touches_contact_changes_nothing(fitted):
    near = replace(fitted, recipe=replace(fitted.recipe, method=Method(contact=BarrierContact())))
    with_contact, without = near.waited(DAY), fitted.waited(DAY)
    assert np.array_equal(with_contact.points, without.points)
    assert np.array_equal(forces(with_contact)[1], forces(without)[1])
    stiffness = [each.prestressed_stiffness() for each in (with_contact, without)]
    assert np.array_equal(*stiffness)
