"""Four reductions and the interface dynamic stiffness against the full-order system."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sparse
from conftest import DIAMETER, FEP, GAP_HEIGHT, REFERENCE_HEIGHT, THICKNESS, cylinder
from scipy.sparse.linalg import eigsh

from foilstudy.config import Dynamics
from foilstudy.config.scene import dynamics_of
from foilstudy.linalg import factorise, modes_below, shifted
from foilstudy.measure import choices
from foilstudy.measure.dynamics import (
    DEFINITIONS,
    DynamicsOptions,
    ModalDamping,
    RayleighDamping,
    ReducedModel,
    StructuralDamping,
    Structure,
    Wanted,
    completed_modes,
    directional_stiffness,
    dynamic_stiffness,
    eigenfrequency_errors,
    frequency_grid,
    full_order,
    interface_dynamic_stiffness,
    relative_error,
    residual_estimate,
)
from foilstudy.measure.dynamics.reduction import project
from foilstudy.measure.dynamics.reductions.by_need import with_enough_modes
from foilstudy.measure.dynamics.reductions.craig_bampton import CraigBampton
from foilstudy.measure.dynamics.reductions.guyan import Guyan
from foilstudy.measure.dynamics.reductions.hintz_herting import HintzHerting
from foilstudy.measure.dynamics.reductions.rational_krylov import RationalKrylov
from foilstudy.measure.dynamics.structure import INTERFACE, bordered, terms_of_sheet
from foilstudy.measure.stiffness import InterfaceSystem, fixed_stiffness
from foilstudy.measure.stiffness.rings import interface_rigid_modes
from foilstudy.model.foil import Foil
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.pipeline import vibration
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.structures import prestressed_structure, stress_free_structure
from foilstudy.pipeline.vibration import vibration_of

CUTOFF_HZ, BAND_HZ = 1000.0, 500.0
FIVE_PERCENT = ModalDamping(0.05)
UNDAMPED = ModalDamping(0.0)
WANTED = Wanted(highest_hz=BAND_HZ, damping=FIVE_PERCENT)
SCALE = np.tile([1.0, 1.0, 1.0, 10.0, 10.0, 10.0], 2)
"""Rotations as motions of the ring's edge, 1/R."""
REDUCTIONS = {
    "guyan": Guyan(WANTED),
    "craig_bampton": CraigBampton(CUTOFF_HZ, WANTED),
    "hintz_herting": HintzHerting(CUTOFF_HZ, WANTED),
    "rational_krylov": RationalKrylov(WANTED),
}


@pytest.fixture(scope="module")
def crumple(coarse_crumple):
    foil = Foil(0.2, 0.17, 0.13, 500e-6, coarse_crumple.sheet.material)
    sheet = coarse_crumple.sheet
    return Shape(foil, sheet.patch, coarse_crumple.points, sheet.reference, Corner())


@pytest.fixture(scope="module")
def structure(crumple):
    return stress_free_structure(crumple)


@pytest.fixture(scope="module")
def prestressed(crumple):
    return prestressed_structure(crumple)


@pytest.fixture(scope="module")
def models(structure):
    return {name: reduction.reduce(structure) for name, reduction in REDUCTIONS.items()}


@pytest.fixture(scope="module", params=REDUCTIONS)
def model(request, models):
    return models[request.param]


FREQUENCIES = np.array([3.0, 40.0, 120.0, 300.0, BAND_HZ])


@pytest.fixture(scope="module")
def truth(structure):
    return full_order(structure, FREQUENCIES, FIVE_PERCENT)


def scaled(matrix):
    return matrix * np.outer(SCALE, SCALE)


def matrix_error(ours, exact):
    return np.linalg.norm(scaled(ours - exact)) / np.linalg.norm(scaled(exact))


# --- the truth -----------------------------------------------------------------------------------


def undamped_full_order(structure, frequency):
    """Condensation of K - omega^2 M."""
    w2 = (2 * np.pi * frequency) ** 2
    k, m = structure.stiffness, structure.mass
    coupling = k.coupling - w2 * m.coupling
    solution = factorise((k.interior - w2 * m.interior).tocsr()).solve(coupling)
    return k.interface - w2 * m.interface - coupling.T @ solution


