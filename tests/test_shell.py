"""The sheet against closed forms, and its first element against tensor algebra.

What holds for every element (derivatives, invariance, patch tests) is in test_elements.
"""

import numpy as np
import pytest
from conftest import DIAMETER, FEP, THICKNESS, cylinder
from scipy.interpolate import BSpline
from wild_sheets import RADIUS, Foil, flat, force_of, wild_shape, wild_sheet

from foilstudy.measure.stiffness.rings import rigid_motion
from foilstudy.model.patch import Patch, refine
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.model.shell.elements.one_point import OnePoint
from foilstudy.model.shell.elements.one_point_kernel import CHUNK
from foilstudy.model.shell.shell import Shell
from foilstudy.model.shell.tangent import mass_matrix
from foilstudy.model.shell.yielding import beyond_yield_share, von_mises_stress

CHUNK_EDGES = (5, CHUNK - 1, CHUNK, CHUNK + 1, CHUNK + 2, 2 * CHUNK, 2 * CHUNK + 1)


ONE_POINT = Foil(element=OnePoint(0.3))


def one_point_sheet(around, along=3):
    return wild_sheet(around, along, ONE_POINT)


# --- an independent evaluation of the same model -------------------------------------------------


BASIS = BSpline.basis_element(np.arange(4.0))


def derivative(points, patch, at, orders):
    """Parameter derivative of the spline at (around, along) in every element, by SciPy."""
    around, along = (
        # control points 0, 1, 2 of an element carry the last, middle and first third of the basis
        [float(BASIS(2 - k + local, nu=order)) / size**order for k in range(3)]
        for local, order, size in zip(
            at, orders, (patch.size_around, patch.size_along), strict=True
        )
    )
    out = 0.0
    for j in range(3):
        for i in range(3):
            rows = points[:, j : j + patch.elements_along]
            out = out + along[j] * around[i] * np.roll(rows, -i, axis=2)
    return out


def forms(points, patch, at=(0.5, 0.5)):
    """First and second fundamental forms, (2, 2, elements_along, elements_around) each."""
    a1, a2, a11, a22, a12 = (
        derivative(points, patch, at, orders) for orders in ((1, 0), (0, 1), (2, 0), (0, 2), (1, 1))
    )
    normal = np.cross(a1, a2, axis=0)
    normal = normal / np.sqrt((normal**2).sum(axis=0))  # not a norm: it must stay analytic
    first = np.array([[(a * b).sum(axis=0) for b in (a1, a2)] for a in (a1, a2)])
    second = [[(s * normal).sum(axis=0) for s in row] for row in ((a11, a12), (a12, a22))]
    return first, np.array(second)


def metric_slope(points, patch, direction):
    """Derivative of the metric at the middles; five points are exact for its fourth degree."""
    step = 0.125
    at = [0.5 + k * step * np.eye(2)[direction] for k in (-2, -1, 1, 2)]
    values = [forms(points, patch, p)[0] for p in at]
    size = (patch.size_around, patch.size_along)[direction]
    return (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12 * step * size)


def reference_energies(sheet, points):
    """Membrane, bending and stabilisation energy by tensor algebra, analytic in `points`."""
    patch, nu = sheet.patch, sheet.material.poisson_ratio
    first0, second0 = forms(sheet.reference, patch)
    first, second = forms(points, patch)
    inverse = np.moveaxis(np.linalg.inv(np.moveaxis(first0, (0, 1), (-2, -1))), (-2, -1), (0, 1))
    a = inverse
    law = nu * np.einsum("abji,cdji->abcdji", a, a) + 0.5 * (1 - nu) * (
        np.einsum("acji,bdji->abcdji", a, a) + np.einsum("adji,bcji->abcdji", a, a)
    )
    area = np.sqrt(first0[0, 0] * first0[1, 1] - first0[0, 1] ** 2)
    area = area * patch.size_around * patch.size_along
    modulus = sheet.material.youngs_modulus * sheet.thickness / (1 - nu**2)

    def energy(strain, factor):
        return (
            0.5
            * factor
            * modulus
            * np.einsum("ji,abji,abcdji,cdji->", area, strain, law, strain, optimize=True)
        )

    bend = sheet.thickness**2 / 12
    stabilisation = 0.0
    for direction, size in enumerate((patch.size_around, patch.size_along)):
        slope = 0.5 * (
            metric_slope(points, patch, direction) - metric_slope(sheet.reference, patch, direction)
        )
        stabilisation += energy(slope, sheet.element.stabilisation * size**2 / 12)
    return np.array(
        [energy(0.5 * (first - first0), 1.0), energy(second0 - second, bend), stabilisation]
    )


