"""Reduced models and interface dynamic stiffness against the full-order system."""

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sparse
from scipy.sparse.linalg import eigsh

from foilstudy.dynamics import (
    DEFINITIONS,
    HintzHerting,
    Structure,
    dynamic_stiffness,
    frequency_grid,
)
from foilstudy.dynamics.reduction import INTERFACE, ReducedModel, project
from foilstudy.dynamics.response import interface_dynamic_stiffness
from foilstudy.linalg import factorise
from foilstudy.stiffness import fixed_stiffness
from foilstudy.stiffness.rings import interface_rigid_modes

CUTOFF_HZ = 1000.0
BAND_HZ = 800.0
"""Shown band of a study: 0.8 of the cut-off."""
DAMPING = 0.05
SCALE = np.tile([1.0, 1.0, 1.0, 10.0, 10.0, 10.0], 2)
"""Rotations as motions of the ring's edge, 1/R."""


@pytest.fixture(scope="module")
def structure(coarse_crumple, coarse_static):
    return Structure(coarse_crumple.stiffness, coarse_crumple.mass, coarse_static)


@pytest.fixture(scope="module")
def model(structure):
    return HintzHerting(CUTOFF_HZ).reduce(structure)


def full_order(structure, frequency):
    """Undamped interface dynamic stiffness by condensation of K - omega^2 M."""
    w2 = (2 * np.pi * frequency) ** 2
    k, m = structure.stiffness, structure.mass
    coupling = k.coupling - w2 * m.coupling
    solution = factorise((k.interior - w2 * m.interior).tocsr()).solve(coupling)
    return k.interface - w2 * m.interface - coupling.T @ solution


def scaled(matrix):
    return matrix * np.outer(SCALE, SCALE)


def test_low_frequencies_lose_no_accuracy_to_the_rigid_modes(structure, model):
    """At the lowest frequency that a study accepts."""
    static = fixed_stiffness(structure.static.stiffness)
    for definition in dynamic_stiffness(model, np.array([0.01]), DAMPING):
        np.testing.assert_allclose(np.abs(definition[:, 0]), static, rtol=1e-5)


# --- reduction -----------------------------------------------------------------------------------


def test_static_limit_is_the_condensed_stiffness(structure, model):
    assert np.array_equal(model.static_stiffness, structure.static.stiffness)
    assert not model.stiffness[:INTERFACE, INTERFACE:].any()


def test_projection_is_the_galerkin_projection(structure):
    """T^T K T and T^T M T with T assembled in full, for any interior basis."""
    k, m, static = structure.stiffness, structure.mass, structure.static
    size = k.interior.shape[0]
    basis = np.random.default_rng(0).standard_normal((size, 7))
    reduced = project(structure, basis, 0)
    carried = np.vstack([static.constraint_modes, np.eye(INTERFACE)])
    inner = np.vstack([basis, np.zeros((INTERFACE, 7))])
    t = np.hstack([carried, inner])
    for part, ours in ((k, reduced.stiffness), (m, reduced.mass)):
        full = sparse.block_array(
            [[part.interior, part.coupling], [part.coupling.T, part.interface]]
        ).tocsr()
        expected = t.T @ (full @ t)
        weight = np.sqrt(np.abs(np.outer(np.diag(expected), np.diag(expected))))
        np.testing.assert_allclose(ours / weight, expected / weight, rtol=0, atol=1e-9)


def test_reduced_model_has_six_rigid_modes(coarse_crumple, model):
    values = scipy.linalg.eigh(model.stiffness, model.mass, eigvals_only=True)
    first = values[6]
    assert np.abs(values[:6]).max() < 1e-6 * first
    points = coarse_crumple.points
    rigid = np.zeros((model.mass.shape[0], 6))
    rigid[:INTERFACE] = interface_rigid_modes(points[2, -2:].mean() - points[2, :2].mean())
    inertia = rigid.T @ model.mass @ rigid
    total = coarse_crumple.sheet.element_areas().sum() * 2150.0 * 500e-6
    np.testing.assert_allclose(np.diag(inertia)[:3], total, rtol=1e-9)


def test_reduced_mass_is_positive_definite(model):
    assert np.linalg.eigvalsh(model.mass)[0] > 0


def test_retained_modes_are_the_elastic_modes_below_the_cutoff(structure, model):
    k, m = structure.stiffness, structure.mass
    full = [
        sparse.block_array([[p.interior, p.coupling], [p.coupling.T, p.interface]]).tocsr()
        for p in (k, m)
    ]
    limit = (2 * np.pi * CUTOFF_HZ) ** 2
    below = factorise((full[0] - limit * full[1]).tocsr()).negative_eigenvalues
    assert model.retained_modes == below - 6
    # each of them is a mode of the reduced model as well
    values = scipy.linalg.eigh(model.stiffness, model.mass, eigvals_only=True)
    exact = eigsh(full[0], below, full[1], sigma=-0.01 * limit, return_eigenvectors=False)
    np.testing.assert_allclose(values[6:below], np.sort(exact)[6:], rtol=1e-7)


def test_clamped_eigenfrequencies_against_the_full_order(structure, model):
    k, m = structure.stiffness.interior, structure.mass.interior
    exact = np.sqrt(np.sort(eigsh(k, 12, m, sigma=0.0, return_eigenvectors=False))) / (2 * np.pi)
    ours = model.clamped_eigenfrequencies(12)
    assert (ours >= exact * (1 - 1e-9)).all()  # Rayleigh-Ritz
    inside = exact < BAND_HZ
    assert inside.any()
    np.testing.assert_allclose(ours[inside], exact[inside], rtol=1e-3)
    assert np.isnan(model.clamped_eigenfrequencies(10_000)[-1])