def chain(count=40):
    """Masses in a row between the rings, all six motions alike: a structure of few unknowns."""
    k1, m1 = 2e4, 3e-3
    main, off = np.full(count, 2 * k1), np.full(count - 1, -k1)
    k = sparse.kron(sparse.diags([off, main, off], [-1, 0, 1]), sparse.eye(6), format="csr")
    m = sparse.eye(6 * count, format="csr") * m1
    coupling = np.zeros((6 * count, INTERFACE))
    coupling[:6, :6] = coupling[-6:, 6:] = -k1 * np.eye(6)
    stiffness = InterfaceSystem(k, coupling, k1 * np.eye(INTERFACE))
    mass = InterfaceSystem(m, 0 * coupling, 0.5 * m1 * np.eye(INTERFACE))
    rigid = np.vstack([np.eye(6), np.eye(6)])
    return Structure.assembled(stiffness, mass, rigid), np.sqrt(k1 / m1), k1


def test_truth_of_modal_damping_is_the_sum_over_all_modes():
    structure, _, _ = chain()
    k, m = (bordered(x).toarray() for x in (structure.stiffness, structure.mass))
    values, shapes = scipy.linalg.eigh(k, m)
    values[:6] = 0.0
    frequencies = np.array([0.5, 7.0, 60.0, 900.0])
    ours = full_order(structure, frequencies, FIVE_PERCENT)
    for frequency, d in zip(frequencies, ours, strict=True):
        w = 2 * np.pi * frequency
        receptance = shapes[-12:] / (values - w**2 + 0.1j * np.sqrt(values) * w) @ shapes[-12:].T
        np.testing.assert_allclose(
            d, np.linalg.inv(receptance), rtol=1e-6, atol=1e-6 * abs(d).max()
        )


@pytest.mark.parametrize("damping", [StructuralDamping(0.1), RayleighDamping(3.0, 2e-5)])
def test_truth_of_other_damping_is_the_complex_dynamic_stiffness(damping):
    structure, _, _ = chain()
    k, m = (bordered(x).toarray() for x in (structure.stiffness, structure.mass))
    w = 2 * np.pi * 70.0
    if isinstance(damping, StructuralDamping):
        full = k * (1 + 0.1j) - w**2 * m
    else:
        full = k - w**2 * m + 1j * w * (3.0 * m + 2e-5 * k)
    inverse = np.linalg.inv(full)[-12:, -12:]
    ours = full_order(structure, [70.0], damping)[0]
    np.testing.assert_allclose(ours, np.linalg.inv(inverse), rtol=1e-9, atol=1e-9 * abs(ours).max())


def test_truth_of_modal_damping_needs_a_stress_free_structure(prestressed):
    with pytest.raises(ValueError, match="take structural or Rayleigh damping"):
        full_order(prestressed, [100.0], FIVE_PERCENT)


def test_dynamic_stiffness_of_a_chain_is_the_analytical_one():
    """Mass-spring chain: phase mu per spring from sin(mu/2) = omega/(2 omega0)."""
    structure, natural, k1 = chain()
    wanted = Wanted(1e-6, 1.0, 150.0, UNDAMPED)
    model = RationalKrylov(wanted).reduce(structure)
    frequencies = np.array([20.0, 67.0, 141.0])
    ours = dynamic_stiffness(model, frequencies, UNDAMPED)
    for column, frequency in enumerate(frequencies):
        mu = 2 * np.arcsin(2 * np.pi * frequency / natural / 2)
        springs = 41
        transfer = k1 * np.sin(mu) / np.sin(springs * mu)
        driving = transfer * np.cos(springs * mu)
        assert ours[0, 0, column] == pytest.approx(transfer, rel=1e-6)
        assert ours[1, 0, column] == pytest.approx(driving, rel=1e-6, abs=1e-9 * k1)


def test_truth_is_reciprocal(truth):
    for d in truth:
        assert np.abs(scaled(d - d.T)).max() < 1e-7 * np.abs(scaled(d)).max()


@pytest.mark.parametrize("ratio", [0.3, 0.7])
def test_truth_of_heavy_modal_damping(ratio):
    structure, _, _ = chain(8)
    k, m = (bordered(x).toarray() for x in (structure.stiffness, structure.mass))
    values, shapes = scipy.linalg.eigh(k, m)
    values[:6] = 0.0
    w = 2 * np.pi * 50.0
    modal = values - w**2 + 2j * ratio * np.sqrt(values) * w
    exact = np.linalg.inv(shapes[-12:] / modal @ shapes[-12:].T)
    ours = full_order(structure, [50.0], ModalDamping(ratio))[0]
    np.testing.assert_allclose(ours, exact, rtol=1e-5, atol=1e-5 * abs(exact).max())


