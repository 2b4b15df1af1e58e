"""Minima of potentials with saddles, snaps and singular Hessians."""

import numpy as np
import pytest
import scipy.sparse as sparse
from scipy.special import ellipe, ellipk

from foilstudy.linalg import factorise
from foilstudy.solve.equilibrium.newton import NewtonOptions, minimise
from foilstudy.solve.equilibrium.quasi_newton import InverseHessian


class Quadratic:
    """q.A q / 2 - b.q"""

    def __init__(self, matrix, load):
        self.matrix, self.load = sparse.csr_matrix(matrix), np.asarray(load, float)

    def value_and_gradient(self, q):
        product = self.matrix @ q
        return 0.5 * q @ product - self.load @ q, product - self.load

    def hessian(self, q):
        return self.matrix


class Column:
    """Cantilever of rigid links with elastic hinges under a dead end load; unknowns are angles.

    The links' middles carry the angles, so that the hinge at the wall, half a link from the
    first, is twice as stiff. Length 1, bending stiffness 1.
    """

    def __init__(self, links, load):
        self.length, self.load = 1 / links, load
        hinges = np.full(links, float(links))
        hinges[0] *= 2
        self.bending = sparse.diags(
            [hinges + np.append(hinges[1:], 0), -hinges[1:], -hinges[1:]], [0, 1, -1], format="csr"
        )

    def value_and_gradient(self, q):
        bent = self.bending @ q
        push = self.load * self.length
        return 0.5 * q @ bent + push * np.sum(np.cos(q)), bent - push * np.sin(q)

    def hessian(self, q):
        return (self.bending - self.load * self.length * sparse.diags(np.cos(q))).tocsr()


class Truss:
    """Shallow two-bar truss of unit half span: rise h, height q, load P down (von Mises 1923)."""

    def __init__(self, rise, load):
        self.rise, self.load = rise, load

    def strain(self, q):
        return 0.5 * (q**2 - self.rise**2)

    def value_and_gradient(self, q):
        strain = self.strain(q[0])
        return strain**2 + self.load * q[0], np.array([2 * strain * q[0] + self.load])

    def hessian(self, q):
        return sparse.csr_matrix([[2 * self.strain(q[0]) + 2 * q[0] ** 2]])


def test_linear_problem_takes_one_hessian_and_one_step():
    rng = np.random.default_rng(0)
    factor = rng.standard_normal((20, 20))
    matrix, load = factor @ factor.T + np.eye(20), rng.standard_normal(20)
    result = minimise(Quadratic(matrix, load), np.zeros(20))
    assert (result.status, result.iterations, result.steps) == ("converged", 1, 1)
    assert result.negative_eigenvalues == 0
    np.testing.assert_allclose(result.q, np.linalg.solve(matrix, load), rtol=1e-9)


@pytest.mark.parametrize("tip_angle", [20, 60, 100, 140])
def test_straight_column_is_left_for_the_elastica(tip_angle):
    """Tip of the buckled cantilever by elliptic integrals (Timoshenko and Gere, art. 2.7)."""
    modulus = np.sin(np.radians(tip_angle) / 2)
    k, e = ellipk(modulus**2), ellipe(modulus**2)
    column = Column(200, load=k**2)
    result = minimise(column, np.zeros(200))
    assert result.status == "converged", result.message
    height = column.length * np.sum(np.cos(result.q))
    deflection = abs(column.length * np.sum(np.sin(result.q)))
    # the links are second order, and near the critical load the amplitude amplifies their error
    assert height == pytest.approx(2 * e / k - 1, abs=1e-3)
    assert deflection == pytest.approx(2 * modulus / k, abs=1e-3)


def test_column_below_its_critical_load_stays_straight():
    result = minimise(Column(50, load=0.99 * np.pi**2 / 4), np.zeros(50))
    assert (result.status, result.iterations, result.negative_eigenvalues) == ("converged", 0, 0)
    assert not result.q.any()


