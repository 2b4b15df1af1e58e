"""The way a foil is fitted: what the ring does before it comes to the gap."""

from dataclasses import replace

import numpy as np
import pytest

from foilstudy.base.errors import Refusal
from foilstudy.base.spec import dumped, loaded
from foilstudy.config import ConfigError, load_config
from foilstudy.config.scene import recipe_of
from foilstudy.config.sections import Installation
from foilstudy.model.foil import Imperfection
from foilstudy.model.supports.attitude import Attitude
from foilstudy.model.supports.moves import Move
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.paths.installation import InstallationPath
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.solve.relaxation.turning import Turning
from foilstudy.study.published import foil

FOIL, MESH = foil(500, 150), Mesh(15e-3)
SWEEP = {"thickness_um": [500], "reference_height_mm": [150]}


def fitted(*moves, law="elastic", steps=400):
    path = InstallationPath(ramp_steps=steps, moves=moves)
    made = replace(FOIL, material=replace(FOIL.material, law=law))
    return crumple(made, MESH, Imperfection(), Method(path=path))


def test_without_stops_it_is_the_relaxation_to_the_last_bit():
    plain = crumple(FOIL, MESH, Imperfection(), Method(path=RelaxationPath(ramp_steps=400)))
    fit = fitted()
    assert np.array_equal(fit.points, plain.points)
    assert np.array_equal(fit.arrival.history.reaction_force, plain.arrival.history.reaction_force)
    assert fit.arrival.steps == plain.arrival.steps


def test_the_ring_comes_to_each_stop_and_ends_at_the_gap():
    crumpled = fitted(Move(1.25), Move(0.9))
    assert crumpled.status == "converged" and crumpled.arrival.negative_eigenvalues == 0
    history = crumpled.arrival.history
    assert np.all(np.diff(history.step) >= 0)
    way = 0.150 - np.array(history.height)
    turns = np.flatnonzero(np.diff(np.sign(np.diff(way[np.r_[True, np.diff(way) != 0]]))))
    assert len(turns) == 2
    assert way.max() == pytest.approx(1.25 * FOIL.shortening, rel=1e-9)
    assert way[-1] == pytest.approx(FOIL.shortening, rel=1e-9)
    assert crumpled.points[2, -2:].mean() == pytest.approx(FOIL.gap_height, rel=1e-9)


def test_what_was_pushed_further_is_another_equilibrium_of_the_same_gap():
    straight, back = fitted(), fitted(Move(1.25))
    assert back.status == "converged"
    assert np.abs(back.points - straight.points).max() > 1e-3
    assert np.allclose(back.points[:, -1], straight.points[:, -1], atol=1e-12)


def ring_of(points):
    """The top ring as a rigid body: centre and rotation, and by how much it is none."""
    arms = FITTED.reference[:, -2:].reshape(3, -1) - [[0.0], [0.0], [FOIL.reference_height]]
    ring = points[:, -2:].reshape(3, -1)
    centre = ring.mean(axis=1, keepdims=True)
    left, _, right = np.linalg.svd((ring - centre) @ (arms - arms.mean(axis=1, keepdims=True)).T)
    rotation = left @ right
    rest = ring - centre - rotation @ (arms - arms.mean(axis=1, keepdims=True))
    return centre.ravel(), rotation, np.abs(rest).max()


def height_of_ring(points):
    return points[2, -2:].mean()


FITTED = uncrumpled(FOIL, MESH, Imperfection())


@pytest.mark.parametrize(
    "attitude", [Attitude(tilt=0.05), Attitude(twist=0.1), Attitude(0.02, -0.05, 3e-3)]
)
def test_a_ring_turns_as_a_rigid_body_and_the_sheet_by_its_share(attitude):
    points = FITTED.points.copy()
    share = np.clip(points[2].mean(axis=1) / FOIL.reference_height, 0, 1)
    share[:2], share[-2:] = 0.0, 1.0
    turned = Turning(Attitude(), attitude).begun(points, share, height_of_ring)
    ways = np.linspace(0, 1, 50)
    for before, after in zip(ways[:-1], ways[1:]):
        turned.move(points, before, after)
    centre, rotation, deformed = ring_of(points)
    assert deformed < 1e-14
    np.testing.assert_allclose(rotation, attitude.rotation, atol=1e-12)
    assert centre[0] == pytest.approx(attitude.shift, abs=1e-12)
    assert np.array_equal(points[:, :2], FITTED.points[:, :2])
    middle = points.shape[1] // 2
    moved = np.abs(points - FITTED.points).max(axis=(0, 2))
    assert moved[middle] == pytest.approx(0.5 * moved[-1], rel=0.1)
    # and back to where it was
    back = Turning(attitude, Attitude()).begun(points, share, height_of_ring)
    back.move(points, 0.0, 1.0)
    np.testing.assert_allclose(points[:, -2:], FITTED.points[:, -2:], atol=1e-15)