def perfect_cylinder(element_size):
    """Without Poisson's effect, so that axial motion is that of a bar."""
    material = replace(FEP, poisson_ratio=0.0)
    sheet = cylinder(element_size, material=material)
    foil = Foil(DIAMETER, REFERENCE_HEIGHT, GAP_HEIGHT, THICKNESS, material)
    return stress_free_structure(
        Shape(foil, sheet.patch, sheet.reference, sheet.reference, Corner())
    )


def test_axial_motion_of_a_cylinder_is_that_of_a_bar():
    """EA k / sin(kL) and EA k cot(kL); the clamped slope leaves an error of first order."""
    frequency, length = 900.0, REFERENCE_HEIGHT
    k = 2 * np.pi * frequency * np.sqrt(FEP.density / FEP.youngs_modulus)
    area = np.pi * DIAMETER * THICKNESS
    exact = FEP.youngs_modulus * area * k / np.array([np.sin(k * length), np.tan(k * length)])
    ours = []
    for size in (8e-3, 4e-3):
        model = RationalKrylov(Wanted(1e-6, 1.0, 1000.0, UNDAMPED)).reduce(perfect_cylinder(size))
        ours.append(dynamic_stiffness(model, [frequency], UNDAMPED)[:2, 0, 0].real)
    np.testing.assert_allclose(2 * ours[1] - ours[0], exact, rtol=0.01)


def test_all_modes_of_a_symmetric_sheet_are_counted():
    """The rings of a perfect cylinder do not move waves of two or more lobes."""
    structure = perfect_cylinder(15e-3)
    options = DynamicsOptions(highest_hz=400.0, mode_shapes=3, eigenfrequencies=8)
    k, m = structure.stiffness.interior, structure.mass.interior
    matrix = (k - (2 * np.pi * 400.0) ** 2 * m).tocsr()
    vibration = vibration_of(structure, options)
    assert vibration.mode_count[-1] == factorise(matrix).negative_eigenvalues
    exact = np.sort(eigsh(k, 8, m, sigma=0.0, return_eigenvectors=False))
    np.testing.assert_allclose(vibration.eigenfrequencies, np.sqrt(exact) / (2 * np.pi), rtol=1e-6)


@pytest.mark.parametrize("name", REDUCTIONS)
def test_a_study_can_use_every_reduction(name, structure):
    cutoff = {"cutoff_hz": 700.0} if choices.REDUCTIONS.choice(name).has_cutoff else {}
    section = Dynamics(reduction=name, shown_max_hz=BAND_HZ, frequencies=40, **cutoff)
    vibration = vibration_of(structure, dynamics_of(section))
    valid = vibration.frequencies <= vibration.model.valid_to_hz
    known = np.isfinite(vibration.dynamic_stiffness).all(axis=(0, 1))
    assert np.array_equal(known, valid)
    assert valid.all() == (vibration.model.error_estimate <= section.tolerance)
    assert valid.all() == (name == "rational_krylov")


def test_frequencies_beyond_the_validity_are_refused(models):
    with pytest.raises(ValueError, match="900 Hz is beyond 500 Hz, up to where this"):
        dynamic_stiffness(models["rational_krylov"], [10.0, 900.0], FIVE_PERCENT)
    for bad in ([], [0.0], [-3.0], [np.nan]):
        with pytest.raises(ValueError, match="positive frequencies"):
            dynamic_stiffness(models["rational_krylov"], bad, FIVE_PERCENT)
    with pytest.raises(ValueError, match="give two positive, rising"):
        Wanted(lowest_hz=800.0, highest_hz=100.0)


def test_a_sheet_held_by_something_else_is_refused(structure):
    grounded = replace(
        structure.stiffness, interface=structure.stiffness.interface + 1e3 * np.eye(INTERFACE)
    )
    with pytest.raises(ValueError, match="held by something else than its rings"):
        Structure.assembled(grounded, structure.mass, structure.rigid_motions)