# --- response ------------------------------------------------------------------------------------


def test_frequency_grid_is_logarithmic_with_exact_ends():
    grid = frequency_grid(1.0, 800.0, 200)
    assert grid[0] == 1.0 and grid[-1] == 800.0 and grid.size == 200
    np.testing.assert_allclose(grid[1:] / grid[:-1], 800 ** (1 / 199), rtol=1e-13)


def test_undamped_response_against_the_full_order(structure, model):
    """Constraint modes and inertia relief leave an error of fourth order in frequency."""
    share = np.array([0.0125, 0.025, 0.05, 0.1, 0.3, 0.4])
    ours = interface_dynamic_stiffness(model, share * CUTOFF_HZ, 0.0)
    assert np.abs(ours.imag).max() == 0.0
    errors = []
    for frequency, reduced in zip(share * CUTOFF_HZ, ours.real, strict=True):
        exact = scaled(full_order(structure, frequency))
        errors.append(np.linalg.norm(scaled(reduced) - exact) / np.linalg.norm(exact))
    np.testing.assert_allclose(np.log2(np.divide(errors[1:4], errors[:3])), 4.0, atol=0.2)
    assert (errors < share**4).all()


def test_response_approaches_the_static_stiffness_with_the_square_of_the_frequency(
    structure, model
):
    static = scaled(structure.static.stiffness)
    d = interface_dynamic_stiffness(model, np.array([0.5, 1.0, 2.0, 4.0]), 0.0).real
    difference = [np.linalg.norm(scaled(x) - static) for x in d]
    np.testing.assert_allclose(np.log2(np.divide(difference[1:], difference[:-1])), 2.0, atol=0.05)
    slow = scaled(interface_dynamic_stiffness(model, np.array([0.01]), DAMPING)[0])
    # the damping of the slowest elastic mode is the largest term left
    first = np.sqrt(scipy.linalg.eigh(model.stiffness, model.mass, eigvals_only=True)[6])
    loss = 2 * DAMPING * 2 * np.pi * 0.01 / first
    assert np.linalg.norm(slow - static) < 2 * loss * np.linalg.norm(static)


def test_response_is_reciprocal(model):
    d = interface_dynamic_stiffness(model, np.array([1.0, 50.0, 200.0]), DAMPING)
    for matrix in d:
        assert np.abs(scaled(matrix - matrix.T)).max() < 1e-9 * np.abs(scaled(matrix)).max()


def test_response_is_passive(model):
    """No motion of the rings gains energy: the imaginary part is positive semidefinite."""
    for matrix in interface_dynamic_stiffness(model, np.geomspace(1, BAND_HZ, 30), DAMPING):
        loss = scaled(0.5 * (matrix.imag + matrix.imag.T))
        assert np.linalg.eigvalsh(loss)[0] > -1e-9 * np.abs(scaled(matrix)).max()


def test_single_degree_of_freedom_is_damped_as_told():
    """Two free masses with a spring between them: one rigid and one damped elastic mode."""
    spring, mass = 100.0, 4.0
    rigid = interface_rigid_modes(0.5)
    relative = np.hstack([-rigid[6:] @ np.linalg.inv(rigid[:6]), np.eye(6)])
    model = ReducedModel(spring * relative.T @ relative, mass * np.eye(12), 0)
    d = interface_dynamic_stiffness(model, np.array([0.7, 3.0]), DAMPING)
    omega = 2 * np.pi * np.array([0.7, 3.0])
    natural = np.sqrt(2 * spring / mass)
    elastic = mass * (natural**2 - omega**2 + 2j * DAMPING * natural * omega)
    together = -mass * omega**2
    np.testing.assert_allclose(d[:, 2, 2], 0.5 * (elastic + together), rtol=1e-10)
    np.testing.assert_allclose(d[:, 2, 8], 0.5 * (together - elastic), rtol=1e-10)


def test_definitions_coincide_at_low_frequency(structure, model):
    assert DEFINITIONS == ("transfer", "driving", "relative")
    stiffness = dynamic_stiffness(model, np.array([0.1]), DAMPING)[:, :, 0]
    expected = np.tile(fixed_stiffness(structure.static.stiffness), (3, 1))
    first = np.sqrt(scipy.linalg.eigh(model.stiffness, model.mass, eigvals_only=True)[6])
    loss = 2 * DAMPING * 2 * np.pi * 0.1 / first
    assert (np.abs(stiffness / expected - 1) < 2 * loss).all()


def test_definitions_differ_by_the_inertia_of_the_rings(structure, model):
    """Below the modes: transfer, driving and relative differ by parts of omega^2 m."""
    frequency = 2.0
    d = interface_dynamic_stiffness(model, np.array([frequency]), 0.0)[0].real
    transfer, driving, relative = dynamic_stiffness(model, np.array([frequency]), 0.0)[:, 0, 0].real
    block = d[np.ix_([2, 8], [2, 8])]
    assert transfer == pytest.approx(-block[1, 0], rel=1e-12)
    assert driving == pytest.approx(block[0, 0], rel=1e-12)
    apart = np.linalg.inv(block) @ [1, -1]
    assert relative == pytest.approx(1 / (apart[0] - apart[1]), rel=1e-12)
