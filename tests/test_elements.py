"""What holds for every element: derivatives, invariance, patch tests and zero-energy modes."""

import numpy as np
import pytest
from conftest import FEP, rotation
from scipy.linalg import eigh
from wild_sheets import (
    Foil,
    extrapolated,
    flat,
    force_of,
    unflat,
    wild_open_sheet,
    wild_shape,
    wild_sheet,
)

from foilstudy.measure.stiffness import transfer_stiffness
from foilstudy.model.materials import Material
from foilstudy.model.patch import Patch, fitted_control_points, refine
from foilstudy.model.shell.elements import corner_kernel, sampling
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.model.shell.elements.full import Full
from foilstudy.model.shell.elements.one_point import OnePoint
from foilstudy.model.shell.elements.sampled import Sampled
from foilstudy.model.shell.elements.uncontrolled import Uncontrolled
from foilstudy.model.shell.shell import Shell
from foilstudy.model.shell.tangent import mass_matrix
from foilstudy.model.shell.yielding import von_mises_stress

CHUNK = corner_kernel.LANES * corner_kernel.STEPS
CHUNK_EDGES = (5, 7, 8, 9, 17, CHUNK - 1, CHUNK, CHUNK + 1, CHUNK + 2, CHUNK + 8, 2 * CHUNK + 1)

ELEMENTS = (
    Corner(),
    OnePoint(0.3),
    Sampled(sampling.one_point(0.3, 0.5)),
    Sampled(sampling.gauss(2)),
    Sampled(sampling.gauss(3)),
    Sampled(sampling.patch_wise()),
    Sampled(sampling.continuous_assumed_strain(0.0)),
    Sampled(sampling.continuous_assumed_strain(1.0)),
    Sampled(sampling.staggered(0.0)),
    Sampled(sampling.staggered(1 / 3)),
    Sampled(sampling.staggered(1.0)),
    Sampled(sampling.corner(0.05, 0.0)),
    Sampled(sampling.corner(0.05, 0.5, bending_points=2)),
)
every_element = pytest.mark.parametrize("element", ELEMENTS, ids=lambda e: e.name)
VECTORISED = (Corner(), OnePoint(0.3))
vectorised = pytest.mark.parametrize("element", VECTORISED, ids=lambda e: e.name)
either_patch = pytest.mark.parametrize("make", [wild_sheet, wild_open_sheet])


# --- derivatives -------------------------------------------------------------------------------


@every_element
@either_patch
def test_force_is_the_derivative_of_the_energy(element, make):
    sheet = make(6, 3, Foil(element))
    points = wild_shape(sheet)
    force = force_of(sheet, points)
    rng = np.random.default_rng(0)
    for _ in range(4):
        direction = rng.standard_normal(points.shape)

        def slope(step, way=direction):
            ahead, behind = (sheet.energies(points + s * step * way).total for s in (1, -1))
            return (ahead - behind) / (2 * step)

        error = extrapolated(slope, 1e-3 * sheet.patch.size_around) - (force * direction).sum()
        assert abs(error) < 1e-9 * np.linalg.norm(force) * np.linalg.norm(direction)


@every_element
@either_patch
@pytest.mark.parametrize("stressed", [True, False])
def test_tangent_is_the_derivative_of_the_force(element, make, stressed):
    sheet = make(6, 3, Foil(element))
    points = wild_shape(sheet) if stressed else sheet.reference
    matrix = sheet.tangent(points if stressed else None)
    rng = np.random.default_rng(4)
    for _ in range(2):
        direction = rng.standard_normal(points.shape)

        def slope(step, way=direction):
            ahead, behind = (force_of(sheet, points + s * step * way) for s in (1, -1))
            return (ahead - behind) / (2 * step)

        product = unflat(matrix @ flat(direction), sheet.patch)
        error = extrapolated(slope, 1e-3 * sheet.patch.size_around) - product
        assert np.linalg.norm(error) < 1e-8 * np.linalg.norm(product)