def test_rounding_counts_against_all_terms_of_the_sheet(structure):
    """Which are those of one matrix of rings and interior, with a term of low rank or without."""
    rng = np.random.default_rng(3)
    system, motions = structure.stiffness, structure.rigid_motions
    inner = structure.static.constraint_modes @ motions
    spring = rng.normal(size=(len(inner), 2)), rng.normal(size=(INTERFACE, 2)), np.array([2.0, 3.0])
    whole = np.abs(np.vstack([inner, motions]))
    plain = np.sum(whole * (abs(bordered(system)) @ whole), axis=0)
    assert terms_of_sheet(system, inner, motions) == pytest.approx(plain, rel=1e-12)
    more = np.abs(spring[0].T) @ np.abs(inner)
    held = terms_of_sheet(system.updated(*spring), inner, motions)
    assert (held > plain).all() and (held > spring[2] @ more**2).all()


# --- what every reduction keeps ------------------------------------------------------------------


def test_static_limit_is_the_condensed_stiffness(structure, model):
    assert np.array_equal(model.static_stiffness, structure.static.stiffness)


def test_constraint_and_generalised_coordinates_have_no_common_stiffness(model):
    assert not model.stiffness[:INTERFACE, INTERFACE:].any()


def test_reduced_matrices_are_symmetric_and_the_mass_is_positive(model):
    for matrix in (model.stiffness, model.mass):
        assert np.array_equal(matrix, matrix.T)
    assert np.linalg.eigvalsh(model.mass)[0] > 0


def test_reduced_matrices_are_the_galerkin_projection(structure, model):
    """T^T K T and T^T M T with T assembled in full."""
    inner = np.vstack([model.basis, np.zeros((INTERFACE, model.basis.shape[1]))])
    t = np.hstack([np.vstack([structure.static.constraint_modes, np.eye(INTERFACE)]), inner])
    for part, ours in ((structure.stiffness, model.stiffness), (structure.mass, model.mass)):
        expected = t.T @ (bordered(part) @ t)
        weight = np.sqrt(np.abs(np.outer(np.diag(expected), np.diag(expected))))
        np.testing.assert_allclose(ours / weight, expected / weight, rtol=0, atol=1e-9)


def test_reduced_model_has_six_rigid_modes(structure, model):
    raw = scipy.linalg.eigh(model.stiffness, model.mass, eigvals_only=True)
    assert np.abs(raw[:6]).max() < 1e-6 * raw[6]
    values, shapes = model.free_modes()
    assert not values[:6].any() and values[6] > 0
    rigid = model.interface_map @ shapes[:, :6]
    remainder = rigid - structure.rigid_motions @ np.linalg.lstsq(structure.rigid_motions, rigid)[0]
    assert np.abs(remainder).max() < 1e-6 * np.abs(rigid).max()


def test_rigid_motion_has_the_mass_of_the_foil(coarse_crumple, model):
    points = coarse_crumple.points
    rigid = np.zeros((model.size, 6))
    rigid[:INTERFACE] = interface_rigid_modes(points[2, -2:].mean() - points[2, :2].mean())
    inertia = rigid.T @ model.mass @ rigid
    total = coarse_crumple.sheet.section.areas.sum() * 2150.0 * 500e-6
    np.testing.assert_allclose(np.diag(inertia)[:3], total, rtol=1e-9)


def test_response_is_reciprocal(model):
    for d in interface_dynamic_stiffness(unlimited(model), FREQUENCIES, FIVE_PERCENT):
        assert np.abs(scaled(d - d.T)).max() < 1e-9 * np.abs(scaled(d)).max()


@pytest.mark.parametrize(
    "damping", [FIVE_PERCENT, StructuralDamping(0.1), RayleighDamping.between(0.05, 20, 500)]
)
def test_response_is_passive(model, damping):
    """No motion of the rings gains energy: the imaginary part is positive semidefinite."""
    for d in interface_dynamic_stiffness(unlimited(model), np.geomspace(1, BAND_HZ, 30), damping):
        loss = scaled(0.5 * (d.imag + d.imag.T))
        assert np.linalg.eigvalsh(loss)[0] > -1e-9 * np.abs(scaled(d)).max()


