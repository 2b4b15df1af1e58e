"""Motion per force of the rings: against dynamic stiffness, matrices, rigid body and statics."""

import numpy as np
import pytest
from conftest import FOIL

from foilstudy.measure.dynamics import (
    CONDITIONS,
    DynamicsOptions,
    EvenGrid,
    ModalDamping,
    RayleighDamping,
    StructuralDamping,
    accelerance,
    interface_dynamic_stiffness,
    receptance,
    resonances,
)
from foilstudy.measure.dynamics.damping_matrix import damping_matrix
from foilstudy.measure.dynamics.receptance import LINES_MAX, LINES_MIN, LINES_PER_BANDWIDTH
from foilstudy.measure.dynamics.structure import bordered
from foilstudy.measure.stiffness import DOF_NAMES
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.structures import stress_free_structure

BAND_HZ = 300.0
FIVE_PERCENT = ModalDamping(0.05)
DAMPINGS = [FIVE_PERCENT, StructuralDamping(0.1), RayleighDamping.between(0.05, 20.0, 300.0)]
FREQUENCIES = np.array([1.0, 17.0, 60.0, 143.0, 300.0])
AXIAL = DOF_NAMES.index("top_uz")


@pytest.fixture(scope="module")
def structure(coarse_crumple):
    sheet = coarse_crumple.sheet
    shape = Shape(FOIL, sheet.patch, coarse_crumple.points, sheet.reference, sheet.element)
    return stress_free_structure(shape)


@pytest.fixture(scope="module")
def model(structure):
    return DynamicsOptions(highest_hz=BAND_HZ).reduced(structure)


@pytest.mark.parametrize("damping", DAMPINGS)
@pytest.mark.parametrize("condition", CONDITIONS)
def test_receptance_times_dynamic_stiffness_of_what_moves_is_the_identity(
    model, damping, condition
):
    moving = CONDITIONS[condition]
    stiffness = interface_dynamic_stiffness(model, FREQUENCIES, damping)[:, moving, moving]
    ours = receptance(model, FREQUENCIES, damping, condition)
    size = {"free": 12, "bottom_held": 6}[condition]
    assert ours.shape == (len(FREQUENCIES), size, size)
    # each entry against those of its row and column, as translations and rotations mix
    product = ours @ stiffness
    scale = np.abs(ours) @ np.abs(stiffness)
    assert (np.abs(product - np.eye(size)) / scale).max() < 1e-11


@pytest.mark.parametrize("condition", CONDITIONS)
def test_receptance_is_that_of_the_matrices_without_the_held_coordinates(model, condition):
    """Rows and columns of held motions left out of M, C and K: no dynamic stiffness on the way."""
    kept = np.arange(CONDITIONS[condition].start, model.size)
    block = np.ix_(kept, kept)
    k, m, c = model.stiffness, model.mass, damping_matrix(model, FIVE_PERCENT)
    for frequency, ours in zip(
        FREQUENCIES, receptance(model, FREQUENCIES, FIVE_PERCENT, condition)
    ):
        omega = 2 * np.pi * frequency
        whole = np.linalg.inv(k[block] - omega**2 * m[block] + 1j * omega * c[block])
        expected = whole[: len(ours), : len(ours)]
        np.testing.assert_allclose(ours, expected, rtol=0, atol=1e-8 * np.abs(expected).max())


@pytest.mark.parametrize("condition", CONDITIONS)
def test_receptance_is_symmetric_and_dissipates(model, condition):
    """Power of any harmonic force: the imaginary part is negative semi-definite."""
    for h in receptance(model, FREQUENCIES, FIVE_PERCENT, condition):
        np.testing.assert_allclose(h, h.T, rtol=0, atol=1e-11 * np.abs(h).max())
        # scaled to the like of m/N, as a rotation per moment is far larger
        scale = 1 / np.sqrt(np.abs(np.diag(h)))
        assert np.linalg.eigvalsh(h.imag * np.outer(scale, scale)).max() < 1e-10


def test_accelerance_is_minus_omega_squared_times_receptance(model):
    h = receptance(model, FREQUENCIES, FIVE_PERCENT, "free")
    for frequency, a, each in zip(FREQUENCIES, accelerance(h, FREQUENCIES), h):
        np.testing.assert_allclose(a, -((2 * np.pi * frequency) ** 2) * each, rtol=1e-14)