@vectorised
@either_patch
def test_tangent_is_exactly_the_hessian_column_by_column(element, make):
    """Every column, so that no block of the sparse structure is missing or misplaced."""
    sheet = make(5, 2, Foil(element))
    points = wild_shape(sheet)
    matrix = sheet.tangent(points).toarray()
    h = 1e-4 * sheet.patch.size_around
    for k in range(matrix.shape[0]):
        unit = unflat(np.eye(matrix.shape[0])[k], sheet.patch)
        by_step = [
            (force_of(sheet, points + s * unit) - force_of(sheet, points - s * unit)) / (2 * s)
            for s in (h, h / 2)
        ]
        column = flat((4 * by_step[1] - by_step[0]) / 3)
        np.testing.assert_allclose(column, matrix[:, k], rtol=0, atol=1e-8 * np.abs(matrix).max())


@vectorised
@pytest.mark.parametrize("stressed", [True, False])
def test_tangent_is_symmetric(element, stressed):
    sheet = wild_sheet(CHUNK + 1, foil=Foil(element))
    matrix = sheet.tangent(wild_shape(sheet) if stressed else None)
    assert abs(matrix - matrix.T).max() < 1e-13 * abs(matrix).max()


@every_element
def test_stressed_tangent_of_the_reference_is_the_stress_free_one(element):
    sheet = wild_sheet(7, foil=Foil(element))
    at_rest, tangent = sheet.tangent(), sheet.tangent(sheet.reference)
    assert abs(at_rest - tangent).max() < 1e-13 * abs(at_rest).max()


# --- one kernel against another ----------------------------------------------------------------