def test_response_does_not_depend_on_the_frame(crumple, models):
    """Turned about the axis and moved along it: the interface stiffness turns with it."""
    angle = 2 * np.pi * 5 / crumple.patch.columns
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    shift = np.array([0, 0, 0.7])[:, None, None]
    moved = replace(
        crumple,
        points=np.einsum("ij,jrc->irc", turn, crumple.points) + shift,
        reference=np.einsum("ij,jrc->irc", turn, crumple.reference) + shift,
    )
    model = RationalKrylov(WANTED).reduce(stress_free_structure(moved))
    ours = interface_dynamic_stiffness(model, FREQUENCIES, FIVE_PERCENT)
    theirs = interface_dynamic_stiffness(models["rational_krylov"], FREQUENCIES, FIVE_PERCENT)
    frame = np.kron(np.eye(4), turn)
    for a, b in zip(ours, theirs, strict=True):
        assert matrix_error(a, frame @ b @ frame.T) < 1e-4


# --- errors --------------------------------------------------------------------------------------


def unlimited(model):
    """The model without its limit of validity, to see the error beyond it."""
    return replace(model, valid_to_hz=np.nan)


def error_of(model, truth):
    ours = dynamic_stiffness(unlimited(model), FREQUENCIES, FIVE_PERCENT)
    return relative_error(ours, directional_stiffness(truth)).reshape(-1, FREQUENCIES.size).max(0)


def test_default_reduction_meets_its_tolerance(models, truth):
    model = models["rational_krylov"]
    assert model.error_estimate <= WANTED.tolerance and model.valid_to_hz == BAND_HZ
    assert error_of(model, truth).max() < WANTED.tolerance


def test_each_reduction_is_right_as_far_as_it_says(model, truth):
    inside = model.valid_to_hz >= FREQUENCIES
    assert error_of(model, truth)[inside].max(initial=0.0) < 2 * WANTED.tolerance
    if not inside.all():
        assert error_of(model, truth)[~inside].max() > 0.2 * WANTED.tolerance


def test_reductions_rank_as_theory_says(models, truth):
    """Inertia relief makes Hintz-Herting better than Craig-Bampton with the same cut-off."""
    names = "guyan", "craig_bampton", "hintz_herting"
    worst = [error_of(models[name], truth)[1:3].max() for name in names]
    assert worst[0] > 10 * worst[1] > 100 * worst[2]


@pytest.mark.parametrize("name", ["guyan", "craig_bampton", "hintz_herting"])
def test_residual_estimate_is_the_error(name, structure, models, truth):
    """Where the error is small but no rounding."""
    estimate = residual_estimate(structure, unlimited(models[name]), FREQUENCIES, FIVE_PERCENT)
    estimate, error = estimate.reshape(-1, FREQUENCIES.size).max(0), error_of(models[name], truth)
    judged = (error < 0.1) & (error > 3e-5)
    assert judged.any()
    np.testing.assert_allclose(np.log10(estimate[judged] / error[judged]), 0, atol=0.5)


def test_error_falls_with_the_fourth_power_of_the_frequency(structure, models):
    """Constraint modes and inertia relief: undamped, at low frequency."""
    frequencies = np.array([12.5, 25.0, 50.0])
    ours = interface_dynamic_stiffness(models["hintz_herting"], frequencies, UNDAMPED).real
    errors = [
        matrix_error(d, undamped_full_order(structure, f))
        for f, d in zip(frequencies, ours, strict=True)
    ]
    np.testing.assert_allclose(np.log2(np.divide(errors[1:], errors[:-1])), 4.0, atol=0.2)


@pytest.mark.parametrize("kind", [CraigBampton, HintzHerting])
def test_modes_are_added_until_the_tolerance_is_met(kind, structure):
    wanted = Wanted(0.03, 1.0, 300.0, FIVE_PERCENT)
    model = with_enough_modes(structure, kind, wanted)
    assert model.error_estimate <= 0.03
    finer = with_enough_modes(structure, kind, replace(wanted, tolerance=5e-4))
    assert finer.error_estimate <= 5e-4 or kind is CraigBampton
    assert finer.size > model.size and finer.error_estimate < model.error_estimate


def test_tighter_tolerance_takes_more_moments(structure, models):
    tighter = RationalKrylov(replace(WANTED, tolerance=1e-6)).reduce(structure)
    assert tighter.size > models["rational_krylov"].size
    assert tighter.error_estimate <= 1e-6


