"""Small motions of the ring one way and the other, and cycles until the foil is elastic."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import FEP, FOIL

from foilstudy.base.errors import Refusal
from foilstudy.model.contact.options import BarrierContact
from foilstudy.model.foil import Imperfection
from foilstudy.model.patch import knot_points
from foilstudy.model.shell.intersection import self_crossing_share
from foilstudy.pipeline import one_sided as one_sided_module
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.one_sided import one_sided, snapped
from foilstudy.pipeline.shakedown import shaken_down
from foilstudy.pipeline.spring_back import sprung_back
from foilstudy.solve.paths.minimisation import MinimisationPath
from foilstudy.solve.paths.relaxation import RelaxationPath

COARSE, QUICK = Mesh(20e-3), Method(RelaxationPath(ramp_steps=400))


def crumpled(law, height):
    foil = replace(FOIL, material=replace(FEP, law=law), reference_height=height)
    return crumple(foil, COARSE, Imperfection(seed=3), QUICK)


@pytest.fixture(scope="module")
def virgin():
    return crumpled("plastic", 0.140)


@pytest.fixture(scope="module")
def shaken(virgin):
    return shaken_down(virgin, 2e-3)


def test_a_virgin_state_is_one_sided(virgin, shaken):
    """Pushed further it flows, pulled it is elastic; so is what has gone that far before."""
    new, old = (one_sided(each, "axial", 2e-3) for each in (virgin, shaken.foil))
    assert new.status == old.status == "converged", new.message
    loading, unloading = new.dissipated
    assert loading > 1e-3 * virgin.problem().value(virgin.points) and unloading == 0
    assert max(old.dissipated) < 1e-3 * loading


def test_a_foil_that_snaps_on_the_way_has_no_secant_that_way(virgin, monkeypatch):
    def only_apart(before, after, motion, gained, scale):
        assert not snapped(before, after, motion, gained, scale)
        return motion > 0

    monkeypatch.setattr(one_sided_module, "snapped", only_apart)
    secants = one_sided(virgin)
    assert secants.status == "snapped" and "another equilibrium" in secants.message
    assert np.isnan(secants.unloading) and secants.loading == pytest.approx(
        secants.tangent, rel=0.1
    )


@pytest.mark.parametrize("motion", [1e-5, -1e-5])
@pytest.mark.parametrize(
    ("second", "share", "let_go", "expected"),
    [
        (1.0, 0.5, 0.0, False),  # a straight line
        (100.0, 0.9, 0.0, False),  # parts that touch near the end of the motion
        (100.0, 0.1, 0.0, False),
        (0.01, 0.5, 0.0, False),  # flow
        (1.0, 0.5, 2.0, True),  # of what the straight line stores
        (1.0, 0.5, 0.5, False),
    ],
)
def test_a_snap_is_told_from_a_force_with_a_kink(motion, second, share, let_go, expected):
    """The stiffness is another one from a share of the motion on."""
    first, before = 1e3, 7.0
    there = before + first * share * motion
    after = there + second * first * (1 - share) * motion
    work = 0.5 * (before + there) * share * motion + 0.5 * (there + after) * (1 - share) * motion
    gained = work - let_go * 0.5 * first * motion**2
    assert snapped(before, after, motion, gained, first) == expected


def test_work_per_cycle_falls_until_the_foil_is_elastic(virgin, shaken):
    assert shaken.status == "converged", shaken.message
    assert 2 <= shaken.cycles == len(shaken.reactions) - 1
    assert (shaken.dissipated >= 0).all()
    assert shaken.dissipated[-1] < 1e-2 * shaken.dissipated[0]
    assert shaken.reactions[-1] == pytest.approx(shaken.reactions[-2], rel=1e-3)
    assert np.abs(shaken.foil.points[:, -2:] - virgin.points[:, -2:]).max() < 1e-12


@pytest.mark.parametrize("direction", ["axial", "radial"])
def test_after_shakedown_secants_are_the_tangent(shaken, direction):
    secants = one_sided(shaken.foil, direction)
    assert secants.status == "converged", secants.message
    assert secants.asymmetry < 0.01
    assert max(secants.dissipated) < 1e-9 * shaken.dissipated[0]


def test_elastic_foil_uses_up_nothing_and_is_elastic_once_its_force_returns():
    cycled = shaken_down(crumpled("elastic", 0.140), 1e-3)
    assert cycled.status == "converged" and not cycled.dissipated.any()
    assert cycled.reactions[-1] == pytest.approx(cycled.reactions[-2], rel=1e-3)


def test_too_few_cycles_are_told(virgin):
    cycled = shaken_down(virgin, 2e-3, cycles_max=1)
    assert cycled.status == "not_converged" and "cycle 1 still used up" in cycled.message


def test_what_makes_no_sense_is_refused(virgin):
    with pytest.raises(Refusal, match="amplitude of a cycle"):
        shaken_down(virgin, 0.05)
    with pytest.raises(Refusal, match="'up' is no direction"):
        one_sided(virgin, "up")
    other = replace(virgin, recipe=replace(virgin.recipe, method=Method(MinimisationPath())))
    with pytest.raises(Refusal, match="not by minimisation"):
        shaken_down(other, 1e-3)


def test_a_foil_springs_back_to_where_nothing_holds_it(virgin):
    free = sprung_back(virgin)
    assert free.status == "converged"
    assert virgin.foil.gap_height < free.height < virgin.foil.reference_height
    assert abs(free.force_left) < 0.03
    before, after = (each.problem().numbers()["dissipated_work"] for each in (virgin, free.foil))
    assert after >= before


def test_cycles_and_the_way_back_mind_contact():
    """The motion is that of the problem whose contact it minds."""
    foil = replace(FOIL, reference_height=0.26)
    fitted = crumple(foil, COARSE, Imperfection(seed=3), replace(QUICK, contact=BarrierContact()))
    cycled = shaken_down(fitted, 2e-3, cycles_max=1)
    assert cycled.status in ("converged", "not_converged") and cycled.cycles == 1, cycled.message
    assert self_crossing_share(knot_points(cycled.foil.points)) == 0.0
