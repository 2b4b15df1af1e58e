"""Loads, loaded sheets, load paths and buckling against statics and beam and plate theory."""

import numpy as np
import pytest
from conftest import FEP, rotation

from foilstudy.linalg import factorise
from foilstudy.model.materials import Material
from foilstudy.model.patch import Patch, fitted_control_points
from foilstudy.model.shell.shell import Shell
from foilstudy.model.supports.edges import (
    PointHold,
    clamped,
    constraints,
    diaphragm,
    edge_offset,
    symmetric,
)
from foilstudy.model.supports.interpolation import as_vector
from foilstudy.model.supports.loads import DeadLoad, EdgeMoment, area_load, edge_load, point_load
from foilstudy.solve.equilibrium.newton import minimise
from foilstudy.solve.loading import buckling
from foilstudy.solve.loading.buckling import buckling_modes
from foilstudy.solve.loading.loaded_sheet import LoadedSheet
from foilstudy.solve.loading.path import follow_load

LENGTH, WIDTH, THICKNESS = 1.0, 0.2, 0.01
NO_POISSON = Material(youngs_modulus=1e9, poisson_ratio=0.0, density=1.0, yield_stress=1.0)
INERTIA = WIDTH * THICKNESS**3 / 12


def strip(along=12, across=2, material=NO_POISSON):
    """Flat strip from x = 0 to its end at the top edge."""
    patch = Patch(across, along, WIDTH / across, LENGTH / along, periodic=False)
    points = fitted_control_points(patch, lambda y, x: np.stack([x, y, np.zeros_like(x)]))
    return Shell.elastic(patch, points, material, THICKNESS)


def cantilever(load_at_end, along=12):
    sheet = strip(along)
    held = constraints(sheet.patch, {"bottom": clamped(sheet.patch, sheet.reference, "bottom")})
    load = edge_load(sheet.patch, sheet.reference, "top", np.asarray(load_at_end) / WIDTH)
    return LoadedSheet(sheet, held, load)


def dome(around=5, along=4):
    patch = Patch(around, along, 1.0 / around, 0.8 / along, periodic=False)
    return patch, fitted_control_points(
        patch, lambda u, v: np.stack([u + 0.2 * v, v - 0.1 * u * v, 0.3 * u**2 - 0.2 * v**2])
    )


def shaken(points, size=0.02, seed=3):
    return points + size * np.random.default_rng(seed).standard_normal(points.shape)


def resultants(points, force):
    """Total force and moment about the origin of forces on control points."""
    total = force.sum(axis=(1, 2))
    return total, np.cross(points, force, axis=0).sum(axis=(1, 2))


# --- loads ---------------------------------------------------------------------------------------


def test_a_point_load_has_its_force_and_its_moment():
    patch, points = dome()
    force = np.array([1.0, -2.0, 3.0])
    at = (0.37, 0.51)
    total, moment = resultants(points, point_load(patch, points, at, force).force)
    place = np.array([at[0] + 0.2 * at[1], at[1] - 0.1 * at[0] * at[1], 0.3 * at[0] ** 2])
    place[2] -= 0.2 * at[1] ** 2
    np.testing.assert_allclose(total, force, atol=1e-13)
    np.testing.assert_allclose(moment, np.cross(place, force), atol=1e-13)


def test_loads_on_a_cylinder_add_up_to_its_circumference_and_area():
    patch = Patch(60, 6, 2 * np.pi * 0.1 / 60, 0.05)
    points = fitted_control_points(
        patch, lambda s, z: np.stack([0.1 * np.cos(s / 0.1), 0.1 * np.sin(s / 0.1), z])
    )
    ring = edge_load(patch, points, "top", np.array([0, 0, -2.0]))
    weight = area_load(patch, points, np.array([0, 0, -3.0]))
    circumference = 2 * np.pi * 0.1
    total, moment = resultants(points, ring.force)
    np.testing.assert_allclose(total, [0, 0, -2 * circumference], rtol=1e-5, atol=1e-13)
    np.testing.assert_allclose(moment, 0, atol=1e-13)
    total, _ = resultants(points, weight.force)
    np.testing.assert_allclose(total, [0, 0, -3 * circumference * 0.3], rtol=1e-5, atol=1e-13)


