"""Held edges: what moves, what does not, and that halves behave as wholes."""

import numpy as np
import pytest
from conftest import FEP, rotation

from foilstudy.linalg import factorise
from foilstudy.model.patch import Patch, cylinder_control_points, fitted_control_points, knot_points
from foilstudy.model.shell.shell import Shell
from foilstudy.model.supports.edges import (
    RIGID_LINES,
    SIMPLY_SUPPORTED,
    EdgeCondition,
    PointHold,
    clamped,
    constraints,
    diaphragm,
    edge_lines,
    edge_normals,
    edge_offset,
    symmetric,
)
from foilstudy.model.supports.interpolation import (
    along_weights,
    around_weights,
    as_field,
    as_vector,
)
from foilstudy.model.supports.loads import area_load, point_load

THICKNESS = 2e-3


def plate(elements=6, size=1.0, corner=(0.0, 0.0)):
    patch = Patch(elements, elements, size / elements, size / elements, periodic=False)
    x0, y0 = corner
    return patch, fitted_control_points(
        patch, lambda x, y: np.stack([x0 + x, y0 + y, np.zeros_like(x)])
    )


def bowl(around=6, along=5):
    """A doubly curved, skewed patch."""
    patch = Patch(around, along, 1.0 / around, 0.8 / along, periodic=False)
    return patch, fitted_control_points(
        patch, lambda u, v: np.stack([u + 0.2 * v, v - 0.1 * u * v, 0.3 * u**2 - 0.2 * v**2])
    )


def any_displacement(held, seed=0):
    return held.displacement(np.random.default_rng(seed).standard_normal(held.free))


def on_edge(patch, field, edge, order=0):
    """Values, or derivatives across, of a field at the control parameters along an edge."""
    around, along = patch.parameters()
    orders = [0, 0]
    if edge in ("bottom", "top"):
        along = np.array([0.0 if edge == "bottom" else patch.elements_along * patch.size_along])
        orders[1] = order
    else:
        around = np.array([0.0 if edge == "left" else patch.elements_around * patch.size_around])
        orders[0] = order
    a, b = around_weights(patch, around, orders[0]), along_weights(patch, along, orders[1])
    return np.einsum("yj,xi,cji->yxc", b, a, field).reshape(-1, 3)


def bent_by(patch, points, held, load):
    sheet = Shell.elastic(patch, points, FEP, THICKNESS)
    stiffness = held.reduced_matrix(sheet.tangent())
    return held.displacement(factorise(stiffness).solve(held.reduced(load.force)))


def test_the_weights_at_the_knots_give_the_knot_points():
    for periodic in (True, False):
        patch = Patch(7, 5, 0.1, 0.2, periodic)
        field = np.random.default_rng(1).standard_normal(patch.shape)
        start = 0.5 * patch.size_around if periodic else 0.0
        around = start + patch.size_around * np.arange(7 if periodic else 8)
        weights = around_weights(patch, around), along_weights(patch, 0.2 * np.arange(6))
        surface = np.einsum("yj,xi,cji->cyx", weights[1], weights[0], field)
        np.testing.assert_allclose(surface, knot_points(field, periodic), atol=1e-14)


def test_the_weights_reproduce_a_parabola_and_its_derivatives():
    patch = Patch(5, 4, 0.3, 0.2, periodic=False)
    at = np.linspace(0, 1.5, 11)
    controls = patch.parameters()[0] ** 2 - patch.size_around**2 / 4
    for order, exact in enumerate((at**2, 2 * at, np.full(11, 2.0))):
        np.testing.assert_allclose(around_weights(patch, at, order) @ controls, exact, atol=1e-12)


def test_a_vector_and_its_field_are_each_others_inverse():
    patch = Patch(5, 4, 0.3, 0.2)
    vector = np.arange(3.0 * patch.rows * patch.columns)
    np.testing.assert_array_equal(as_vector(as_field(vector, patch)), vector)


@pytest.mark.parametrize("edge", ["bottom", "top", "left", "right"])
def test_a_simply_supported_edge_stays_where_it_is_and_turns(edge):
    patch, _ = bowl()
    moved = any_displacement(constraints(patch, {edge: SIMPLY_SUPPORTED}))
    assert np.abs(on_edge(patch, moved, edge)).max() < 1e-14
    assert np.abs(on_edge(patch, moved, edge, order=1)).min(axis=0).max() > 0


@pytest.mark.parametrize("edge", ["bottom", "top", "left", "right"])
def test_a_clamped_edge_keeps_its_normal_but_may_strain_across(edge):
    patch, points = bowl()
    moved = any_displacement(constraints(patch, {edge: clamped(patch, points, edge)}))
    normals = edge_normals(patch, points, edge)
    outer, inner = edge_lines(patch, edge)
    flat = as_vector(moved).reshape(-1, 3)
    slopes = flat[inner] - flat[outer]
    assert np.abs(on_edge(patch, moved, edge)).max() < 1e-14
    assert np.abs(np.sum(normals * slopes, axis=1)).max() < 1e-14
    assert np.linalg.norm(slopes, axis=1).min() > 0.01


def test_a_diaphragm_lets_an_edge_slide_along_the_other_axis():
    patch, _ = bowl()
    moved = on_edge(patch, any_displacement(constraints(patch, {"top": diaphragm(0, 2)})), "top")
    assert np.abs(moved[:, [0, 2]]).max() < 1e-14
    assert np.abs(moved[:, 1]).max() > 0.1


