"""Ways to measure a stiffness: their limits, and the sheet between a standing and a guided ring."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import FOIL, rotation
from wild_sheets import extrapolated, wild_sheet

from foilstudy.model.foil import Imperfection
from foilstudy.model.patch import RING_ROWS
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.measures import STIFFNESS_MEASURES
from foilstudy.pipeline.measures.displacement_probe import DisplacementProbe
from foilstudy.pipeline.measures.force_probe import ForceProbe
from foilstudy.pipeline.measures.probing import doubt
from foilstudy.pipeline.measures.reaction_slope import ReactionSlope
from foilstudy.pipeline.measures.tangent import Tangent
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.equilibrium.guided import Guide, GuidedSheet, guided, untouched
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.loop import History

ALL = tuple(range(6))


def crumpled_on(element_size):
    """500 um, 31 %, in equilibrium."""
    method = Method(RelaxationPath(ramp_steps=500, check_interval=5))
    crumpled = crumple(FOIL, Mesh(element_size), Imperfection(), method)
    assert crumpled.status == "converged", crumpled.message
    return crumpled


@pytest.fixture(scope="module")
def small():
    """Stable also where the top ring is free but for its dead load."""
    return crumpled_on(15e-3)


# --- the guided sheet ---------------------------------------------------------------------------


def guided_sheet(free=ALL):
    """A wild sheet whose ring has turned a lot, under force and moment; and unknowns beside."""
    sheet = wild_sheet(6, 5)
    motion = np.array([0.01, -0.02, 0.03, 0.9, -0.4, 0.6])
    guide = Guide(motion, free, np.array([30.0, 20.0, -10.0, 2.0, -1.0, 0.5]))
    potential = GuidedSheet(Problem(sheet), sheet.reference, guide)
    q = potential.unknowns(sheet.reference, motion)
    return potential, q + 1e-3 * np.random.default_rng(1).standard_normal(q.size)


@pytest.mark.parametrize("free", [(), (2,), (0, 3, 5), ALL])
def test_derivatives_of_a_guided_sheet(free):
    potential, q = guided_sheet(free)
    way = np.random.default_rng(2).standard_normal(q.size)
    if free:
        way[: -len(free)] *= 0.1  # so that the ring's part is seen
    gradient = potential.value_and_gradient(q)[1]
    hessian = potential.hessian(q)

    def slope(step):
        ahead, behind = (potential.value_and_gradient(q + s * step * way)[0] for s in (1, -1))
        return (ahead - behind) / (2 * step)

    def bend(step):
        ahead, behind = (potential.value_and_gradient(q + s * step * way)[1] for s in (1, -1))
        return (ahead - behind) / (2 * step)

    size = np.linalg.norm(gradient) * np.linalg.norm(way)
    assert abs(extrapolated(slope, 1e-4) - gradient @ way) < 1e-9 * size
    product = hessian @ way
    assert np.linalg.norm(extrapolated(bend, 1e-4) - product) < 1e-8 * np.linalg.norm(product)


def test_the_guided_ring_stays_rigid():
    potential, q = guided_sheet()
    before, after = wild_sheet(6, 5).reference, potential.points(q)
    ring, moved = (x[:, -RING_ROWS:].reshape(3, -1) for x in (before, after))
    gaps = [np.linalg.norm(x[:, :, None] - x[:, None], axis=0) for x in (ring, moved)]
    np.testing.assert_allclose(gaps[1], gaps[0], rtol=0, atol=1e-14)
    assert np.array_equal(after[:, :RING_ROWS], before[:, :RING_ROWS])
    small = GuidedSheet(Problem(wild_sheet(6, 5)), before, Guide(1e-5 * np.arange(6.0)))
    centre = np.array([[0.0], [0.0], [ring[2].mean()]])
    angle = 1e-5 * np.linalg.norm([3, 4, 5])
    turned = rotation([3, 4, 5], angle) @ (ring - centre) + centre
    turned += 1e-5 * np.array([[0.0], [1.0], [2.0]])
    there = small.points(small.unknowns(before, np.zeros(6)))[:, -RING_ROWS:].reshape(3, -1)
    np.testing.assert_allclose(there, turned, rtol=0, atol=1e-14)


def test_action_is_reaction_between_the_rings(small):
    motion = np.array([2e-4, 0, -3e-4, 2e-3, 0, 0])
    found = guided(small.problem(), small.points, Guide(motion))
    assert found.status == "converged", found.message
    bottom, top = found.pull
    scale = np.abs(top[:3]).max()
    np.testing.assert_allclose(bottom[:3], -top[:3], atol=1e-6 * scale)
    centres = [found.points[:, rows].mean(axis=(1, 2)) for rows in (slice(2), slice(-2, None))]
    moment = bottom[3:] + top[3:] + np.cross(centres[1] - centres[0], top[:3])
    np.testing.assert_allclose(moment, 0, atol=1e-6 * scale)


@pytest.mark.parametrize("stressed", [False, True])
def test_work_of_the_ring_is_the_change_of_energy(small, stressed):
    """Simpson's rule on the force along the way of the ring."""
    problem = small.problem() if stressed else Problem(small.relieved())
    before, found = None, []
    for way in np.linspace(1e-4, 5e-4, 5):
        before = guided(problem, small.points, Guide(np.array([0, 0, way, 0, 0, 0])), before)
        assert before.status == "converged", before.message
        found.append(before)
    work = np.array([1, 4, 2, 4, 1]) @ [each.pull[1, 2] for each in found] * 1e-4 / 3
    change = found[-1].energy - found[0].energy
    assert work == pytest.approx(change, rel=1e-5)