def test_saddle_of_many_negative_eigenvalues_is_left_for_the_only_kind_of_minimum():
    """At 30 times its critical load the straight column has the first three modes unstable."""
    load = 30 * np.pi**2 / 4
    column = Column(60, load)
    straight = np.zeros(60)
    assert factorise(column.hessian(straight)).negative_eigenvalues == 3
    result = minimise(column, straight)
    assert (result.status, result.negative_eigenvalues) == ("converged", 0)
    assert len(set(np.sign(result.q))) == 1  # the first mode's family: bent to one side


@pytest.mark.parametrize("rise", [0.1, 1.0])
def test_truss_beyond_its_limit_load_snaps_through(rise):
    """Limit load 2 rise^3 / (3 sqrt 3) at the height rise / sqrt 3."""
    limit = 2 * rise**3 / (3 * np.sqrt(3))
    below = minimise(Truss(rise, 0.98 * limit), np.array([rise]))
    beyond = minimise(Truss(rise, 1.02 * limit), below.q)
    assert below.status == beyond.status == "converged"
    assert rise / np.sqrt(3) < below.q[0] < rise
    assert beyond.q[0] < -rise


@pytest.mark.parametrize("size", [1, 2, 30])
@pytest.mark.parametrize("tilt", [-1, 1])
def test_saddle_is_left_towards_the_side_that_falls_faster(size, tilt):
    """So that the mirrored problem has the mirrored solution: x^4/4 - tilt x^3/3 - x^2/2."""

    class Tilted:
        def value_and_gradient(self, q):
            x, rest = q[0], q[1:]
            value = x**4 / 4 - tilt * x**3 / 3 - x**2 / 2 + 0.5 * rest @ rest
            return value, np.append(x**3 - tilt * x**2 - x, rest)

        def hessian(self, q):
            diagonal = np.ones(size)
            diagonal[0] = 3 * q[0] ** 2 - 2 * tilt * q[0] - 1
            return sparse.diags(diagonal, format="csr")

    result = minimise(Tilted(), np.zeros(size))
    assert result.status == "converged"
    assert result.q[0] == pytest.approx(tilt * (1 + np.sqrt(5)) / 2)  # not at (1 - sqrt 5) / 2


def test_curved_valley_is_followed_to_its_end():
    """Chained Rosenbrock function, whose minimum at (1, 1, ...) is the only one from here."""
    from scipy.optimize import rosen, rosen_der, rosen_hess

    class Valley:
        def value_and_gradient(self, q):
            return rosen(q), rosen_der(q)

        def hessian(self, q):
            return sparse.csr_matrix(rosen_hess(q))

    result = minimise(Valley(), np.linspace(0, 2, 30), NewtonOptions(1e-10))
    assert result.status == "converged"
    np.testing.assert_allclose(result.q, 1, atol=1e-9)


def test_one_step_per_factorisation_converges_quadratically():
    options = NewtonOptions(1e-13, steps_per_factorisation=1)
    result = minimise(Column(50, load=3.0), np.full(50, 0.5), options)
    assert result.status == "converged"
    assert result.iterations == result.steps <= 8


def test_size_of_the_metric_does_not_matter():
    metric = sparse.diags(np.linspace(1, 2, 40), format="csr")
    first, second = (
        minimise(Column(40, load=20.0), np.full(40, 1e-3), NewtonOptions(metric=m))
        for m in (metric, 1024 * metric)
    )
    assert first.status == "converged"
    assert np.array_equal(first.q, second.q)


def test_residual_is_relative_to_the_given_scale():
    column, start = Column(30, load=1.0), np.full(30, 0.1)
    size = np.linalg.norm(column.value_and_gradient(start)[1])
    constant = minimise(column, start, NewtonOptions(1e-3, scale=size))
    callable_ = minimise(column, start, NewtonOptions(1e-3, scale=lambda q: size))
    gradient = np.linalg.norm(column.value_and_gradient(constant.q)[1])
    assert constant.residual == callable_.residual == gradient / size <= 1e-3
    assert minimise(column, start, NewtonOptions(1e-3, scale=1e4 * size)).iterations == 0


