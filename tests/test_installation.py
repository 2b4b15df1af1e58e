"""The way a foil is fitted: stops of the ring before it comes to the gap."""

import numpy as np
import pytest

from foilstudy.config import ConfigError, load_config
from foilstudy.config.scene import recipe_of
from foilstudy.model.foil import Imperfection
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.paths.installation import InstallationPath
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.study.published import foil

FOIL, MESH = foil(500, 150), Mesh(15e-3)
SWEEP = {"thickness_um": [500], "reference_height_mm": [150]}


def fitted(*stages):
    path = InstallationPath(ramp_steps=400, stages=stages)
    return crumple(FOIL, MESH, Imperfection(), Method(path=path))


def test_without_stops_it_is_the_relaxation_to_the_last_bit():
    plain = crumple(FOIL, MESH, Imperfection(), Method(path=RelaxationPath(ramp_steps=400)))
    fit = fitted()
    assert np.array_equal(fit.points, plain.points)
    assert np.array_equal(fit.arrival.history.reaction_force, plain.arrival.history.reaction_force)
    assert fit.arrival.steps == plain.arrival.steps


def test_the_ring_comes_to_each_stop_and_ends_at_the_gap():
    crumpled = fitted(1.25, 0.9)
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
    straight, back = fitted(), fitted(1.25)
    assert back.status == "converged"
    assert np.abs(back.points - straight.points).max() > 1e-3
    assert np.allclose(back.points[:, -1], straight.points[:, -1], atol=1e-12)


def test_a_configuration_chooses_the_stops():
    sections = {"sweep": SWEEP, "mesh": {"element_size_mm": 15}, "method": {"path": "installation"}}
    study = load_config(sections | {"installation": {"stops_percent": [125.0, 90.0]}})
    (cell, *_) = study.cells()
    path = recipe_of(study.crumple_task(cell)).method.path
    assert path.stages == (1.25, 0.9) and path.ramp_steps == 2000


@pytest.mark.parametrize(
    ("sections", "sentence"),
    [
        ({"installation": {"stops_percent": [125.0]}}, "method.path is relaxation, which has no"),
        ({"method": {"path": "installation"}}, "stops_percent is not given; give stops"),
        (
            {"method": {"path": "installation"}, "installation": {"stops_percent": [900.0]}},
            r"stops_percent\[0\] is 900 %, with rings -30 mm apart",
        ),
    ],
)
def test_stops_that_make_no_sense_are_refused(sections, sentence):
    with pytest.raises(ConfigError, match=sentence):
        load_config({"sweep": SWEEP} | sections)
