"""Models that are too little: what they get right, and by how much they miss the rest."""

import numpy as np
import pytest
from conftest import DIAMETER, FEP, FOIL, REFERENCE_HEIGHT, THICKNESS, rotation
from wild_sheets import extrapolated, flat, force_of

from foilstudy.model.foil import Imperfection
from foilstudy.model.materials import Material
from foilstudy.model.patch import Patch, fitted_control_points
from foilstudy.model.shell.elements import LESSER_MODELS, mass_spring
from foilstudy.model.shell.elements.full import Full
from foilstudy.model.shell.elements.mass_spring import MassSpring, lattice_cylinder, lattice_patch
from foilstudy.model.shell.elements.tension_field import TensionField
from foilstudy.model.shell.shell import Shell
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.lesser import crumple_lesser, lesser_cylinder
from foilstudy.pipeline.measures.displacement_probe import DisplacementProbe
from foilstudy.pipeline.measures.tangent import Tangent
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.paths.relaxation import RelaxationPath

THIRD = Material(FEP.youngs_modulus, 1 / 3, FEP.density, FEP.yield_stress)
MODULUS = THIRD.youngs_modulus * THICKNESS / (1 - 1 / 9)
every_model = pytest.mark.parametrize("model", LESSER_MODELS)


def rough(model, amplitude=2e-3):
    """A sheet of a model, and a shape with folds and strains in all directions."""
    start = lesser_cylinder(model, FOIL, Mesh(30e-3))
    rng = np.random.default_rng(0)
    return start.stressed, start.points + amplitude * rng.standard_normal(start.points.shape)


@pytest.fixture(scope="module")
def crumples():
    method = Method(RelaxationPath(ramp_steps=200))
    return {
        model: crumple_lesser(model, FOIL, Mesh(22e-3), Imperfection(), method)
        for model in LESSER_MODELS
    }


# --- derivatives and invariance -----------------------------------------------------------------


def check_derivatives(sheet, points, step):
    rng = np.random.default_rng(1)
    way = rng.standard_normal(points.shape)
    force, matrix = force_of(sheet, points), sheet.tangent(points)

    def slope(step):
        ahead, behind = (sheet.energies(points + s * step * way).total for s in (1, -1))
        return (ahead - behind) / (2 * step)

    def bend(step):
        ahead, behind = (force_of(sheet, points + s * step * way) for s in (1, -1))
        return flat(ahead - behind) / (2 * step)

    size = np.linalg.norm(force) * np.linalg.norm(way)
    assert abs(extrapolated(slope, step) - np.sum(force * way)) < 1e-8 * size
    product = matrix @ flat(way)
    assert np.linalg.norm(extrapolated(bend, step) - product) < 1e-7 * np.linalg.norm(product)
    assert abs(matrix - matrix.T).max() < 1e-12 * abs(matrix).max()


@every_model
def test_force_and_tangent_are_derivatives(model):
    check_derivatives(*rough(model), step=1e-7)


def test_force_and_tangent_are_derivatives_on_a_crumple(crumples):
    crumpled = crumples["mass_spring"]
    check_derivatives(crumpled.stressed, crumpled.points, step=1e-5)


@every_model
def test_rigid_motion_costs_nothing_and_changes_nothing(model):
    sheet, points = rough(model)
    turn = rotation([1, 2, 3], 2.0)

    def moved(shape):
        return np.einsum("ij,jrc->irc", turn, shape) + np.array([0.3, -0.2, 0.5])[:, None, None]

    energy = sheet.energies(points).total
    assert sheet.energies(moved(sheet.reference)).total < 1e-20 * energy
    assert sheet.energies(moved(points)).total == pytest.approx(energy, rel=1e-9)
    turned = np.einsum("ij,jrc->irc", turn, force_of(sheet, points))
    scale = np.abs(turned).max()
    np.testing.assert_allclose(force_of(sheet, moved(points)), turned, rtol=0, atol=1e-9 * scale)


# --- springs and hinges against theory ----------------------------------------------------------


def lattice(edge=5e-3, diameter=DIAMETER):
    patch = lattice_patch(diameter, REFERENCE_HEIGHT, edge)
    points = lattice_cylinder(patch, diameter)
    return Shell.elastic(patch, points, FEP, THICKNESS, MassSpring())


def test_the_lattice_fits_the_cylinder():
    sheet = lattice()
    heights = sheet.reference[2].mean(axis=1)
    np.testing.assert_allclose(heights[[1, -2]], [0, REFERENCE_HEIGHT], atol=1e-12)
    np.testing.assert_allclose(np.hypot(*sheet.reference[:2]), DIAMETER / 2, rtol=1e-12)
    assert sheet.patch.size_along / sheet.patch.size_around == pytest.approx(np.sqrt(0.75), 0.01)


