"""Ways to a crumple beside relaxation: where they lead, how far, and what they say."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import FOIL, imperfect_sheet
from test_problem import sliding

from foilstudy.base.errors import Refusal
from foilstudy.base.spec import dumped, loaded
from foilstudy.model.foil import Imperfection
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.choices import PATHS
from foilstudy.solve.continuation.pushed_sheet import PushedSheet
from foilstudy.solve.equilibrium.settle import SettleOptions
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.scheme import Scheme

COARSE = Mesh(18e-3)
CONTINUED = ("newton", "arc_length", "branch_switching")
WAYS = {way: {"first_step": 0.2} for way in CONTINUED} | {"minimisation": {"steps": 4}}
"""All, with steps for a sheet that does not buckle."""


def test_what_a_pushed_sheet_gives_are_derivatives_of_its_energy():
    problem, shortening = Problem(imperfect_sheet(18e-3)), 0.04
    sheet = PushedSheet(problem, shortening)
    rng = np.random.default_rng(1)
    q, factor = 1e-4 * rng.standard_normal(sheet.size), 0.01
    motion = rng.standard_normal(sheet.size)
    step = 1e-7
    tangent, rate = sheet.linearised(q, factor)
    along = (
        sheet.residual(q + step * motion, factor) - sheet.residual(q - step * motion, factor)
    ) / (2 * step)
    np.testing.assert_allclose(tangent @ motion, along, atol=1e-6 * np.abs(along).max())
    by_factor = (sheet.residual(q, factor + step) - sheet.residual(q, factor - step)) / (2 * step)
    np.testing.assert_allclose(rate, by_factor, atol=1e-6 * np.abs(by_factor).max())
    energy = [problem.value(sheet.points(q + s * step * motion, factor)) for s in (1, -1)]
    slope = (energy[0] - energy[1]) / (2 * step)
    assert slope == pytest.approx(sheet.residual(q, factor) @ motion, rel=1e-5)


@pytest.mark.parametrize("way", WAYS)
def test_before_it_buckles_every_way_leads_where_the_relaxation_leads(way):
    shortening = 1e-4
    problem = Problem(imperfect_sheet(18e-3))
    relaxed = RelaxationPath(ramp_steps=200).follow(problem, shortening)
    arrival = PATHS[way](**WAYS[way]).follow(problem, shortening)
    assert (arrival.status, arrival.negative_eigenvalues) == ("converged", 0), arrival.message
    assert arrival.residual <= 1e-8 and arrival.hessians >= arrival.steps > 1
    np.testing.assert_allclose(arrival.points, relaxed.points, atol=1e-9)
    # the work of the reaction is the energy of the sheet
    history = arrival.history
    work = np.trapezoid(history.reaction_force, -history.height)
    assert work == pytest.approx(problem.value(arrival.points), rel=0.02)


@pytest.mark.parametrize("way", CONTINUED)
def test_a_way_that_ends_before_the_gap_is_closed_says_how_far_it_came_and_leaves_no_crumple(way):
    method = Method(path=PATHS[way](budget=40))
    crumpled = crumple(FOIL, COARSE, None, method)
    arrival = crumpled.arrival
    assert arrival.status == "failed" and arrival.hessians == 40
    share = (FOIL.reference_height - arrival.history.height.min()) / FOIL.shortening
    words = f"came to {100 * share:.3g} % of the shortening with 40 factorisations"
    assert arrival.message.endswith(f"{words}: the 40 factorisations are spent")
    assert loaded(Method, dumped(method)) == method


def test_steps_of_minimisation_arrive_and_snaps_release_energy():
    path = PATHS["minimisation"](steps=25)
    crumpled = crumple(FOIL, Mesh(25e-3), None, Method(path=path))
    arrival, problem = crumpled.arrival, crumpled.problem()
    assert (arrival.status, arrival.negative_eigenvalues) == ("converged", 0), arrival.message
    assert arrival.residual <= 1e-8 and arrival.steps == 25
    heights, reactions = arrival.history.height, arrival.history.reaction_force
    np.testing.assert_allclose(heights[[0, -1]], (FOIL.reference_height, FOIL.gap_height))
    assert np.trapezoid(reactions, -heights) > problem.value(arrival.points)


def test_a_spent_budget_ends_the_minimisation_and_leaves_no_crumple():
    path = PATHS["minimisation"](steps=25, budget=4)
    arrival = path.follow(Problem(imperfect_sheet(25e-3)), FOIL.shortening)
    assert arrival.status == "failed" and arrival.hessians <= 4
    assert f"came to {4 * (arrival.steps - 1)} % of the shortening" in arrival.message


def test_what_failed_on_a_coarse_mesh_is_not_refined():
    method, mesh = Method(path=PATHS["newton"](budget=10)), Mesh(18e-3, ramp_coarsenings=1)
    crumpled = crumple(FOIL, mesh, None, method)
    assert crumpled.status == "failed" and crumpled.patch == mesh.of_ramp().patch(FOIL)


def test_long_newton_steps_pass_bifurcations_unseen_and_the_arrival_is_called_unstable():
    """On a nearly perfect cylinder the iterations find the unbuckled shape, which is a saddle."""
    foil = replace(FOIL, gap_height=FOIL.reference_height - 2e-4)
    smooth = Imperfection("smoothed", 10e-6, 36e-3)
    path = PATHS["newton"](first_step=1.0)
    crumpled = crumple(foil, COARSE, smooth, Method(path=path))
    assert crumpled.status == "not_converged"
    assert crumpled.arrival.negative_eigenvalues > 0
    assert crumpled.message.startswith("an unstable equilibrium")


def test_a_way_minimises_a_shape_from_elsewhere():
    foil = replace(FOIL, gap_height=FOIL.reference_height - 1e-4)
    problem = uncrumpled(foil, COARSE).problem()
    path = PATHS["arc_length"](first_step=0.2)
    arrival = path.follow(problem, foil.shortening)
    rng = np.random.default_rng(2)
    shaken = arrival.points.copy()
    shaken[:, 2:-2] += 1e-7 * rng.standard_normal(shaken[:, 2:-2].shape)
    back = path.relax(problem, shaken)
    assert back.status == "converged", back.message
    np.testing.assert_allclose(back.points, arrival.points, atol=1e-9)


@pytest.mark.parametrize("way", WAYS)
def test_a_study_gives_a_way_its_tolerance(way):
    settling = SettleOptions(residual_tolerance=1e-6)
    path = PATHS[way].for_study(100, Scheme(), settling, 20)
    assert path == PATHS[way](settling=settling) and path.kind == way


def test_a_memory_is_refused_in_one_sentence():
    sheet = imperfect_sheet(18e-3)
    with pytest.raises(Refusal, match="newton follows elastic equilibria .* use relaxation"):
        PATHS["newton"]().follow(Problem(sheet, sliding(sheet, yield_force=1.0)), 1e-4)