@pytest.mark.parametrize("blocks", [3, 20])
def test_shifts_go_on_where_another_one_has_not_been(blocks, structure):
    """Also where no change is known yet, which had once set two shifts at one frequency."""
    wanted = replace(WANTED, tolerance=1e-4)
    model = RationalKrylov(wanted, moments_per_shift=blocks, shifts_max=60).reduce(structure)
    assert model.error_estimate <= 1e-4 and model.valid_to_hz == BAND_HZ


def test_modes_that_a_model_lacks_are_found_by_moments_at_the_limit(structure, monkeypatch):
    """The eigenfrequencies are those of a search for all of them, which is not begun."""
    options = DynamicsOptions(highest_hz=BAND_HZ, eigenfrequencies=8, mode_shapes=2)
    k, m = structure.stiffness.interior, structure.mass.interior
    exact = np.sqrt(modes_below(k, m, (2 * np.pi * BAND_HZ) ** 2).eigenvalues) / (2 * np.pi)
    poor = RationalKrylov(WANTED, moments_per_shift=6, shifts_max=1).reduce(structure)
    assert (poor.clamped_eigenfrequencies() < BAND_HZ).sum() < exact.size
    monkeypatch.setattr(DynamicsOptions, "reduced", lambda *_: replace(poor, valid_to_hz=BAND_HZ))
    monkeypatch.setattr(vibration, "modes_below", None)
    found = vibration_of(structure, options)
    assert found.mode_count[-1] == exact.size
    np.testing.assert_allclose(found.eigenfrequencies, exact[:8], rtol=options.tolerance)
    np.testing.assert_allclose(found.mode_shapes.T @ (m @ found.mode_shapes), np.eye(2), atol=1e-8)


def test_modes_that_were_lacking_are_where_they_belong_once_their_number_is_right(structure):
    """A third of them would be off by up to 0.4 % without a look at how far they still move."""
    k, m = structure.stiffness.interior, structure.mass.interior
    inverse, limit = shifted(k, m, (2 * np.pi * BAND_HZ) ** 2)
    exact = np.sqrt(modes_below(k, m, limit).eigenvalues) / (2 * np.pi)
    poor = RationalKrylov(WANTED, moments_per_shift=4, shifts_max=1).reduce(structure)
    frequencies, _ = completed_modes(structure, poor, inverse, limit, 2)
    np.testing.assert_allclose(frequencies[: exact.size], exact, rtol=1e-4)
    assert frequencies[exact.size] > BAND_HZ


def test_moments_that_run_out_are_no_success(structure):
    reduction = RationalKrylov(replace(WANTED, tolerance=1e-9), moments_per_shift=4, shifts_max=2)
    model = reduction.reduce(structure)
    assert model.error_estimate > 1e-9 and model.valid_to_hz < BAND_HZ


@pytest.mark.parametrize("masses", [2, 5, 13])
def test_a_space_that_holds_everything_is_exact(masses):
    structure, _, _ = chain(masses)
    wanted = Wanted(1e-6, 1.0, 100.0, FIVE_PERCENT)
    model = RationalKrylov(wanted).reduce(structure)
    assert (model.error_estimate, model.valid_to_hz) == (0.0, 100.0)
    truth = directional_stiffness(full_order(structure, [3.0, 100.0], FIVE_PERCENT))
    ours = dynamic_stiffness(model, [3.0, 100.0], FIVE_PERCENT)
    assert relative_error(ours, truth).max() < 1e-5
    guyan = Guyan(wanted).reduce(structure)
    assert guyan.error_estimate > 0


def test_several_shifts_serve_as_well(structure, truth):
    model = RationalKrylov(WANTED, moments_per_shift=12, shifts_max=8).reduce(structure)
    assert error_of(model, truth).max() < WANTED.tolerance


def test_hintz_herting_keeps_the_elastic_modes_below_the_cutoff(structure, models):
    k, m = bordered(structure.stiffness), bordered(structure.mass)
    limit = (2 * np.pi * CUTOFF_HZ) ** 2
    below = factorise((k - limit * m).tocsr()).negative_eigenvalues
    exact = eigsh(k, below, m, sigma=-0.01 * limit, return_eigenvectors=False)
    values, _ = models["hintz_herting"].free_modes()
    np.testing.assert_allclose(values[6:below], np.sort(exact)[6:], rtol=1e-7)


