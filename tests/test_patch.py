"""Uniform quadratic B-spline patch: knots, refinement, the cylinder."""

import numpy as np
import pytest
from conftest import DIAMETER
from scipy.interpolate import BSpline

from foilstudy.model.patch import Patch, cylinder_control_points, knot_points, refine


def spline(control_points, along, around):
    """Direct evaluation at element coordinates by SciPy's B-splines, (3, along, around)."""
    _, rows, columns = control_points.shape
    wrapped = np.concatenate([control_points, control_points[:, :, :2]], axis=2)
    knots = np.arange(rows + 3) - 2.0
    rows_at = BSpline(knots, np.moveaxis(wrapped, 1, 0), 2)(along)  # (along, 3, columns + 2)
    knots = np.arange(columns + 5) - 2.0
    values = BSpline(knots, np.moveaxis(rows_at, 2, 0), 2)(around)  # (around, along, 3)
    return values.transpose(2, 1, 0)


@pytest.fixture
def patch():
    return Patch(7, 5, 0.01, 0.02)


@pytest.fixture
def points(patch):
    return np.random.default_rng(1).standard_normal(patch.shape)


def test_knot_points_lie_on_the_spline(patch, points):
    direct = spline(points, np.arange(patch.elements_along + 1), np.arange(patch.columns))
    # the column of a surface point is the first control column of the element behind its knot
    np.testing.assert_allclose(knot_points(points), direct, rtol=0, atol=1e-14)


def test_refinement_leaves_the_surface_as_it_is(patch, points):
    along = np.linspace(0, patch.elements_along, 23)
    around = np.linspace(0, patch.columns, 31)
    fine = refine(points)
    assert fine.shape == patch.refined().shape
    np.testing.assert_allclose(
        spline(fine, 2 * along, 2 * around), spline(points, along, around), rtol=0, atol=1e-14
    )


def test_refined_patch_keeps_the_lengths(patch):
    fine = patch.refined()
    assert fine.elements_around * fine.size_around == patch.elements_around * patch.size_around
    assert fine.elements_along * fine.size_along == patch.elements_along * patch.size_along


def test_cylinder_patch_spans_circumference_and_height():
    patch = Patch.for_cylinder(DIAMETER, 0.17, 0.0049)
    assert patch.elements_around * patch.size_around == pytest.approx(np.pi * DIAMETER, rel=1e-15)
    assert patch.elements_along * patch.size_along == pytest.approx(0.17, rel=1e-15)


def test_cylinder_stands_between_its_heights():
    patch = Patch.for_cylinder(DIAMETER, 0.17, 0.01)
    z = knot_points(cylinder_control_points(patch, DIAMETER))[2]
    expected = patch.size_along * np.arange(patch.elements_along + 1)
    np.testing.assert_allclose(z, np.broadcast_to(expected[:, None], z.shape), atol=1e-16)


@pytest.mark.parametrize("columns", [24, 63, 126])
def test_arc_length_at_the_middles_is_exact_to_fourth_order(columns):
    """One point per element then finds the area, and with it the mass, to fourth order."""
    patch = Patch(columns, 8, np.pi * DIAMETER / columns, 0.02)
    points = cylinder_control_points(patch, DIAMETER)[:2, 4]
    tangent = (np.roll(points, -2, axis=1) - points) / (2 * patch.size_around)
    angle = 2 * np.pi / columns
    length = np.hypot(*tangent)
    # sin(x) / x = 1 - x^2/6 + x^4/120 against the (2 + cos x)/3 = 1 - x^2/6 + x^4/72 of the radius
    np.testing.assert_allclose(length - 1, -(angle**4) / 180, rtol=angle**2)


@pytest.mark.parametrize("columns", [24, 63, 126])
def test_mean_radius_exceeds_half_the_diameter_by_a_known_second_order(columns):
    """The other side of an exact arc length: angle^2/24, 1e-4 of the radius at 5 mm."""
    patch = Patch(columns, 8, np.pi * DIAMETER / columns, 0.02)
    nodes, weights = np.polynomial.legendre.leggauss(8)
    surface = spline(cylinder_control_points(patch, DIAMETER), [4.0], 0.5 * (nodes + 1))
    mean = 0.5 * weights @ np.hypot(surface[0, 0], surface[1, 0])
    angle = 2 * np.pi / columns
    assert mean / (0.5 * DIAMETER) - 1 == pytest.approx(angle**2 / 24, rel=angle**2)


def test_spline_cylinder_is_round_to_fourth_order():
    spread = []
    for columns in (40, 80, 160):
        patch = Patch(columns, 8, np.pi * DIAMETER / columns, 0.02)
        surface = spline(cylinder_control_points(patch, DIAMETER), [4.0], np.linspace(0, 1, 101))
        spread.append(np.ptp(np.hypot(surface[0], surface[1])))
    rates = np.log2(np.divide(spread[:-1], spread[1:]))
    np.testing.assert_allclose(rates, 4.0, atol=0.01)