@pytest.mark.parametrize("edge", ["bottom", "top", "left", "right"])
def test_an_edge_moment_is_a_couple_and_the_derivative_of_its_work(edge):
    patch, points = dome()
    moment = np.array([1.0, 2.0, -0.5])
    load = EdgeMoment(patch, points, edge, moment)
    bent = shaken(points)
    work, force = load.work_and_force(bent)
    total, couple = resultants(bent, force)
    np.testing.assert_allclose(total, 0, atol=1e-12)
    assert couple @ moment == pytest.approx(moment @ moment, rel=1e-12)
    motion = shaken(np.zeros_like(bent), 1.0, seed=5)
    step = 1e-6
    ahead, behind = (load.work_and_force(bent + s * step * motion) for s in (1, -1))
    slope = (ahead[0] - behind[0]) / (2 * step)
    assert slope == pytest.approx(np.sum(force * motion), rel=1e-6)
    rate = as_vector((ahead[1] - behind[1]) / (2 * step))
    tangent = load.stiffness(bent)
    np.testing.assert_allclose(tangent @ as_vector(motion), rate, atol=1e-6 * np.abs(rate).max())
    assert abs(tangent - tangent.T).max() < 1e-10 * abs(tangent).max()


def test_an_edge_moment_counts_whole_turns():
    sheet = strip(along=24)
    load = EdgeMoment(sheet.patch, sheet.reference, "top", np.array([0, -2.0, 0]))

    def rolled(angle):
        radius = LENGTH / angle
        return fitted_control_points(
            sheet.patch,
            lambda y, x: np.stack(
                [radius * np.sin(x / radius), y, radius * (1 - np.cos(x / radius))]
            ),
        )

    for angle in (0.5, 3.0, 3 * np.pi, 5 * np.pi):
        # the control points of the spline turn half an element less and more than the edges
        assert load.work_and_force(rolled(angle))[0] == pytest.approx(2.0 * angle, rel=1e-9)


def test_an_edge_moment_needs_an_axis_about_which_the_edge_can_turn():
    sheet = strip()
    with pytest.raises(ValueError, match="other than zero"):
        EdgeMoment(sheet.patch, sheet.reference, "top", np.zeros(3))
    with pytest.raises(ValueError, match="has no angle"):
        EdgeMoment(sheet.patch, sheet.reference, "top", np.array([1.0, 0, 0]))


# --- potential and equilibrium -------------------------------------------------------------------


def test_gradient_and_hessian_are_the_derivatives_of_the_potential():
    patch, points = dome()
    sheet = Shell.elastic(patch, points, FEP, 0.01)
    held = constraints(patch, {"bottom": clamped(patch, points, "bottom"), "left": symmetric(0)})
    loaded = LoadedSheet(sheet, held, EdgeMoment(patch, points, "top", np.array([3e3, 0, 0])), 0.7)
    rng = np.random.default_rng(2)
    q, motion = 0.01 * rng.standard_normal(held.free), rng.standard_normal(held.free)
    _, gradient = loaded.value_and_gradient(q)
    step = 1e-6
    ahead, behind = (loaded.value_and_gradient(q + s * step * motion) for s in (1, -1))
    assert (ahead[0] - behind[0]) / (2 * step) == pytest.approx(gradient @ motion, rel=1e-6)
    rate = (ahead[1] - behind[1]) / (2 * step)
    np.testing.assert_allclose(loaded.hessian(q) @ motion, rate, atol=1e-5 * np.abs(rate).max())


def test_unknowns_and_points_of_a_shape_are_each_others_inverse():
    loaded = cantilever([0, 0, 1.0])
    q = np.random.default_rng(4).standard_normal(loaded.constraints.free)
    np.testing.assert_allclose(loaded.unknowns(loaded.points(q)), q, atol=1e-13)


