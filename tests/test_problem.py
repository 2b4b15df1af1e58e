"""A problem as a sum of terms over explicit state."""

from dataclasses import dataclass

import numpy as np
import pytest
import scipy.sparse as sparse
from conftest import GAP_HEIGHT, REFERENCE_HEIGHT, imperfect_sheet
from wild_sheets import wild_open_sheet, wild_shape

from foilstudy.model.supports.loads import EdgeMoment, Loading, point_load
from foilstudy.solve.equilibrium.settle import SettleOptions, settle
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import Scheme


@dataclass(frozen=True)
class Slider:
    """A spring from a control point to an anchor that slips at a given force: perfect plasticity.

    Its state is where the anchor has been dragged to, one number along z.
    """

    row: int
    column: int
    stiffness: float
    yield_force: float
    rest: float
    energy_names = ("slider",)

    def start(self):
        return self.rest

    def _stretch(self, points, anchor):
        return points[2, self.row, self.column] - anchor

    def force(self, points, out, state):
        stretch = self._stretch(points, state)
        out[:] = 0.0
        out[2, self.row, self.column] = self.stiffness * stretch
        return np.array([0.5 * self.stiffness * stretch**2])

    def tangent(self, points, state):
        index = 3 * (self.row * points.shape[2] + self.column) + 2
        return sparse.csr_matrix(
            ([self.stiffness], ([index], [index])), shape=(points.size, points.size)
        )

    def evolved(self, points, state):
        most = self.yield_force / self.stiffness
        return state + np.sign(s := self._stretch(points, state)) * max(abs(s) - most, 0.0)


def sliding(section, yield_force, stiffness=2e3):
    """A slider on the middle of a sheet."""
    row, column = section.patch.rows // 2, section.patch.columns // 3
    return Slider(row, column, stiffness, yield_force, float(section.reference[2, row, column]))


def flat(field):
    return np.moveaxis(field, 0, -1).ravel()


@pytest.fixture(scope="module")
def mixed():
    """A shell with two loads and a slider, in a wild shape."""
    sheet = wild_open_sheet(6)
    loads = (
        Loading(EdgeMoment(sheet.patch, sheet.reference, "top", np.array([0, -2.0, 0])), 0.7),
        Loading(point_load(sheet.patch, sheet.reference, (0.03, 0.04), np.array([1.0, 2, 3]))),
    )
    return Problem(sheet, *loads, sliding(sheet, 1.0)), wild_shape(sheet)


def test_gradient_of_the_sum_is_the_derivative_of_its_value(mixed):
    problem, points = mixed
    force = np.empty_like(points)
    energies = problem.force(points, force)
    assert problem.energy_names == (
        *("membrane", "bending", "stabilisation"),
        *("load", "load_2", "slider"),
    )
    assert energies.shape == (6,) and energies.sum() == pytest.approx(problem.value(points))
    direction = np.random.default_rng(1).standard_normal(points.shape)
    step = 1e-6 * problem.patch.size_around
    slope = (
        problem.value(points + step * direction) - problem.value(points - step * direction)
    ) / (2 * step)
    assert slope == pytest.approx((force * direction).sum(), rel=1e-6)


def test_tangent_of_the_sum_is_the_derivative_of_its_gradient(mixed):
    problem, points = mixed
    direction = np.random.default_rng(2).standard_normal(points.shape)
    step = 1e-6 * problem.patch.size_around
    sides = [np.empty_like(points) for _ in range(2)]
    for side, sign in zip(sides, (1, -1)):
        problem.force(points + sign * step * direction, side)
    slope = flat(sides[0] - sides[1]) / (2 * step)
    product = problem.tangent(points) @ flat(direction)
    np.testing.assert_allclose(product, slope, rtol=0, atol=1e-6 * np.abs(slope).max())


def test_a_shell_alone_is_the_problem_to_the_last_bit():
    sheet = wild_open_sheet(6)
    points, problem = wild_shape(sheet), Problem(sheet)
    ours, alone = np.empty_like(points), np.empty_like(points)
    assert np.array_equal(problem.force(points, ours), sheet.force(points, alone))
    assert np.array_equal(ours, alone) and not problem.has_memory
    assert (problem.tangent(points) != sheet.tangent(points)).nnz == 0


def test_a_term_with_memory_settles_at_its_own_last_state():
    """The slider slips while the foil is crumpled and ends at, not beyond, its yield force."""
    sheet = imperfect_sheet(20e-3)
    slider = sliding(sheet, yield_force=0.5)
    problem = Problem(sheet, slider)
    path = RelaxationPath(ramp_steps=400)
    arrival = path.follow(problem, REFERENCE_HEIGHT - GAP_HEIGHT)
    assert arrival.status == "converged", arrival.message
    anchor = problem.state[1]
    assert anchor != slider.rest
    stretch = slider.stiffness * abs(slider._stretch(arrival.points, anchor))
    assert stretch <= slider.yield_force * (1 + 1e-12)
    # in equilibrium at that state, and the state stays: settling again changes nothing
    again = settle(problem, Scheme().start(problem), arrival.points, SettleOptions())
    assert (again.status, again.relaxation_steps, again.hessians) == ("converged", 0, 0)
    assert problem.state[1] == anchor
    # it has dissipated: without the slip the same spring would hold the point
    held = sliding(sheet, yield_force=np.inf)
    elastic = path.follow(Problem(sheet, held), REFERENCE_HEIGHT - GAP_HEIGHT)
    force = held.stiffness * abs(held._stretch(elastic.points, held.rest))
    assert force > 2 * slider.yield_force