@pytest.mark.parametrize("around", CHUNK_EDGES)
def test_energies_equal_an_independent_evaluation(around):
    sheet = one_point_sheet(around)
    points = wild_shape(sheet)
    energies = sheet.energies(points)
    ours = [energies.membrane, energies.bending, energies.stabilisation]
    np.testing.assert_allclose(ours, reference_energies(sheet, points), rtol=1e-12)
    assert energies.total == sum(ours)


@pytest.mark.parametrize("around", CHUNK_EDGES)
def test_force_is_the_derivative_of_the_independent_energy(around):
    """Complex-step derivatives of the reference energy have no truncation error."""
    sheet = one_point_sheet(around)
    points = wild_shape(sheet)
    force = force_of(sheet, points)
    rng = np.random.default_rng(0)
    directions = [rng.standard_normal(points.shape) for _ in range(3)]
    for column in {0, 1, 2, around - 2, around - 1, min(CHUNK, around - 1), min(CHUNK, around) - 1}:
        local = np.zeros_like(points)
        local[:, :, column] = rng.standard_normal(points.shape[:2])
        directions.append(local)
    for direction in directions:
        slope = reference_energies(sheet, points + 1e-30j * direction).imag.sum() / 1e-30
        scale = np.linalg.norm(force) * np.linalg.norm(direction)
        assert abs((force * direction).sum() - slope) < 1e-12 * scale


def test_force_is_the_derivative_of_the_energy_at_every_control_point():
    sheet = one_point_sheet(5)
    points = wild_shape(sheet)
    force = force_of(sheet, points)
    expected = np.empty_like(force)
    for index in np.ndindex(points.shape):
        moved = points.astype(complex)
        moved[index] += 1e-30j
        expected[index] = reference_energies(sheet, moved).imag.sum() / 1e-30
    np.testing.assert_allclose(force, expected, rtol=0, atol=1e-12 * np.abs(force).max())


def test_a_patch_too_narrow_for_the_stencil_is_refused():
    sheet = wild_sheet(4)
    with pytest.raises(ValueError, match="at least 5 elements around, not 4"):
        sheet.tangent()


def test_points_of_another_patch_are_refused():
    sheet = wild_sheet(5)
    with pytest.raises(ValueError, match="the patch needs"):
        Shell.elastic(sheet.patch, sheet.reference[:, 1:], FEP, 1e-3)


# --- closed forms --------------------------------------------------------------------------------


ELEMENTS = pytest.mark.parametrize("element", [Corner(), OnePoint()], ids=lambda e: e.name)


def made_of(element, size, thickness=THICKNESS):
    """Perfect cylinder of another element."""
    sheet = cylinder(size, thickness=thickness)
    return Shell.elastic(sheet.patch, sheet.reference, FEP, thickness, element)


def stretched(sheet, hoop=1.0, axial=1.0):
    return sheet.reference * np.array([hoop, hoop, axial])[:, None, None]


def modulus(sheet):
    return sheet.material.youngs_modulus * sheet.thickness / (1 - sheet.material.poisson_ratio**2)


def sheet_area():
    return np.pi * DIAMETER * 0.17


def rates(errors):
    """Observed orders under halving of the elements."""
    return np.log2(np.divide(errors[:-1], errors[1:]))


SIZES = (10e-3, 5e-3, 2.5e-3)


@ELEMENTS
def test_axial_stretch(element):
    strain, errors = 0.5 * (1.1**2 - 1), []
    for size in SIZES:
        sheet = made_of(element, size)
        energies = sheet.energies(stretched(sheet, axial=1.1))
        exact = 0.5 * modulus(sheet) * strain**2
        assert energies.membrane == pytest.approx(exact * sheet.section.areas.sum(), rel=1e-12)
        assert energies.stabilisation < 1e-25 * energies.membrane
        errors.append(energies.membrane / (exact * sheet_area()) - 1)
    # the control radius makes the area exact to fourth order (test_patch)
    np.testing.assert_allclose(rates(errors), 4.0, atol=0.1)


@pytest.mark.parametrize(("element", "order"), [(Corner(), 2.0), (OnePoint(), 4.0)])
def test_membrane_energy_of_hoop_stretch(element, order):
    """The control radius makes the metric right in the middle of an element, not at its corners."""
    strain, errors = 0.5 * (1.1**2 - 1), []
    for size in SIZES:
        sheet = made_of(element, size)
        exact = 0.5 * modulus(sheet) * strain**2 * sheet_area()
        errors.append(sheet.energies(stretched(sheet, hoop=1.1)).membrane / exact - 1)
    np.testing.assert_allclose(rates(errors), order, atol=0.1)