@pytest.mark.parametrize("name", ["craig_bampton", "hintz_herting", "rational_krylov"])
def test_no_clamped_mode_is_missed(name, structure, models):
    """Their number below a frequency is the inertia of the full-order system there."""
    k, m = structure.stiffness.interior, structure.mass.interior
    frequencies, shapes = models[name].clamped_modes(12)
    below = models[name].clamped_eigenfrequencies()
    for limit in (200.0, BAND_HZ):
        matrix = (k - (2 * np.pi * limit) ** 2 * m).tocsr()
        assert factorise(matrix).negative_eigenvalues == (below < limit).sum()
    exact = np.sort(eigsh(k, 12, m, sigma=0.0, return_eigenvectors=False))
    exact = np.sqrt(exact) / (2 * np.pi)
    np.testing.assert_allclose(frequencies, exact, rtol=1e-3)
    error = frequencies / exact - 1
    estimate = eigenfrequency_errors(structure, frequencies, shapes)
    assert (error < 3 * estimate + 1e-9).all()
    np.testing.assert_allclose(shapes.T @ (m @ shapes), np.eye(12), atol=1e-8)


# --- pre-stress ----------------------------------------------------------------------------------


def test_prestressed_model_against_the_full_order(prestressed):
    damping = StructuralDamping(0.1)
    wanted = replace(WANTED, damping=damping)
    truth = directional_stiffness(full_order(prestressed, FREQUENCIES, damping))
    for reduction in (RationalKrylov(wanted), HintzHerting(2 * CUTOFF_HZ, wanted)):
        model = reduction.reduce(prestressed)
        inside = model.valid_to_hz >= FREQUENCIES
        ours = dynamic_stiffness(unlimited(model), FREQUENCIES, damping)
        error = relative_error(ours, truth)
        assert inside[:3].all()
        assert error[..., inside].max() < 2 * wanted.tolerance


def test_prestressed_response_with_modal_damping_is_passive(prestressed):
    model = RationalKrylov(WANTED).reduce(prestressed)
    for d in interface_dynamic_stiffness(model, np.geomspace(1, BAND_HZ, 12), FIVE_PERCENT):
        loss = scaled(0.5 * (d.imag + d.imag.T))
        assert np.linalg.eigvalsh(loss)[0] > -1e-9 * np.abs(scaled(d)).max()


def test_prestressed_structure_moves_freely_but_does_not_turn_freely(prestressed):
    stiffness, rigid = scaled(prestressed.static.stiffness), np.diag(1 / SCALE)
    size = np.abs(stiffness).max()
    assert np.abs(stiffness @ rigid @ prestressed.rigid_motions).max() < 1e-7 * size
    whole = interface_rigid_modes(0.13)
    assert np.abs(stiffness @ rigid @ whole[:, 3:5]).max() > 1e-5 * size


def test_turning_a_prestressed_structure_costs_no_energy(crumple, prestressed):
    """Energy to second order about both rings turned together, force work taken off."""
    sheet = crumple.stressed
    base = crumple.points - np.array([0, 0, crumple.points[2, :2].mean()])[:, None, None]
    force = np.empty_like(base)
    sheet.force(base, force)
    whole = interface_rigid_modes(base[2, -2:].mean())
    for axis in (3, 4, 5):
        motion = whole[:, axis]
        stiffness = motion @ prestressed.static.stiffness @ motion
        # the energy does not change; the linear force of the rings along the turned path does
        direction = np.eye(3)[axis - 3]
        top = np.cross(direction, np.cross(direction, [0, 0, base[2, -2:].mean()]))
        work = force[:, -2:].sum(axis=(1, 2)) @ top
        scale = np.abs(prestressed.static.stiffness[3:6, 3:6]).max()
        assert stiffness == pytest.approx(-work, abs=1e-4 * scale)


# --- response ------------------------------------------------------------------------------------


def test_frequency_grid_is_logarithmic_with_exact_ends():
    grid = frequency_grid(1.0, 800.0, 200)
    assert grid[0] == 1.0 and grid[-1] == 800.0 and grid.size == 200
    np.testing.assert_allclose(grid[1:] / grid[:-1], 800 ** (1 / 199), rtol=1e-13)


