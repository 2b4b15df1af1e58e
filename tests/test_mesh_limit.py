"""Stiffness of a given shape by need: refined until its stated error is small, and no further."""

from dataclasses import replace

import numpy as np
import pytest

from foilstudy import Foil, Imperfection, Mesh, Method, crumple
from foilstudy.measure.stiffness import limit_by_need, mesh_limit, transfer_stiffness
from foilstudy.model.materials import material
from foilstudy.pipeline import static
from foilstudy.solve.paths.relaxation import RelaxationPath

QUICK = Method(RelaxationPath(400))
CASES = {
    "500 um": (500e-6, Imperfection(seed=0)),
    "250 um, smooth": (250e-6, Imperfection("smoothed", 10e-6, 30e-3, 1)),
}


@pytest.fixture(scope="module", params=CASES)
def ladder(request):
    """A small real crumple on 10 mm, and its stiffness on it and three finer meshes."""
    thickness, imperfection = CASES[request.param]
    foil = Foil(0.2, 0.15, 0.13, thickness, material("FEP"))
    shape = fine = crumple(foil, Mesh(10e-3), imperfection, QUICK)
    levels = [fine.stiffness()]
    for _ in range(3):
        fine = fine.refined()
        levels.append(fine.stiffness())
    return shape, levels


@pytest.fixture
def asked(monkeypatch):
    """Elements and meshes whose stiffness is asked, in order."""
    calls = []

    def recorded(shape):
        calls.append((shape.element.name.split(",")[0], round(1e4 * shape.patch.size_along)))
        return transfer_stiffness(shape.relieved())

    monkeypatch.setattr(static, "stress_free_stiffness", recorded)
    return calls


def truth(levels):
    return levels[-1] + (levels[-1] - levels[-2]) / 3


@pytest.mark.parametrize("most", [0, 1, 2])
def test_the_stated_error_bounds_the_true_one(ladder, most):
    shape, levels = ladder
    limit = shape.mesh_limit_within(1e-9, most, levels[0])
    assert limit.refinements == most and not limit.met
    assert (np.abs(limit.stiffness - truth(levels)) <= limit.error).all()


def test_a_demand_that_is_met_makes_no_finer_mesh(ladder, asked):
    shape, levels = ladder
    stated = shape.mesh_limit_within(1e-9, 1, levels[0])
    asked.clear()
    demand = 1.001 * (stated.error / stated.stiffness).max()
    limit = shape.mesh_limit_within(demand, 2, levels[0])
    assert limit.met and limit.refinements == 1
    assert asked == [("corner", 50), ("staggered", 50)]
    assert np.array_equal(limit.error, stated.error)
    asked.clear()
    finer = shape.mesh_limit_within(0.999 * demand / 1.001, 2, levels[0])
    assert finer.refinements == 2
    assert asked == [("corner", 50), ("staggered", 50), ("corner", 25)]


def test_a_demand_that_the_crumpled_mesh_meets_makes_no_other(ladder, asked):
    shape, levels = ladder
    limit = shape.mesh_limit_within(10.0, 2, levels[0])
    assert limit.met and limit.refinements == 0 and not asked
    assert np.array_equal(limit.stiffness, levels[0]) and (limit.error > 0).all()


@pytest.mark.parametrize("most", [1, 2])
def test_by_need_has_the_value_of_the_ladder_that_ends_there(ladder, most):
    shape, levels = ladder
    by_need, fixed = shape.mesh_limit_within(1e-9, most), shape.mesh_limit(most)
    assert np.array_equal(by_need.stiffness, fixed.stiffness)
    assert all(map(np.array_equal, by_need.levels, fixed.levels))
    assert fixed.met is None and "not as exact as demanded" in repr(by_need)
    assert np.array_equal(fixed.levels[most], levels[most])


def test_moving_both_rings_costs_nothing(ladder):
    """A shape moved and turned about its axis as a whole has the stiffness that it had."""
    shape, levels = ladder
    c, s = np.cos(0.7), np.sin(0.7)
    turned = np.einsum("ij,jkl->ikl", [[c, -s, 0], [s, c, 0], [0, 0, 1]], shape.points)
    moved = replace(shape, points=turned + np.array([0, 0, 3.0])[:, None, None])
    np.testing.assert_allclose(moved.stiffness(), levels[0], rtol=1e-7)


def pair(axial, radial):
    return np.array([axial, radial])


@pytest.mark.parametrize(
    "halvings, error", [(0, 0.3), (1, 0.0475), (2, 0.0475 / 4), (3, 0.0475 / 16)]
)
def test_what_no_step_shows_is_told_by_the_element_size(halvings, error):
    """5 mm elements on foil of 500 um with a radius of 100 mm, refined."""
    same = [pair(100, 200)] * (halvings + 1)
    limit, stated = limit_by_need(same, same[0] if halvings else None, np.sqrt(0.5))
    assert stated == pytest.approx(error)
    np.testing.assert_array_equal(limit, same[0])


def test_the_direction_that_differs_more_is_stated_of_both():
    own = [pair(100, 200), pair(100, 200)]
    assert limit_by_need(own, pair(100, 180), 0.1)[1] == pytest.approx(0.1)
    own += [pair(100, 200)]
    assert limit_by_need(own, pair(100, 180), 0.1)[1] == pytest.approx(0.1 / 4)


@pytest.mark.parametrize("last, left", [((91, 97.5), 0.5 / 97.5 / 3), ((90, 96.5), 1.5 / 96.5)])
def test_a_step_that_does_not_shrink_counts_whole(last, left):
    own = [pair(100, 100), pair(92, 98), pair(*last)]
    limit, stated = limit_by_need(own, own[1], 0.1)
    assert stated == pytest.approx(max(left, (92 - last[0]) / 3 / last[0]))
    np.testing.assert_array_equal(limit, mesh_limit(own, own[1])[0])