def test_start_is_left_as_it_was():
    start = np.full(30, 0.1)
    minimise(Column(30, load=3.0), start)
    assert np.array_equal(start, np.full(30, 0.1))


def test_minimum_in_a_flat_valley_is_reported_as_singular():
    result = minimise(Quadratic([[1, -1], [-1, 1]], [0, 0]), np.array([1.0, 0.0]))
    assert result.status == "stalled"
    assert result.negative_eigenvalues is None
    assert "singular" in result.message
    assert result.q[0] == pytest.approx(result.q[1])


def test_potential_without_a_minimum_is_no_success():
    options = NewtonOptions(iterations_max=5)
    result = minimise(Quadratic([[1, 0], [0, -1]], [0, 0]), np.array([1.0, 1e-3]), options)
    assert result.status == "not_converged"
    assert "wanted 1.0e-08" in result.message


def test_used_up_iterations_are_reported_with_the_residual():
    options = NewtonOptions(iterations_max=1, steps_per_factorisation=1)
    column, start = Column(50, load=20.0), np.full(50, 0.5)
    result = minimise(column, start, options)
    assert (result.status, result.iterations) == ("not_converged", 1)
    assert result.residual == np.linalg.norm(column.value_and_gradient(result.q)[1])
    assert column.value_and_gradient(result.q)[0] < column.value_and_gradient(start)[0]


def test_start_that_is_not_finite_is_refused():
    with pytest.raises(ValueError, match="not finite at the start"):
        minimise(Column(5, load=1.0), np.full(5, np.nan))


class Pit(Quadratic):
    """A bowl that is no number beyond a radius: in its gradient, or in its Hessian alone."""

    def __init__(self, radius, where):
        super().__init__(np.diag([1.0, 40.0]), [3.0, 40.0])
        self.radius, self.where = radius, where

    def value_and_gradient(self, q):
        value, gradient = super().value_and_gradient(q)
        if self.where == "gradient" and np.linalg.norm(q) > self.radius:
            gradient = np.full(2, np.nan)
        return value, gradient

    def hessian(self, q):
        return self.matrix * (np.nan if self.where == "hessian" else 1.0)


@pytest.mark.parametrize("where", ["gradient", "hessian"])
def test_what_is_no_number_ends_a_search_in_words(where):
    result = minimise(Pit(2.0, where), np.array([0.5, 0.2]), NewtonOptions(iterations_max=8))
    assert result.status in ("stalled", "not_converged")
    assert np.isfinite(result.residual)
    assert np.linalg.norm(result.q) <= 2.0


def test_corrected_inverse_meets_the_secant_condition_and_stays_symmetric():
    rng = np.random.default_rng(1)
    spread = rng.standard_normal((12, 12))
    exact = spread @ spread.T + np.eye(12)
    inverse = InverseHessian(factorise(sparse.identity(12, format="csr")))
    for _ in range(4):
        step = rng.standard_normal(12)
        inverse.learn(step, exact @ step)
    np.testing.assert_allclose(inverse.apply(exact @ step), step, rtol=1e-10)
    matrix = np.stack([inverse.apply(row) for row in np.eye(12)])
    np.testing.assert_allclose(matrix, matrix.T, atol=1e-12)
    assert np.linalg.eigvalsh(matrix).min() > 0


def test_pair_without_positive_curvature_is_not_learnt():
    inverse = InverseHessian(factorise(sparse.identity(3, format="csr")))
    inverse.learn(np.array([1.0, 0, 0]), np.array([-1.0, 0, 0]))
    assert np.array_equal(inverse.apply(np.ones(3)), np.ones(3))