def test_the_unknowns_are_orthonormal_and_as_many_as_remain():
    patch, points = plate(6)
    held = constraints(
        patch,
        {
            "left": symmetric(0),
            "bottom": symmetric(1),
            "right": clamped(patch, points, "right"),
            "top": clamped(patch, points, "top"),
        },
    )
    product = (held.matrix.T @ held.matrix).toarray()
    np.testing.assert_allclose(product, np.eye(held.free), atol=1e-12)
    # 8 x 8 control points: u and v lose one line at every edge, w loses two at a clamped edge
    assert held.free == 2 * 6 * 6 + 5 * 5


def test_rigid_lines_hold_two_rows_of_control_points():
    patch = Patch(9, 5, 0.1, 0.1)
    held = constraints(patch, {"bottom": RIGID_LINES, "top": RIGID_LINES})
    assert held.free == 3 * 9 * (patch.rows - 4)
    assert np.abs(any_displacement(held)[:, [0, 1, -2, -1]]).max() == 0


def test_a_quarter_of_a_plate_bends_as_the_whole():
    whole, points = plate(8, 1.0, (-0.5, -0.5))
    held = constraints(
        whole, {e: clamped(whole, points, e) for e in ("left", "right", "bottom", "top")}
    )
    quarter, part = plate(4, 0.5)
    cut = constraints(
        quarter,
        {
            "left": symmetric(0),
            "bottom": symmetric(1),
            "right": clamped(quarter, part, "right"),
            "top": clamped(quarter, part, "top"),
        },
    )
    pressure = np.array([0.0, 0.0, 10.0])
    full = bent_by(whole, points, held, area_load(whole, points, pressure))
    small = bent_by(quarter, part, cut, area_load(quarter, part, pressure))
    np.testing.assert_allclose(full[2, 4:, 4:], small[2], rtol=1e-8)


def test_a_quarter_of_a_clamped_cylinder_deforms_as_the_whole():
    """Where a clamped and a symmetric edge meet, nothing may be held but what both hold."""
    radius, height, elements = 0.1, 0.15, 5

    def surface(s, z):
        angle = s / radius
        return np.stack([radius * np.sin(angle), z, radius * np.cos(angle)])

    size = np.pi * radius / 2 / elements
    quarter = Patch(elements, 6, size, height / 6, periodic=False)
    part = fitted_control_points(quarter, surface)
    cut = constraints(
        quarter,
        {
            "left": symmetric(0),
            "right": symmetric(2),
            "top": clamped(quarter, part, "top"),
        },
    )
    whole = Patch(4 * elements, 6, size, height / 6)
    points = fitted_control_points(whole, lambda s, z: surface(s - size / 2, z))
    held = constraints(whole, {"top": clamped(whole, points, "top")})
    pair = sum(
        point_load(whole, points, (at * size, 0.0), np.array([0, 0, sign])).force
        for at, sign in ((0.5, -2.0), (0.5 + 2 * elements, 2.0))
    )
    load = point_load(quarter, part, (0.0, 0.0), np.array([0, 0, -1.0]))
    full = bent_by(whole, points, held, type(load)(points, pair))
    small = bent_by(quarter, part, cut, load)
    np.testing.assert_allclose(full[:, :, : quarter.columns], small, atol=1e-8 * np.abs(full).max())


def test_three_held_points_stop_a_free_plate_without_reactions():
    patch, points = plate(6)
    holds = [
        PointHold(at, axis)
        for at, axes in (((0, 0), (0, 1, 2)), ((1, 0), (1, 2)), ((0, 1), (2,)))
        for axis in axes
    ]
    held = constraints(patch, {}, holds)
    assert held.free == points.size - 6
    pull = [
        point_load(patch, points, at, np.array([sign, 0, 0])).force
        for at, sign in (((0.0, 0.5), -1.0), ((1.0, 0.5), 1.0))
    ]
    load = point_load(patch, points, (0, 0), np.zeros(3))
    stretched = bent_by(patch, points, held, type(load)(points, pull[0] + pull[1]))
    sheet = Shell.elastic(patch, points, FEP, THICKNESS)
    force = as_field(sheet.tangent() @ as_vector(stretched), patch)
    np.testing.assert_allclose(force, pull[0] + pull[1], atol=1e-8)


def test_edges_moved_together_move_the_sheet_as_a_whole():
    patch, points = bowl()
    turn = rotation([1, 2, 3], 1.0)
    offset = sum(
        edge_offset(patch, points, edge, lambda x: x @ turn.T + 1.0) for edge in ("left", "right")
    )
    whole = np.einsum("ij,jrc->irc", turn, points) + 1.0 - points
    np.testing.assert_allclose(
        offset[:, :, [0, 1, -2, -1]], whole[:, :, [0, 1, -2, -1]], atol=1e-14
    )
    assert np.abs(offset[:, :, 2:-2]).max() == 0


def test_normals_of_a_cylinder_are_radial():
    patch = Patch(24, 4, 2 * np.pi * 0.1 / 24, 0.05)
    points = cylinder_control_points(patch, 0.2)
    angle = 2 * np.pi * np.arange(24) / 24
    radial = np.stack([np.cos(angle), np.sin(angle), np.zeros(24)], axis=1)
    np.testing.assert_allclose(edge_normals(patch, points, "top"), radial, atol=1e-12)


def test_conditions_that_make_no_sense_are_refused():
    closed, (patch, _) = Patch(9, 5, 0.1, 0.1), plate(4)
    with pytest.raises(ValueError, match="closed patch has no left edge"):
        constraints(closed, {"left": SIMPLY_SUPPORTED})
    with pytest.raises(ValueError, match="an edge is one of"):
        constraints(patch, {"north": SIMPLY_SUPPORTED})
    with pytest.raises(ValueError, match="coordinate axis"):
        constraints(patch, {"left": diaphragm(3)})
    with pytest.raises(ValueError, match=r"need \(6, 3\)"):
        constraints(patch, {"left": EdgeCondition(no_slope=(np.ones((5, 3)),))})