def test_bending_energy_of_hoop_stretch():
    """With fold measure 0, b_11 grows with the radius, from A_11 / R to 1.1 A_11 / R."""
    errors = []
    for size in SIZES:
        sheet = made_of(OnePoint(), size)
        exact = 0.5 * modulus(sheet) * THICKNESS**2 / 12 * (0.1 / RADIUS) ** 2 * sheet_area()
        errors.append(sheet.energies(stretched(sheet, hoop=1.1)).bending / exact - 1)
    np.testing.assert_allclose(rates(errors), 2.0, atol=0.05)


def test_hoop_stretch_does_not_bend_the_corner_element():
    """With fold measure 1 the curvature counts per stretched area, and b_11 J_0/J stays."""
    energies = (sheet := made_of(Corner(), 10e-3)).energies(stretched(sheet, hoop=1.1))
    assert energies.bending < 1e-25 * energies.membrane


@ELEMENTS
def test_twist(element):
    """Shear, with the axial stretch that a finite twist brings along."""
    errors = []
    for size in SIZES:
        sheet = made_of(element, size)
        angle = 2.0 * sheet.reference[2]
        x, y, z = sheet.reference
        points = np.array([x * np.cos(angle) - y * np.sin(angle),
                           x * np.sin(angle) + y * np.cos(angle), z])  # fmt: skip
        shear = 2.0 * RADIUS
        density = (
            0.5
            * modulus(sheet)
            * ((0.5 * shear**2) ** 2 + 0.5 * (1 - FEP.poisson_ratio) * shear**2)
        )
        errors.append(sheet.energies(points).membrane / (density * sheet_area()) - 1)
    np.testing.assert_allclose(rates(errors), 2.0, atol=0.1)


@ELEMENTS
@pytest.mark.parametrize("waves", [2, 3])
def test_inextensional_bending(element, waves):
    """w = a cos(n theta), v = -(a/n) sin(n theta) changes the curvature by (n^2 - 1) w / R^2."""
    bending_errors, membrane_shares = [], []
    for size in SIZES:
        sheet = made_of(element, size, 2e-3)
        theta = 2 * np.pi * np.arange(sheet.patch.columns) / sheet.patch.columns
        w, v = np.cos(waves * theta), -np.sin(waves * theta) / waves
        motion = np.zeros(sheet.patch.shape)
        motion[0] = w * np.cos(theta) - v * np.sin(theta)
        motion[1] = w * np.sin(theta) + v * np.cos(theta)
        amplitude = 1e-6 * RADIUS
        either = [sheet.energies(sheet.reference + s * amplitude * motion) for s in (1, -1)]
        curvature = (waves**2 - 1) * amplitude / RADIUS**2
        exact = 0.5 * modulus(sheet) * 2e-3**2 / 12 * 0.5 * curvature**2 * sheet_area()
        bending = 0.5 * sum(e.bending for e in either)
        bending_errors.append(bending / exact - 1)
        membrane_shares.append(0.5 * sum(e.membrane for e in either) / bending)
    np.testing.assert_allclose(rates(bending_errors), 2.0, atol=0.1)
    assert (rates(membrane_shares) > 1.9).all()  # no membrane locking in the limit


@ELEMENTS
def test_exact_refinement_of_a_smooth_shape_converges(element):
    """Energy of one and the same smooth deformation, exactly refined: second order."""
    sheet = made_of(element, 10e-3, 5e-3)
    theta = 2 * np.pi * np.arange(sheet.patch.columns) / sheet.patch.columns
    phase = np.pi * sheet.reference[2] / 0.17
    points = sheet.reference * np.array([1, 1, 0.95])[:, None, None]
    points[:2] *= 1 + 0.05 * np.cos(2 * theta) * np.sin(phase)
    energies = []
    patch, reference = sheet.patch, sheet.reference
    for _ in range(4):
        model = Shell.elastic(patch, reference, FEP, 5e-3, element)
        energies.append(model.energies(points).membrane)
        patch, reference, points = patch.refined(), refine(reference), refine(points)
    np.testing.assert_allclose(rates(np.diff(energies)), 2.0, atol=0.1)


# --- von Mises stress ----------------------------------------------------------------------------


def test_von_mises_of_uniaxial_stress():
    """Hoop contraction -nu e under the axial strain e leaves the axial stress E e alone."""
    strain = 0.01
    # so thin that the change of curvature does not matter
    sheet = cylinder(10e-3, thickness=1e-15)
    nu = FEP.poisson_ratio
    shape = stretched(sheet, hoop=np.sqrt(1 - 2 * nu * strain), axial=np.sqrt(1 + 2 * strain))
    np.testing.assert_allclose(von_mises_stress(sheet, shape), 650e6 * strain, rtol=1e-3)


def test_von_mises_of_constrained_stretch():
    """Without hoop strain the stresses are (e, nu e) E / (1 - nu^2)."""
    strain, nu = 0.01, FEP.poisson_ratio
    sheet = cylinder(10e-3)
    shape = stretched(sheet, axial=np.sqrt(1 + 2 * strain))
    expected = 650e6 / (1 - nu**2) * strain * np.sqrt(1 - nu + nu**2)
    np.testing.assert_allclose(von_mises_stress(sheet, shape), expected, rtol=1e-11)