@pytest.mark.parametrize(
    "move", [Move(tilt=0.03), Move(1.1, twist=0.05, shift=2e-3), Move(0.95, cycles=1)]
)
def test_whatever_the_ring_did_it_ends_straight_in_its_gap(move):
    crumpled = fitted(Move(1.0), move)
    assert crumpled.status == "converged", crumpled.message
    where = crumpled.reference[:, -2:].copy()
    where[2] -= FOIL.shortening
    np.testing.assert_allclose(crumpled.points[:, -2:], where, atol=1e-14)


def test_a_foil_that_yields_remembers_how_it_was_fitted():
    straight, tilted = (fitted(*moves, law="plastic") for moves in ((), (Move(1.0, tilt=0.05),)))
    assert tilted.status == "converged", tilted.message
    work = [each.problem().numbers()["dissipated_work"] for each in (straight, tilted)]
    assert work[1] > 1.05 * work[0]


def test_a_ring_that_is_let_go_springs_to_the_free_height():
    """Elastic foil springs back whole, foil that has yielded does not; no force is left there."""
    elastic = fitted(Move(1.0), Move(release=True), steps=200)
    assert elastic.arrival.free_heights == (pytest.approx(FOIL.reference_height, rel=1e-3),)
    plastic = fitted(Move(1.3), Move(release=True), law="plastic", steps=200)
    (height,) = plastic.arrival.free_heights
    assert FOIL.gap_height < height < 0.999 * FOIL.reference_height
    history = plastic.arrival.history
    there = np.isclose(history.height, height, rtol=1e-9)
    assert there.any()
    assert np.abs(history.reaction_force[there]).min() < 0.02 * history.reaction_force.max()


def test_a_path_with_moves_is_recorded():
    path = InstallationPath(moves=(Move(1.25), Move(tilt=0.02, cycles=2), Move(release=True)))
    assert loaded(Method, dumped(Method(path))).path == path


def test_a_configuration_chooses_the_moves():
    sections = {"sweep": SWEEP, "mesh": {"element_size_mm": 15}, "method": {"path": "installation"}}
    moves = [{"shorten_percent": 125, "tilt_mrad": 20}, {"shift_mm": 2, "cycles": 3}]
    study = load_config(sections | {"installation": {"moves": [*moves, {"release": True}]}})
    (cell, *_) = study.cells()
    path = recipe_of(study.crumple_task(cell)).method.path
    assert path.moves == (Move(1.25, 0.02), Move(shift=2e-3, cycles=3), Move(release=True))
    assert path.ramp_steps == 8000 and study.lets_go
    yielding = study.model_copy(update={"installation": Installation()})
    assert not yielding.lets_go


def test_out_of_range_in_python_too():
    with pytest.raises(Refusal, match="move 2 of the installation brings the rings to"):
        fitted(Move(1.0), Move(6.5))


CHOSEN = {"method": {"path": "installation"}}


def moving(*moves):
    return CHOSEN | {"installation": {"moves": list(moves)}}


@pytest.mark.parametrize(
    ("sections", "sentence"),
    [
        ({"installation": {"moves": [{"shorten_percent": 125}]}}, "is relaxation, which has no"),
        (CHOSEN, "moves is not given; give moves such as"),
        (moving({"shorten_percent": 900}), r"moves\[0\] brings the rings to -30 mm from each"),
        (moving({"shorten_percent": -10}), r"moves\[0\] pulls the rims 152 mm apart"),
        (
            moving({"shorten_percent": 100}, {"tilt_mrad": 300}),
            r"moves\[1\] pulls the rims 159.6 mm",
        ),
        (moving({"shorten_percent": 10, "shift_mm": 60}), r"moves\[0\] pulls the rims"),
        (moving({"cycles": 2}), "a move without a place"),
        (moving({"release": True, "tilt_mrad": 3}), "release: true and a place beside it"),
        (moving({"release": 1}), r"moves\[0\].release is 1, not a truth value"),
        (moving({"tilt": 3}), r"moves\[0\].tilt is not a known key; did you mean .*tilt_mrad"),
        (moving({"tilt_mrad": 900}), r"moves\[0\].tilt_mrad is 900, out of range.* 500 mrad"),
    ],
)
def test_moves_that_make_no_sense_are_refused(sections, sentence):
    with pytest.raises(ConfigError, match=sentence):
        load_config({"sweep": SWEEP} | sections)


def test_a_ring_that_does_not_come_free_has_no_free_height(monkeypatch):
    monkeypatch.setattr("foilstudy.solve.paths.release._WAYS_MAX", 1)
    crumpled = fitted(Move(1.0), Move(release=True), steps=200)
    assert crumpled.status == "converged" and np.isnan(crumpled.arrival.free_heights).all()


def test_free_heights_outlast_the_finer_mesh():
    path = InstallationPath(ramp_steps=200, moves=(Move(1.0), Move(release=True)))
    crumpled = crumple(FOIL, Mesh(10e-3, ramp_coarsenings=1), method=Method(path))
    (height,) = crumpled.arrival.free_heights
    assert FOIL.gap_height < height <= FOIL.reference_height * (1 + 1e-9)
