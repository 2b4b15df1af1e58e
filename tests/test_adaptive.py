"""Where the error of a mesh is, and with how few elements of several sizes it could be had."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid
from scipy.spatial.transform import Rotation
from scipy.special import erf

from foilstudy.model.patch import Patch, fitted_control_points
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.pipeline.crumple import uncrumpled
from foilstudy.pipeline.method import Mesh
from foilstudy.pipeline.shape import Shape
from foilstudy.solve.relaxation.loop import Ramp, StoppingRule, relax
from foilstudy.study.published import CrumpleCase, foil
from foilstudy.study.tradeoff.adaptive import measure as measured
from foilstudy.study.tradeoff.adaptive import sensor, sizes

LENGTH, BREADTH, WIDTH, TURN = 0.8, 0.032, 0.02, 1.0
"""Of a sheet with one ridge across it, m: both edges, standard deviation of its curvature; rad."""


def ridge(size: float = 2e-3) -> Shape:
    """A strip bent about one line to a curvature that is a Gaussian of the arc length."""
    fine = np.linspace(-0.1, LENGTH + 0.1, 100_001)
    angle = 0.5 * TURN * erf((fine - LENGTH / 2) / (np.sqrt(2) * WIDTH))
    x, z = (cumulative_trapezoid(f(angle), fine, initial=0.0) for f in (np.cos, np.sin))

    def bent(around, along):
        return np.stack([np.interp(around, fine, x), along, np.interp(around, fine, z)])

    def flat(around, along):
        return np.stack([around, along, 0 * along])

    patch = Patch(round(LENGTH / size), round(BREADTH / size), size, size, periodic=False)
    points, reference = (fitted_control_points(patch, surface) for surface in (bent, flat))
    return Shape(foil(500), patch, points, reference, Corner())


def turned(shape: Shape) -> Shape:
    """The same with first and second parameter exchanged."""
    patch = Patch(
        shape.patch.elements_along, shape.patch.elements_around,
        shape.patch.size_along, shape.patch.size_around, periodic=False,
    )  # fmt: skip
    points, reference = (each.swapaxes(1, 2).copy() for each in (shape.points, shape.reference))
    return replace(shape, patch=patch, points=points, reference=reference)


def wavy(amplitude: float = 1e-3) -> Shape:
    """A cylinder with waves all over but for its edges."""
    start = uncrumpled(foil(500), Mesh(5e-3))
    around, along = start.patch.parameters()
    waves = np.cos(np.outer(along, [80.0, 120.0])) @ np.cos(np.outer([70.0, 110.0], around))
    bumps = waves * np.sin(np.pi * along / start.foil.reference_height)[:, None] ** 2
    return replace(start, points=start.points * (1 + amplitude / 0.1 * bumps))


# --- the sensor ----------------------------------------------------------------------------------


@pytest.mark.parametrize("cells", [1, 2, 4])
def test_the_error_at_a_ridge_is_that_of_theory(cells):
    """Of a constant in place of a line, h^2 / 12 of the squared slope of the curvature."""
    shape = ridge()
    material, thickness = shape.foil.material, shape.foil.thickness
    stiffness = material.youngs_modulus * thickness**3 / 12 / (1 - material.poisson_ratio**2)
    largest = TURN / (np.sqrt(2 * np.pi) * WIDTH)
    slopes = largest**2 * np.sqrt(np.pi) / (2 * WIDTH)
    theory = 0.5 * stiffness * BREADTH * (cells * shape.patch.size_along) ** 2 / 12 * slopes
    found = sensor.cell_errors(sensor.strain_fields(shape), cells).sum()
    assert found == pytest.approx(theory, rel=0.03)


def test_the_squares_of_the_fields_add_up_to_the_strain_energy():
    shape = wavy(1e-4)
    fields, energies = sensor.strain_fields(shape), shape.energies()
    assert (fields[:3] ** 2).sum() == pytest.approx(energies.bending, rel=0.05)
    assert (fields[3:] ** 2).sum() == pytest.approx(energies.membrane, rel=0.05)


def test_a_turn_in_space_changes_nothing():
    shape = wavy()
    turn = Rotation.from_euler("xyz", [0.4, 1.1, -2.0]).as_matrix()
    away = replace(
        shape,
        points=np.einsum("ij,jkl", turn, shape.points) + 0.3,
        reference=np.einsum("ij,jkl", turn.T, shape.reference),
    )
    errors = sensor.element_errors(sensor.strain_fields(shape))
    other = sensor.element_errors(sensor.strain_fields(away))
    assert other == pytest.approx(errors, rel=1e-6, abs=1e-9 * errors.max())


def test_a_turn_of_the_mesh_turns_the_errors():
    shape = ridge()
    errors = sensor.cell_errors(sensor.strain_fields(shape), 4)
    other = sensor.cell_errors(sensor.strain_fields(turned(shape)), 4)
    assert other.T == pytest.approx(errors, rel=1e-6, abs=1e-9 * errors.max())


def test_a_cell_at_the_edge_may_be_cut_off():
    fields = np.ones((1, 5, 7))
    fields[0, 4, 6] = 3.0
    assert sensor.cell_sums(fields[0], 4, 4).tolist() == [[16, 12], [4, 5]]
    assert sensor.spread(fields, 4, 4) == pytest.approx(np.array([[0, 0], [0, 8 / 3]]))


# --- how few elements ----------------------------------------------------------------------------


def test_the_ideal_mesh_of_a_ridge_has_as_few_elements_as_theory_says():
    """L int g^2 / (int g)^2 for the slope g of the curvature, a Gaussian."""
    errors = sensor.spread(sensor.strain_fields(ridge()), 2, 2)
    theory = LENGTH * np.sqrt(np.pi) / (8 * WIDTH)
    assert sizes.ideal_gain(errors) == pytest.approx(theory, rel=0.05)


def band(rows: int = 16, columns: int = 128, first: int = 48, last: int = 80) -> np.ndarray:
    """A field that grows within some columns and is constant elsewhere."""
    line = np.clip(np.arange(columns) - first + 0.5, 0.0, last - first)
    return np.broadcast_to(line, (1, rows, columns))


def test_a_band_alone_has_fine_squares():
    tree = sizes.best_tree(band(), periodic=False, balanced=False)
    assert (tree.levels[:, 48:80] == 0).all()
    assert (tree.levels[:, :48] == 3).all() and (tree.levels[:, 80:] == 3).all()
    assert tree.elements == 32 * 16 + 96 * 16 // 64
    assert tree.share(0) == 0.25 and tree.share(3) == 0.75


@pytest.mark.parametrize("periodic", [True, False])
def test_a_balanced_tree_has_whole_squares_beside_others_of_one_level_more_or_less(periodic):
    rng = np.random.default_rng(1)
    fields = rng.normal(size=(2, 43, 70)) * np.exp(2 * rng.normal(size=(43, 70)))
    fields = np.cumsum(fields, axis=2)
    loose = sizes.best_tree(fields, periodic, balanced=False)
    tree = sizes.best_tree(fields, periodic)
    levels = tree.levels
    steps = [np.diff(levels, axis=0), np.diff(levels, axis=1)]
    steps += [levels[:, 0] - levels[:, -1]] if periodic else []
    assert max(np.abs(step).max() for step in steps) == 1
    assert max(np.abs(np.diff(loose.levels, axis=1)).ravel()) > 1
    for level in (1, 2, 3):
        here = (levels == level).astype(int)
        full = sensor.cell_sums(np.ones_like(here), 2**level, 2**level)
        assert np.isin(sensor.cell_sums(here, 2**level, 2**level) / full, (0, 1)).all()
    assert tree.error <= sensor.element_errors(fields).sum() * (1 + 1e-6)
    assert loose.elements <= tree.elements


def test_nothing_is_gained_where_the_error_is_the_same_everywhere():
    rows, columns = np.mgrid[:32, :64].astype(float)
    fields = np.stack([rows, columns])
    assert sizes.best_tree(fields, periodic=False).elements == rows.size
    assert sizes.ideal_gain(sensor.spread(fields, 2, 2)) == pytest.approx(1.0)
    assert sizes.graded_gain(*sensor.directional_errors(fields)) == pytest.approx(1.0)


def test_graded_rows_have_as_few_elements_as_theory_says():
    """Half of the rows with an eighth of the error: (1 + 1/8)^(1/2) / (1 + 1/2)^(3/2) times 2."""
    around, along = np.ones((16, 8)), np.ones((8, 16))
    along[:4] = 0.125
    around *= along.sum() / around.sum()
    gain = 2 * (1 + 1 / 8) ** 0.5 / (1 + 1 / 2) ** 1.5
    assert sizes.graded_gain(around, along) == pytest.approx(gain)
    assert sizes.graded_gain(4 * around, along) == pytest.approx(gain * 5 / 4)


# --- the ramp ------------------------------------------------------------------------------------


def test_the_ramp_is_looked_at_without_being_changed():
    start = uncrumpled(foil(500), Mesh(15e-3))
    ramp = Ramp(0.01, 60)
    early, late = measured.ramp_shapes(start, ramp, (20, 60))
    problem = start.problem()
    motion = start.method.path.scheme.start(problem)
    alone = relax(problem, motion, ramp, StoppingRule(np.inf, 0))
    assert np.array_equal(late.points, alone.points)
    lowered = start.points[2, -1] - early.points[2, -1]
    assert lowered == pytest.approx(ramp.shortening_at(20))


@pytest.mark.parametrize(
    ("allowed", "size"), [(0.0025, 0.5), (0.01, 1.0), (0.08, 2 * 2**0.5), (1.0, 8.0)]
)
def test_the_size_of_a_stage_is_that_of_the_allowed_error(allowed, size):
    assert measured.allowed_size(np.array([0.01, 0.04, 0.16, 0.64]), allowed) == pytest.approx(size)


def test_a_crumple_is_measured():
    found = measured.measure(CrumpleCase("corner", 500, 170, 10.0, 0))
    gain = found["gain"]
    assert sum(found["shares"]) == pytest.approx(1.0)
    assert 1 < gain["tree"] <= gain["unbalanced"] < gain["ideal"] and 1 < gain["graded"]
    assert (np.diff(found["errors"]) > 0).all()
    assert found["kernel"] > 1
    ramp = found["ramp"]
    assert 0 <= ramp["by_stage"] < ramp["share"] < 1
    assert len(ramp["size"]) == len(ramp["shortening"]) == len(measured.STAGES)
    assert ramp["shortening"][-1] == pytest.approx(1.0)