def test_free_accelerance_at_low_frequency_is_that_of_the_rigid_body(structure, model):
    """R (R^T M R)^-1 R^T of the rigid motions R, from the mass matrix of the whole foil."""
    motion = structure.rigid_motions
    shapes = np.vstack([structure.static.constraint_modes @ motion, motion])
    inertia = shapes.T @ (bordered(structure.mass) @ shapes)
    expected = motion @ np.linalg.solve(inertia, motion.T)
    low = np.array([0.05])
    ours = accelerance(receptance(model, low, FIVE_PERCENT, "free"), low)[0]
    np.testing.assert_allclose(ours.real, expected, rtol=0, atol=1e-5 * np.abs(expected).max())
    foil = FOIL.material.density * np.pi * FOIL.diameter * FOIL.reference_height * FOIL.thickness
    # a crumpled foil has its centre of mass a little beside the axis, which adds a rotation
    assert ours[AXIAL, AXIAL].real == pytest.approx(1 / foil, rel=5e-3)
    assert ours[2, AXIAL].real == pytest.approx(1 / foil, rel=5e-3)


def test_receptance_with_the_bottom_held_tends_to_the_static_flexibility(model):
    low = np.array([0.05])
    ours = receptance(model, low, FIVE_PERCENT, "bottom_held")[0]
    expected = np.linalg.inv(model.static_stiffness[6:, 6:])
    np.testing.assert_allclose(ours.real, expected, rtol=0, atol=1e-5 * np.abs(expected).max())
    # at the force the motion follows it, far less than 1/k against all other motions held
    assert ours[AXIAL - 6, AXIAL - 6].real > 1 / model.static_stiffness[AXIAL, AXIAL]


@pytest.mark.parametrize("damping", DAMPINGS)
@pytest.mark.parametrize("condition", CONDITIONS)
def test_half_power_bandwidth_is_that_of_the_damping(model, damping, condition):
    """2 zeta f of the free modes; whatever the condition, what the damping says of a frequency."""
    hz, widths = resonances(model, damping, condition)
    assert hz[0] > 1 and (widths > 0).all()
    if condition == "free" and isinstance(damping, ModalDamping):
        np.testing.assert_allclose(widths, 2 * damping.ratio * hz, rtol=1e-9)
    if isinstance(damping, StructuralDamping):  # the same share of any stiffness
        np.testing.assert_allclose(widths[:10], damping.loss_factor * hz[:10], rtol=1e-6)
    if isinstance(damping, RayleighDamping):
        omega = 2 * np.pi * hz[:10]
        expected = damping.mass_coefficient + damping.stiffness_coefficient * omega**2
        np.testing.assert_allclose(widths[:10], expected / (2 * np.pi), rtol=1e-6)


def test_first_resonance_with_the_bottom_held_is_where_its_response_peaks(model):
    hz, widths = resonances(model, FIVE_PERCENT, "bottom_held")
    near = np.linspace(hz[0] - 2 * widths[0], hz[0] + 2 * widths[0], 401)
    response = receptance(model, near, FIVE_PERCENT, "bottom_held")
    trace = np.abs(np.einsum("fii->fi", response[:, :3, :3])).sum(axis=1)
    assert abs(near[trace.argmax()] - hz[0]) < 0.5 * widths[0]


@pytest.mark.parametrize("ratio", [0.3, 0.05, 0.02, 0.001])
def test_even_grid_shows_the_sharpest_resonance_or_says_that_it_does_not(model, ratio):
    grid = EvenGrid.of(model, ModalDamping(ratio), 1.0, BAND_HZ)
    steps = np.diff(grid.frequencies)
    np.testing.assert_allclose(steps, grid.spacing, rtol=1e-9)
    multiples = grid.frequencies / grid.spacing
    np.testing.assert_allclose(multiples, np.round(multiples), rtol=0, atol=1e-9)
    assert float(f"{grid.spacing:.0e}") == grid.spacing  # one digit, so that a file holds it
    assert grid.frequencies[0] >= 1.0 - 1e-12 and grid.frequencies[-1] <= BAND_HZ + 1e-9
    assert LINES_MIN * 0.99 <= len(grid.frequencies) <= LINES_MAX
    enough = grid.spacing * LINES_PER_BANDWIDTH <= grid.bandwidth_hz
    assert enough == (ratio > 0.001)
    assert ("COARSE" in grid.words) != enough
    assert len(grid.words) <= 80
    widths = np.concatenate([resonances(model, ModalDamping(ratio), c) for c in CONDITIONS], axis=1)
    inside = (widths[0] >= 1.0) & (widths[0] <= BAND_HZ)
    assert grid.bandwidth_hz == pytest.approx(widths[1][inside].min())


def test_even_grid_without_a_resonance_says_so(model):
    grid = EvenGrid.of(model, FIVE_PERCENT, 0.5, 2.0)
    assert "no resonance" in grid.words and grid.frequencies[-1] == pytest.approx(2.0)