@pytest.mark.parametrize("around", CHUNK_EDGES)
@either_patch
def test_vectorised_corner_is_the_general_one(around, make):
    sheet = make(around, foil=Foil(Corner()))
    general = Sampled(sampling.corner(Corner().share(sheet.section)))
    other = Shell.elastic(sheet.patch, sheet.reference, FEP, sheet.thickness, general)
    points = wild_shape(sheet)
    force, expected = np.empty_like(points), np.empty_like(points)
    energies = sheet.force(points, force)
    np.testing.assert_allclose(energies, other.force(points, expected), rtol=1e-12)
    np.testing.assert_allclose(force, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("around", [5, CHUNK + 1])
@either_patch
def test_vectorised_one_point_is_the_general_one(around, make):
    """But for the control, which is a difference in one and a derivative in the other."""
    sheet = make(around, foil=Foil(OnePoint(0.0)))
    general = Sampled(sampling.one_point(0.0))
    other = Shell.elastic(sheet.patch, sheet.reference, FEP, sheet.thickness, general)
    points = wild_shape(sheet)
    force, expected = np.empty_like(points), np.empty_like(points)
    energies = sheet.force(points, force)
    np.testing.assert_allclose(energies, other.force(points, expected), rtol=1e-12)
    np.testing.assert_allclose(force, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


@vectorised
def test_a_rotation_by_columns_changes_nothing(element):
    """No column is special: not the seam, not the border of a chunk."""
    sheet = wild_sheet(CHUNK + 3, foil=Foil(element))
    points = wild_shape(sheet)
    turned = Shell.elastic(sheet.patch, np.roll(sheet.reference, 50, axis=2), FEP, 2e-3, element)
    force = np.roll(force_of(sheet, points), 50, axis=2)
    shifted = force_of(turned, np.roll(points, 50, axis=2))
    np.testing.assert_allclose(shifted, force, rtol=0, atol=1e-12 * np.abs(force).max())


@vectorised
def test_the_same_bits_wherever_the_memory_lies(element):
    sheet = wild_sheet(42, 10, Foil(element))
    points = wild_shape(sheet)
    rng = np.random.default_rng(0)
    force, energies, scatter = np.empty_like(points), set(), []
    for _ in range(1000):
        # rebound only once the new blocks are there, so that the heap looks different every time
        scatter = [np.empty(n, np.uint8) for n in rng.integers(1, 20_000, rng.integers(1, 30))]
        energies.add(sheet.force(points, force).tobytes() + force.tobytes())
    assert scatter and len(energies) == 1


# --- invariance --------------------------------------------------------------------------------


@every_element
@either_patch
def test_rigid_motion_costs_nothing(element, make):
    sheet = make(7, foil=Foil(element))
    moved = np.einsum("ij,jrc->irc", rotation([1, 2, 3], 2.0), sheet.reference)
    moved += np.array([0.03, -0.02, 0.05])[:, None, None]
    wild = wild_shape(sheet)
    assert sheet.energies(sheet.reference).total < 1e-26 * sheet.energies(wild).total
    assert sheet.energies(moved).total < 1e-24 * sheet.energies(wild).total
    assert np.linalg.norm(force_of(sheet, moved)) < 1e-12 * np.linalg.norm(force_of(sheet, wild))


@every_element
@either_patch
def test_objectivity(element, make):
    sheet = make(7, foil=Foil(element))
    points, turn = wild_shape(sheet), rotation([3, -1, 2], 1.0)
    moved = np.einsum("ij,jrc->irc", turn, points) + np.array([0.1, 0.2, -0.1])[:, None, None]
    assert sheet.energies(moved).total == pytest.approx(sheet.energies(points).total, rel=1e-11)
    rotated = np.einsum("ij,jrc->irc", turn, force_of(sheet, points))
    force = force_of(sheet, moved)
    np.testing.assert_allclose(force, rotated, rtol=0, atol=1e-11 * np.abs(force).max())


@every_element
def test_internal_force_is_self_equilibrated(element):
    sheet = wild_sheet(7, foil=Foil(element))
    points = wild_shape(sheet)
    force = force_of(sheet, points)
    scale = np.abs(force).sum()
    assert np.abs(force.sum(axis=(1, 2))).max() < 1e-13 * scale
    moment = np.cross(points, force, axis=0).sum(axis=(1, 2))
    assert np.abs(moment).max() < 1e-13 * scale * np.abs(points).max()


@every_element
def test_everything_is_proportional_to_youngs_modulus(element):
    stiff = Material(4 * FEP.youngs_modulus, FEP.poisson_ratio, FEP.density, FEP.yield_stress)
    sheet, stiffer = (wild_sheet(9, foil=Foil(element, material)) for material in (FEP, stiff))
    points = wild_shape(sheet)
    # a power of two, so that even the rounding is the same
    assert stiffer.energies(points).total == 4 * sheet.energies(points).total
    assert np.array_equal(force_of(stiffer, points), 4 * force_of(sheet, points))
    assert (stiffer.tangent(points) != 4 * sheet.tangent(points)).nnz == 0
    stress = von_mises_stress(sheet, points)
    np.testing.assert_allclose(von_mises_stress(stiffer, points), 4 * stress, rtol=1e-15)


# --- patch tests -------------------------------------------------------------------------------


def oblique_plate(element, thickness=1e-3):
    """A flat plate of 8 x 7 parallelograms, and its area."""
    patch = Patch(8, 7, 0.011, 0.009, periodic=False)
    # linear in the parameters, so the spline has it exactly
    points = fitted_control_points(patch, lambda s, z: np.stack([s + 0.4 * z, z, 0 * s]))
    area = patch.elements_around * patch.elements_along * patch.size_around * patch.size_along
    return Shell.elastic(patch, points, FEP, thickness, element), area


def plate_energy(strain, stiffness):
    """Isotropic quadratic form per area of a symmetric 2 x 2 strain, Timoshenko's C or D."""
    nu = FEP.poisson_ratio
    trace = strain[0, 0] + strain[1, 1]
    determinant = strain[0, 0] * strain[1, 1] - strain[0, 1] ** 2
    return 0.5 * stiffness * (trace**2 - 2 * (1 - nu) * determinant)


def modulus(sheet):
    return FEP.youngs_modulus * sheet.thickness / (1 - FEP.poisson_ratio**2)


@every_element
def test_uniform_strain_is_exact_on_an_oblique_grid(element):
    """Energy of a finite stretch and shear, and no force where the sheet goes on all round."""
    sheet, area = oblique_plate(element)
    gradient = np.array([[1.2, 0.3, 0.0], [-0.1, 0.8, 0.0], [0.2, -0.1, 1.0]])
    points = np.einsum("ij,jrc->irc", gradient, sheet.reference)
    strain = 0.5 * ((gradient.T @ gradient)[:2, :2] - np.eye(2))
    energies = sheet.energies(points)
    exact = area * plate_energy(strain, modulus(sheet))
    assert energies.membrane == pytest.approx(exact, rel=1e-12)
    # the general kernel forms the control from pairs of samples, which cancel to rounding
    assert energies.bending + abs(energies.stabilisation) < 1e-15 * exact
    force = force_of(sheet, points)
    assert np.abs(force[:, 2:-2, 2:-2]).max() < 1e-12 * np.abs(force).max()


@every_element
@pytest.mark.parametrize(
    "curvature", [[[1, 0], [0, 0]], [[0, 1], [1, 0]], [[0.5, -0.4], [-0.4, 1]]]
)
def test_uniform_curvature_is_exact_on_an_oblique_grid(element, curvature):
    """w = x.k.x/2 bends a plate by k everywhere; the spline has every quadratic polynomial."""
    sheet, area = oblique_plate(element)
    patch = sheet.patch
    k = np.array(curvature, float)

    def height(s, z):
        x = np.stack([s + 0.4 * z, z])
        return np.stack([0 * s, 0 * s, 0.5 * np.einsum("arc,ab,brc->rc", x, k, x)])

    motion = fitted_control_points(patch, height)
    matrix = sheet.tangent()
    force = matrix @ flat(motion)
    exact = area * plate_energy(k, modulus(sheet) * sheet.thickness**2 / 12)
    assert 0.5 * flat(motion) @ force == pytest.approx(exact, rel=1e-9)
    inner = unflat(force, patch)[:, 2:-2, 2:-2]
    assert np.abs(inner).max() < 1e-9 * np.abs(force).max()


# --- zero-energy modes -------------------------------------------------------------------------


SLENDERNESS = pytest.mark.parametrize("slenderness", [0.01, 0.1, 0.2])
SIDE = 0.04


def free_panel(element, elements, thickness):
    """Part of a cylinder with four free edges."""
    patch = Patch(elements, elements, SIDE / elements, SIDE / elements, periodic=False)
    panel = fitted_control_points(
        patch, lambda s, z: np.stack([0.1 * np.cos(s / 0.1), 0.1 * np.sin(s / 0.1), z])
    )
    return Shell.elastic(patch, panel, FEP, thickness, element)


def zero_modes(element, slenderness):
    values = np.linalg.eigvalsh(free_panel(element, 8, slenderness * SIDE / 8).tangent().toarray())
    zero = np.abs(values) < 1e-14 * values[-1]
    assert values[~zero].min() > 1e-10 * values[-1]  # a gap of orders, not a matter of the limit
    return zero.sum()


@SLENDERNESS
@pytest.mark.parametrize(
    "element",
    [e for e in ELEMENTS if not e.name.startswith(("patch", "CAS", "staggered"))],
    ids=lambda e: e.name,
)
def test_a_free_panel_has_exactly_six_rigid_modes(element, slenderness):
    assert zero_modes(element, slenderness) == 6


@pytest.mark.parametrize(
    ("variant", "count"),
    [(sampling.staggered(), 8), (sampling.continuous_assumed_strain(), 7)],
    ids=lambda v: getattr(v, "name", ""),
)
def test_elements_without_control_have_spurious_modes_at_free_edges(variant, count):
    """Why they are no choice for open patches; clamped rings hold these modes."""
    assert zero_modes(Sampled(variant), 0.2) == count


def checkerboard_energy(element):
    """Energy of a plate whose control points go a hundredth of an element to and fro by turns.

    Over that of a stretch of one per cent.
    """
    sheet, area = oblique_plate(element)
    rows, columns = np.indices(sheet.patch.shape[1:])
    amplitude = 0.01 * sheet.patch.size_around
    points = sheet.reference.copy()
    points[0] += amplitude * np.where((rows + columns) % 2, 1.0, -1.0)
    stretched = plate_energy(np.diag([0.01, 0.0]), modulus(sheet)) * area
    return sheet.energies(points).total / stretched


def test_only_the_element_without_control_is_blind_to_a_checkerboard():
    assert checkerboard_energy(Uncontrolled()) < 1e-3
    assert checkerboard_energy(Full()) > 0.1
    assert zero_modes(Uncontrolled(), 0.2) > 6
    assert zero_modes(Full(), 0.2) == 6


def frequencies(element, elements, thickness, count=12):
    """Lowest elastic natural frequencies of the free panel, rad/s."""
    sheet = free_panel(element, elements, thickness)
    mass = mass_matrix(sheet.patch, FEP.density * thickness * sheet.section.areas)
    squares = eigh(
        sheet.tangent().toarray(), mass.toarray(), eigvals_only=True,
        subset_by_index=(6, 5 + count),
    )  # fmt: skip
    return np.sqrt(squares)


@pytest.mark.parametrize("slenderness", [0.02, 0.2])
def test_the_default_has_no_soft_modes_that_are_not_of_the_shell(slenderness):
    """A checkerboard would show as a low frequency that a fully integrated finer mesh lacks."""
    thickness = slenderness * SIDE / 8
    coarse = frequencies(Corner(), 8, thickness)
    fine = frequencies(Sampled(sampling.gauss(2)), 20, thickness)
    np.testing.assert_allclose(coarse, fine, rtol=0.12)
    assert (coarse > 0.95 * fine).all()


@pytest.mark.parametrize("around", [9, 12, 20, 24])
def test_an_open_patch_whose_ends_meet_is_no_other(around):
    """What the vectorised kernel reads beyond the ends may have no area."""
    along = 4
    patch = Patch(around, along, 0.3 / around, 0.05, periodic=False)
    closed = np.arange(patch.columns) % around
    angle = 2 * np.pi * closed / around
    points = np.empty(patch.shape)
    points[0], points[1] = 0.05 * np.cos(angle), 0.05 * np.sin(angle)
    points[2] = 0.05 * (np.arange(patch.rows) - 0.5)[:, None]
    assert np.array_equal(points[..., :2], points[..., -2:])
    bent = points * np.array([1.1, 0.9, 1.0])[:, None, None]
    share = Corner().share(Shell.elastic(patch, points, FEP, 1e-4).section)
    forces = []
    for element in (Corner(), Sampled(sampling.corner(share))):
        shell = Shell.elastic(patch, points, FEP, 1e-4, element)
        force = np.empty_like(points)
        assert np.isfinite(shell.force(bent, force)).all()
        forces.append(force)
    np.testing.assert_allclose(*forces, rtol=0, atol=1e-9 * np.abs(forces[1]).max())


def test_full_integration_locks_at_an_unresolved_fold(coarse_crumple):
    """It is far stiffer than the default on the mesh of the crumple, and less so on a finer one."""
    sheet, points = coarse_crumple.sheet, coarse_crumple.points

    def axial(element, patch, shape):
        relieved = Shell.elastic(patch, shape, FEP, sheet.thickness, element)
        return transfer_stiffness(relieved)[0]

    default, full = (axial(e, sheet.patch, points) for e in (Corner(), Full()))
    finer = axial(Full(), sheet.patch.refined(), refine(points))
    assert full > 1.5 * default
    assert default < finer < 0.8 * full