# --- probes -------------------------------------------------------------------------------------


@pytest.mark.parametrize(("stressed", "others"), [(True, "held"), (True, "free"), (False, "held")])
def test_a_displacement_probe_tends_to_the_tangent_at_second_order(small, stressed, others):
    tangent = Tangent(stressed, others).of(small).stiffness
    probe = DisplacementProbe((1e-4, 2e-4), stressed, others).of(small)
    assert not probe.message
    errors = np.abs(np.array(probe.levels) - tangent)
    assert (errors < 0.02 * tangent).all()
    assert ((3.5 < errors[1] / errors[0]) & (errors[1] / errors[0] < 4.5)).all()


def test_a_force_probe_tends_to_the_tangent_at_first_order(small):
    tangent = Tangent(others="free").of(small).stiffness
    errors = [ForceProbe(force, "free").of(small).stiffness - tangent for force in (0.2, 0.4)]
    assert (np.abs(errors[0]) < 1e-3 * tangent).all()
    assert errors[1][0] / errors[0][0] == pytest.approx(2, rel=0.1)


def test_the_tangent_is_the_stiffness_of_a_crumple(small):
    np.testing.assert_allclose(Tangent().of(small).stiffness, small.stiffness(), rtol=1e-9)
    expected = small.prestressed_stiffness()
    np.testing.assert_allclose(Tangent(stressed=True).of(small).stiffness, expected, rtol=1e-9)


@pytest.fixture(scope="module")
def tall():
    """A crumple that is a minimum with held rings only."""
    return crumpled_on(18e-3)


def test_a_snap_on_the_way_is_told(tall):
    """One centimetre up sets energy free, one millimetre is the way of a spring."""
    problem = tall.problem()
    rest = untouched(problem, tall.points)
    ends = [guided(problem, tall.points, Guide(way * np.eye(6)[2])) for way in (1e-3, 1e-2)]
    assert [end.status for end in ends] == ["converged"] * 2
    assert doubt(rest, ends[0], 2) == ""
    assert "has snapped or is far from linear with the ring moved by 10 mm along z" in doubt(
        rest, ends[1], 2
    )
    assert ends[1].energy - rest.energy < rest.pull[1, 2] * 1e-2


def test_a_ring_that_would_fall_when_freed_has_no_free_stiffness(tall):
    found = Tangent(stressed=True, others="free").of(tall)
    assert np.isnan(found.stiffness).all() and "falls from this equilibrium in 1" in found.message
    assert (Tangent(stressed=True).of(tall).stiffness > 0).all()


def test_a_probe_without_an_equilibrium_has_no_number_and_says_why(small, monkeypatch):
    monkeypatch.setattr("foilstudy.solve.equilibrium.guided._HESSIANS", 1)
    found = DisplacementProbe((2e-5, 0.05)).of(small)
    assert np.isnan(found.stiffness).all()
    assert np.isfinite(found.levels[0]).all()
    assert "no equilibrium with the ring moved by 50 mm along x" in found.message
    pulled = ForceProbe(3000.0).of(small)
    assert np.isnan(pulled.stiffness).all()
    assert "no equilibrium with 3000 N along x" in pulled.message


def test_an_untouched_sheet_is_in_equilibrium(small):
    rest = untouched(small.problem(), small.points)
    assert np.array_equal(rest.points, small.points)
    assert rest.energy == pytest.approx(small.energies().total, rel=1e-12)
    assert np.array_equal(rest.motion, np.zeros(6))


# --- slope of the reaction ----------------------------------------------------------------------


def with_history(crumpled, height, force):
    nothing = np.zeros(len(height))
    history = History(np.arange(len(height)), height, force, {}, nothing, nothing)
    return replace(crumpled, arrival=replace(crumpled.arrival, history=history))


def test_the_slope_of_a_reaction_is_that_of_its_last_share(small):
    """A spring of 300 N/m on the last tenth, another before; a ring at rest adds nothing."""
    height = np.concatenate([np.linspace(0.17, 0.13, 101), [0.13] * 50])
    force = np.where(height > 0.134, 10.0, 10 + 300 * (0.134 - height))
    force[101:] = -50.0
    axial, radial = ReactionSlope(0.1).of(with_history(small, height, force)).stiffness
    assert axial == pytest.approx(300, rel=1e-9)
    assert np.isnan(radial)


def test_a_slope_without_a_history_says_why(small):
    bare = replace(small, arrival=replace(small.arrival, history=None))
    assert "crumple it anew" in ReactionSlope().of(bare).message
    height = np.linspace(0.17, 0.13, 11)
    few = ReactionSlope(0.1).of(with_history(small, height, height))
    assert np.isnan(few.stiffness).all() and "2 entries in the last 10 %" in few.message


def test_the_slope_of_a_real_ramp_is_no_stiffness(small):
    slope, tangent = (STIFFNESS_MEASURES[n]().of(small).stiffness[0]
                      for n in ("reaction_slope", "tangent"))  # fmt: skip
    assert abs(slope / tangent - 1) > 0.1