def test_a_small_end_load_bends_a_cantilever_as_beam_theory_says():
    loaded = cantilever([0, 0, 1e-3], along=24)
    path = follow_load(loaded, [1.0])
    tip = (path.equilibria[-1].points - loaded.sheet.reference)[2, -2:].mean()
    exact = 1e-3 * LENGTH**3 / (3 * NO_POISSON.youngs_modulus * INERTIA)
    assert path.status == "converged"
    assert tip == pytest.approx(exact, rel=2e-3)


def test_a_sheet_whose_clamped_ends_move_together_follows_without_strain():
    sheet = strip()
    patch, points = sheet.patch, sheet.reference
    turn = rotation([0, 1, 0.3], 0.4)
    moved = np.einsum("ij,jrc->irc", turn, points) + 0.1
    offset = sum(
        edge_offset(patch, points, edge, lambda x: x @ turn.T + 0.1) for edge in ("bottom", "top")
    )
    held = constraints(patch, {edge: clamped(patch, moved, edge) for edge in ("bottom", "top")})
    nothing = DeadLoad(points, np.zeros(patch.shape))
    loaded = LoadedSheet(sheet, held, nothing, base=points + offset)
    result = minimise(loaded, np.zeros(held.free))
    assert result.status == "converged"
    np.testing.assert_allclose(loaded.points(result.q), moved, atol=1e-6)


def test_a_load_that_nothing_holds_is_reported_and_not_followed():
    sheet = strip()
    loaded = LoadedSheet(
        sheet,
        constraints(sheet.patch, {}, [PointHold((0.0, 0.0), axis) for axis in range(3)]),
        edge_load(sheet.patch, sheet.reference, "top", np.array([0, 0, 1.0])),
    )
    path = follow_load(loaded, [1e3])
    assert path.status == "not_converged"
    assert path.message.endswith("load factor 0: the supports leave 3 rigid motions free")
    assert path.equilibria == ()


def test_the_rigid_motions_that_supports_leave_are_counted():
    sheet = strip()
    load = edge_load(sheet.patch, sheet.reference, "top", np.array([0, 0, 1.0]))

    def free(edges, holds):
        return LoadedSheet(sheet, constraints(sheet.patch, edges, holds), load).rigid_freedoms()

    corner = [PointHold((0.0, 0.0), axis) for axis in range(3)]
    assert free({}, []) == 6
    assert free({}, corner[:1]) == 5 and free({}, corner) == 3
    assert free({}, [*corner, *(PointHold((0.0, 1.0), axis) for axis in range(3))]) == 1
    assert free({"bottom": clamped(sheet.patch, sheet.reference, "bottom")}, []) == 0


# --- buckling ------------------------------------------------------------------------------------

EULER = np.pi**2 * NO_POISSON.youngs_modulus * INERTIA / (4 * LENGTH**2)


def test_a_column_buckles_at_the_loads_of_euler_with_second_order_in_the_mesh():
    errors = []
    for along in (8, 16):
        modes = buckling_modes(cantilever([-1.0, 0, 0], along), 2)
        errors.append(modes.factors / (EULER * np.array([1, 9])) - 1)
        assert modes.residuals.max() < 1e-6
    rates = np.log2(np.array(errors[0]) / errors[1])
    assert np.abs(errors[1]).max() < 0.02
    np.testing.assert_allclose(rates, 2, atol=0.15)


def test_the_shape_of_a_buckled_column_is_a_quarter_of_a_cosine():
    loaded = cantilever([-1.0, 0, 0], 16)
    shape = buckling_modes(loaded, 1).shapes[0]
    middle = 0.5 * (shape[2, 1:] + shape[2, :-1])[:, 0]
    exact = 1 - np.cos(np.pi / 2 * np.linspace(0, 1, 17))
    np.testing.assert_allclose(middle / middle[-1], exact, atol=2e-3)