def test_von_mises_takes_the_worse_face():
    """Hoop stretch: the bending strain (t/2)(r - 1)/R is opposite on the two faces."""
    ratio, nu = 1.01, FEP.poisson_ratio
    errors = []
    for size in SIZES:
        sheet = cylinder(size, thickness=10e-3)
        membrane, bending = 0.5 * (ratio**2 - 1), 5e-3 * (ratio - 1) / RADIUS
        expected = 650e6 / (1 - nu**2) * (membrane + bending) * np.sqrt(1 - nu + nu**2)
        errors.append(von_mises_stress(sheet, stretched(sheet, hoop=ratio)).max() / expected - 1)
    np.testing.assert_allclose(rates(errors), 2.0, atol=0.05)


def test_share_beyond_yield_is_a_share_of_area():
    sheet = cylinder(10e-3)
    limit = FEP.yield_stress / (650e6 / (1 - 0.4**2) * np.sqrt(1 - 0.4 + 0.4**2))
    below, above = (np.sqrt(1 + 2 * factor * limit) for factor in (0.999, 1.001))
    assert beyond_yield_share(sheet, stretched(sheet, axial=below)) == 0.0
    assert beyond_yield_share(sheet, stretched(sheet, axial=above)) == 1.0
    half = sheet.reference.copy()
    rows = sheet.patch.rows // 2
    half[2, rows:] = half[2, rows - 1] + above * (half[2, rows:] - half[2, rows - 1])
    # only the elements whose middle slope is stretched throughout lie beyond
    full = sheet.patch.elements_along - (rows - 1)
    expected = full / sheet.patch.elements_along
    assert beyond_yield_share(sheet, half) == pytest.approx(expected, rel=1e-12)


# --- mass ----------------------------------------------------------------------------------------


def cylinder_mass(size):
    sheet = cylinder(size)
    masses = FEP.density * THICKNESS * sheet.section.areas
    return sheet, masses, mass_matrix(sheet.patch, masses)


def test_mass_is_the_integral_of_the_basis_products():
    """Against Gauss quadrature of the spline, which is exact for its degree."""
    rng = np.random.default_rng(3)
    patch = Patch(5, 3, 0.02, 0.03)
    masses = rng.uniform(1, 2, (3, 5))
    field = rng.standard_normal(patch.shape)
    nodes, weights = np.polynomial.legendre.leggauss(3)
    expected = 0.0
    for p, wp in zip(nodes, weights, strict=True):
        for q, wq in zip(nodes, weights, strict=True):
            value = derivative(field, patch, (0.5 + p / 2, 0.5 + q / 2), (0, 0))
            expected += 0.25 * wp * wq * (masses * (value**2).sum(axis=0)).sum()
    product = flat(field) @ mass_matrix(patch, masses) @ flat(field)
    assert product == pytest.approx(expected, rel=1e-13)


def test_mass_matrix_is_symmetric_and_positive_definite():
    patch = Patch(6, 4, 0.02, 0.03)
    matrix = mass_matrix(patch, np.random.default_rng(1).uniform(1, 2, (4, 6))).toarray()
    assert np.abs(matrix - matrix.T).max() < 1e-15 * np.abs(matrix).max()
    assert np.linalg.eigvalsh(matrix)[0] > 0


def test_total_mass():
    _, masses, matrix = cylinder_mass(10e-3)
    ones = np.ones(matrix.shape[0])
    assert ones @ matrix @ ones == pytest.approx(3 * masses.sum(), rel=1e-13)


def test_rigid_body_inertia_of_the_cylinder():
    """m about every direction, m R^2 about the axis, m (R^2/2 + h^2/12) across it."""
    height, errors = 0.17, []
    for size in SIZES:
        sheet, masses, matrix = cylinder_mass(size)
        arms = np.moveaxis(sheet.reference, 0, -1).reshape(-1, 3) - [0, 0, height / 2]
        rigid = rigid_motion(arms)
        inertia = rigid.T @ (matrix @ rigid)
        total = masses.sum()
        np.testing.assert_allclose(np.diag(inertia)[:3], total, rtol=1e-12)
        off = inertia - np.diag(np.diag(inertia))
        assert np.abs(off).max() < 1e-12 * total
        across = total * (RADIUS**2 / 2 + height**2 / 12)
        expected = [across, across, total * RADIUS**2]
        errors.append(np.diag(inertia)[3:] / expected - 1)
    assert (rates(np.abs(errors)) > 1.9).all()
    assert np.abs(errors[-1]).max() < 1e-4