def test_low_frequencies_lose_no_accuracy_to_the_rigid_modes(structure, models):
    """At the lowest frequency that a study accepts."""
    static = fixed_stiffness(structure.static.stiffness)
    for definition in dynamic_stiffness(models["rational_krylov"], np.array([0.01]), FIVE_PERCENT):
        np.testing.assert_allclose(np.abs(definition[:, 0]), static, rtol=1e-5)


def test_response_approaches_the_static_stiffness_with_the_square_of_the_frequency(
    structure, model
):
    static = scaled(structure.static.stiffness)
    d = interface_dynamic_stiffness(model, np.array([0.5, 1.0, 2.0, 4.0]), UNDAMPED).real
    difference = [np.linalg.norm(scaled(x) - static) for x in d]
    np.testing.assert_allclose(np.log2(np.divide(difference[1:], difference[:-1])), 2.0, atol=0.05)


def test_single_degree_of_freedom_is_damped_as_told():
    """Two free masses with a spring between them: one rigid and one damped elastic mode."""
    spring, mass = 100.0, 4.0
    rigid = interface_rigid_modes(0.5)
    relative = np.hstack([-rigid[6:] @ np.linalg.inv(rigid[:6]), np.eye(6)])
    stiffness = spring * relative.T @ relative
    model = ReducedModel(stiffness, mass * np.eye(12), np.empty((0, 0)), 6, "by hand")
    omega = 2 * np.pi * np.array([0.7, 3.0])
    natural = np.sqrt(2 * spring / mass)
    together = -mass * omega**2
    terms = {
        FIVE_PERCENT: 2j * 0.05 * natural * omega,
        StructuralDamping(0.1): 0.1j * natural**2,
        RayleighDamping(0.0, 0.02): 0.02j * natural**2 * omega,
    }
    for damping, term in terms.items():
        d = interface_dynamic_stiffness(model, np.array([0.7, 3.0]), damping)
        elastic = mass * (natural**2 - omega**2 + term)
        np.testing.assert_allclose(d[:, 2, 2], 0.5 * (elastic + together), rtol=1e-10)
        np.testing.assert_allclose(d[:, 2, 8], 0.5 * (together - elastic), rtol=1e-10)


def test_rayleigh_damping_has_its_share_at_two_frequencies():
    damping = RayleighDamping.between(0.05, 20.0, 500.0)
    omega = 2 * np.pi * np.array([20.0, 100.0, 500.0])
    share = damping.modal(omega**2, omega).imag / (2 * omega**2)
    np.testing.assert_allclose(share[[0, 2]], 0.05, rtol=1e-12)
    assert share[1] < 0.05


def test_definitions_coincide_at_low_frequency(structure, models):
    assert DEFINITIONS == ("transfer", "driving", "relative")
    model = models["rational_krylov"]
    stiffness = dynamic_stiffness(model, np.array([0.1]), FIVE_PERCENT)[:, :, 0]
    expected = np.tile(fixed_stiffness(structure.static.stiffness), (3, 1))
    first = np.sqrt(model.free_modes()[0][6])
    loss = 2 * 0.05 * 2 * np.pi * 0.1 / first
    assert (np.abs(stiffness / expected - 1) < 2 * loss).all()


def test_definitions_differ_by_the_inertia_of_the_rings(models):
    """Below the modes: transfer, driving and relative differ by parts of omega^2 m."""
    model, frequency = models["rational_krylov"], np.array([2.0])
    d = interface_dynamic_stiffness(model, frequency, UNDAMPED)[0].real
    transfer, driving, relative = dynamic_stiffness(model, frequency, UNDAMPED)[:, 0, 0].real
    block = d[np.ix_([2, 8], [2, 8])]
    assert transfer == pytest.approx(-block[1, 0], rel=1e-12)
    assert driving == pytest.approx(block[0, 0], rel=1e-12)
    apart = np.linalg.inv(block) @ [1, -1]
    assert relative == pytest.approx(1 / (apart[0] - apart[1]), rel=1e-12)


def test_projection_of_any_basis_keeps_the_statics(structure):
    basis = np.random.default_rng(0).standard_normal((structure.mass.interior.shape[0], 7))
    reduced = project(structure, basis, "random")
    d = interface_dynamic_stiffness(reduced, np.array([0.01]), UNDAMPED)[0].real
    assert matrix_error(d, structure.static.stiffness) < 1e-4