def test_what_remains_to_buckling_is_less_by_the_load_that_acts():
    loaded = cantilever([-1.0, 0, 0])
    whole = buckling_modes(loaded, 1).factors[0]
    path = follow_load(loaded, [0.6 * whole])
    rest = buckling_modes(loaded.at(0.6 * whole), 1, path.equilibria[-1].points)
    assert rest.factors[0] == pytest.approx(0.4 * whole, rel=1e-3)


def test_the_rate_of_the_tangent_is_that_along_the_path_also_where_the_load_turns_with_the_edge():
    sheet = strip(6)
    held = constraints(sheet.patch, {"bottom": clamped(sheet.patch, sheet.reference, "bottom")})
    moment = EdgeMoment(sheet.patch, sheet.reference, "top", np.array([0, -1.0, 0]))
    factor, step = 5.0, 0.005  # turns the end by 0.3; a difference over the step is right to 0.2 %
    loaded = LoadedSheet(sheet, held, moment, factor)
    path = follow_load(loaded, [factor - step, factor, factor + step])
    tangents = [
        loaded.at(at.factor).hessian(loaded.unknowns(at.points)) for at in path.equilibria[-3:]
    ]
    along_path = (tangents[2] - tangents[0]) / (2 * step)
    q = loaded.unknowns(path.equilibria[-2].points)
    _, force = moment.work_and_force(loaded.points(q))
    velocity = factorise(tangents[1]).solve(held.reduced(force))
    rate = buckling._tangent_rate(loaded, q, velocity)
    of_load = held.reduced_matrix(moment.stiffness(loaded.points(q)))
    assert abs(rate - along_path).max() < 1e-2 * abs(of_load).max()


def test_a_plate_buckles_at_the_loads_of_kirchhoff():
    """k = (m + 1/m)^2 for a simply supported square (Timoshenko and Gere, article 9.2)."""
    elements = 24
    patch = Patch(elements, elements, 1 / elements, 1 / elements, periodic=False)
    points = fitted_control_points(patch, lambda x, y: np.stack([x, y, np.zeros_like(x)]))
    sheet = Shell.elastic(patch, points, FEP, 0.01)
    holds = [PointHold((0.5, 0.5), 0), PointHold((0.5, 0.5), 1), PointHold((0.5, 1.0), 0)]
    held = constraints(patch, {e: diaphragm(2) for e in ("left", "right", "bottom", "top")}, holds)
    press = [
        edge_load(patch, points, edge, np.array([sign, 0, 0])).force
        for edge, sign in (("left", 1.0), ("right", -1.0))
    ]
    modes = buckling_modes(LoadedSheet(sheet, held, DeadLoad(points, press[0] + press[1])), 3)
    rigidity = FEP.youngs_modulus * 0.01**3 / (12 * (1 - FEP.poisson_ratio**2))
    exact = np.pi**2 * rigidity * np.array([4.0, 6.25, 100 / 9])
    np.testing.assert_allclose(modes.factors, exact, rtol=0.025)
    assert modes.factors[0] == pytest.approx(exact[0], rel=0.006)


def test_buckling_is_not_counted_from_an_unstable_shape():
    loaded = cantilever([-1.0, 0, 0]).at(2 * EULER)
    straight = loaded.sheet.reference * np.array([0.999, 1, 1])[:, None, None]
    with pytest.raises(ValueError, match="negative eigenvalues"):
        buckling_modes(loaded, 1, straight)


def test_a_pulled_strip_does_not_buckle_at_any_load_that_linear_theory_can_mean():
    modes = buckling_modes(cantilever([1.0, 0, 0], along=6), 1)
    assert modes.factors[0] > 100 * EULER


def test_a_load_on_a_held_edge_brings_no_buckling():
    loaded = cantilever([1.0, 0, 0])
    sheet = loaded.sheet
    on_support = edge_load(sheet.patch, sheet.reference, "bottom", np.array([1.0, 0, 0]))
    with pytest.raises(ValueError, match="brings no stress"):
        buckling_modes(LoadedSheet(sheet, loaded.constraints, on_support), 1)