@pytest.mark.parametrize(
    ("around", "along", "twist"), [(1e-4, 0, 0), (0, 1e-4, 0), (1e-4, 1e-4, 0), (0, 0, 1e-4)]
)
def test_springs_are_a_sheet_of_a_third(around, along, twist):
    """Energy of uniform strains, as of a plate with E t and Poisson's ratio 1/3."""
    sheet = lattice()
    points = sheet.reference * np.array([1 + around, 1 + around, 1 + along])[:, None, None]
    angle = twist * sheet.reference[2] / (DIAMETER / 2)
    x, y = points[0].copy(), points[1].copy()
    points[0], points[1] = (
        x * np.cos(angle) - y * np.sin(angle),
        x * np.sin(angle) + y * np.cos(angle),
    )
    area = np.pi * DIAMETER * sheet.patch.size_along * (sheet.patch.rows - 1)
    density = 0.5 * MODULUS * (around**2 + along**2 + 2 / 3 * around * along + twist**2 / 3)
    # springs around on both rims stand for half a row beyond them
    spring = np.sqrt(0.75) * FEP.youngs_modulus * THICKNESS
    rims = 0.5 * spring * sheet.patch.columns * (around * sheet.patch.size_around) ** 2
    expected = density * area + rims
    assert sheet.energies(points).membrane == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize(
    ("curvature", "ratio"),
    [
        (np.diag([1.0, 0.0]), 1.0),
        (np.diag([0.0, 1.0]), 1.0),
        (np.array([[0.5, 0.5], [0.5, 0.5]]), 1.0),
        (np.array([[0.0, 1.0], [1.0, 0.0]]), 2.0),
        (np.diag([1.0, 1.0]), 0.5),
    ],
    ids=["around", "along", "oblique", "twist", "dome"],
)
def test_hinges_twist_at_twice_the_cost_and_dome_at_half(curvature, ratio):
    """Three hinges of a node of a flat lattice of edge 1; a plate of nu = 1/3 costs the ratio."""
    height = np.sqrt(0.75)
    node, right, above = np.zeros(2), np.array([1.0, 0]), np.array([0.5, height])
    left = above - right
    corners = np.array(
        [
            [node, right, above, right - above],
            [node, above, left, right],
            [node, left, -right, above],
        ]
    )
    tiny = 1e-6
    deflection = 0.5 * tiny * np.einsum("hca,ab,hcb->hc", corners, curvature, corners)
    angles = mass_spring._angles(np.concatenate([corners, deflection[..., None]], axis=2))
    hinges = 0.5 * 2 / np.sqrt(3) * np.sum(angles**2) / height / tiny**2
    plate = 0.5 * (np.trace(curvature) ** 2 - 4 / 3 * np.linalg.det(curvature))
    assert hinges / plate == pytest.approx(ratio, rel=1e-6)


def test_springs_need_a_closed_patch():
    patch = Patch(6, 6, 1e-2, 1e-2, periodic=False)
    points = fitted_control_points(patch, lambda s, z: np.stack([s, z, 0 * s]))
    sheet = Shell.elastic(patch, points, FEP, THICKNESS, MassSpring())
    with pytest.raises(ValueError, match="closed around"):
        sheet.energies(points)


# --- tension field ------------------------------------------------------------------------------


def stretched_plate(gradient):
    """Membrane energy per area, over E t, of a plate under a uniform deformation."""
    patch = Patch(5, 4, 0.011, 0.009, periodic=False)
    points = fitted_control_points(patch, lambda s, z: np.stack([s + 0.4 * z, z, 0 * s]))
    sheet = Shell.elastic(patch, points, FEP, THICKNESS, TensionField())
    whole = np.eye(3)
    whole[:2, :2] = gradient
    energies = sheet.energies(np.einsum("ij,jrc->irc", whole, points))
    return energies.total / sheet.section.areas.sum() / (FEP.youngs_modulus * THICKNESS)


def test_a_tension_field_bears_tension_alone():
    turn = rotation([0, 0, 1], 0.4)[:2, :2]

    def of(high, low):
        stretch = np.sqrt(1 + 2 * np.array([high, low]))
        return stretched_plate(turn.T @ np.diag(stretch) @ turn)

    nu = FEP.poisson_ratio
    taut = 0.5 * (0.02**2 + 0.01**2 + 2 * nu * 0.02 * 0.01) / (1 - nu**2)
    assert of(0.02, 0.01) == pytest.approx(taut, rel=1e-9)
    assert of(0.02, -0.02) == pytest.approx(0.5 * 0.02**2, rel=1e-9)  # wrinkled: uniaxial
    assert of(0.02, -nu * 0.02) == pytest.approx(0.5 * 0.02**2, rel=1e-9)  # where both meet
    assert of(-0.01, -0.02) == 0.0


def test_a_tension_field_costs_less_than_the_membrane():
    sheet, points = rough("tension_field")
    whole = Shell.elastic(sheet.patch, sheet.reference, FEP, THICKNESS, Full())
    assert 0 < sheet.energies(points).total < 0.9 * whole.energies(points).membrane


# --- what becomes of a crumple ------------------------------------------------------------------


def test_a_crumpled_tension_field_is_nothing(crumples):
    """No energy, and a shape that nothing holds."""
    crumpled = crumples["tension_field"]
    assert crumpled.energies().total == 0.0
    assert crumpled.status == "not_converged" and "singular" in crumpled.message
    stressed = Tangent(stressed=True).of(crumpled)
    assert np.isnan(stressed.stiffness).all() and "singular" in stressed.message


def test_springs_and_hinges_crumple(crumples):
    crumpled = crumples["mass_spring"]
    assert crumpled.status == "converged", crumpled.message
    tangent = Tangent().of(crumpled).stiffness
    probe = DisplacementProbe((1e-4,)).of(crumpled).stiffness
    np.testing.assert_allclose(probe, tangent, rtol=0.01)


def test_hourglasses_show_in_the_energy_of_another_element():
    """The crumple itself converges like any other; full integration sees the checkerboard."""

    def seen_by_full(element):
        method = Method(RelaxationPath(ramp_steps=300))
        crumpled = crumple(FOIL, Mesh(15e-3, element), Imperfection(), method)
        assert crumpled.status == "converged", crumpled.message
        other = Shell(crumpled.stressed.section, Full()).energies(crumpled.points)
        return other.total / crumpled.energies().total

    assert seen_by_full("uncontrolled") > 3 * seen_by_full("corner")
