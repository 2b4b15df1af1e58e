"""Imperfections: where they are, how large, how correlated, and which streams they come from."""

import numpy as np
import pytest
from conftest import DIAMETER, FOIL

from foilstudy.config import load_config
from foilstudy.config.foils import foil_of
from foilstudy.config.scene import recipe_of
from foilstudy.model.foil import Imperfection
from foilstudy.model.imperfections.cylinder import imperfect_cylinder
from foilstudy.model.patch import RING_ROWS, Patch, cylinder_control_points

AMPLITUDE, LENGTH = 1e-5, 0.015
KINDS = ("gaussian", "smoothed", "buckling_modes")
PATCH = Patch.for_cylinder(DIAMETER, FOIL.reference_height, 0.01)
PERFECT = cylinder_control_points(PATCH, DIAMETER)
FREE = slice(RING_ROWS, -RING_ROWS)


def deviation(kind, seed, patch=PATCH, foil=FOIL):
    imperfection = Imperfection(kind, AMPLITUDE, LENGTH, seed)
    perfect = cylinder_control_points(patch, foil.diameter)
    return imperfect_cylinder(patch, foil, imperfection) - perfect


def independent_smoothed(fields):
    """Independent values in smooth surfaces: one per integral of the squared correlation."""
    area = fields.shape[2] * PATCH.size_along * np.pi * DIAMETER
    return fields.shape[0] * fields.shape[1] * area / (2 * np.pi * LENGTH**2)


def task(seed=0, thickness=500.0, height=170.0):
    study = load_config(
        {
            "sweep": {
                "thickness_um": [thickness],
                "reference_height_mm": [height],
                "realisations": seed + 1,
            }
        }
    )
    return study.crumple_task(study.cells()[seed])


@pytest.mark.parametrize("kind", KINDS)
def test_ring_rows_stay_perfect(kind):
    moved = deviation(kind, 1)
    assert not moved[:, :RING_ROWS].any() and not moved[:, -RING_ROWS:].any()
    assert (np.abs(moved[:, FREE]).max(axis=(0, 2)) > 0).all()


@pytest.mark.parametrize("kind", KINDS)
def test_a_stream_is_reproducible(kind):
    assert np.array_equal(deviation(kind, 1), deviation(kind, 1))


@pytest.mark.parametrize("kind", KINDS)
def test_streams_differ_in_seed_thickness_and_height(kind):
    tasks = [task(), task(seed=1), task(thickness=250.0), task(height=150.0), task(thickness=500.5)]
    fields = np.array(
        [
            deviation(kind, recipe_of(t).imperfection.seed, foil=foil_of(t))[0, FREE].ravel()
            for t in tasks
        ]
    )
    # Buckling modes have 40 random amplitudes and as many phases, white noise one per point.
    independent = {"gaussian": fields.shape[1], "smoothed": 100, "buckling_modes": 40}[kind]
    correlation = np.corrcoef(fields) - np.eye(len(fields))
    assert np.abs(correlation).max() < 5 / np.sqrt(independent)


def test_the_stream_does_not_depend_on_the_sweep():
    study = load_config(
        {
            "sweep": {
                "thickness_um": [50, 500],
                "reference_height_mm": [135, 170],
                "realisations": 3,
            }
        }
    )
    (cell,) = (c for c in study.cells() if (c.thickness_um, c.seed) == (500, 1)
               and c.reference_height_mm == 170)  # fmt: skip
    alone, swept = task(seed=1), study.crumple_task(cell)
    streams = [recipe_of(t).imperfection.stream(foil_of(t)) for t in (alone, swept)]
    assert streams[0] == streams[1] == (1, 500_000, 170_000)


def test_variance_of_every_coordinate_is_the_amplitude_squared():
    fields = np.array([deviation("gaussian", seed)[:, FREE] for seed in range(300)])
    # one point per component is independent of the other realisations, whatever the correlation
    variance = (fields**2).mean(axis=0) / AMPLITUDE**2
    standard_error = np.sqrt(2 / len(fields))
    assert np.abs(variance - 1).max() < 5 * standard_error
    assert abs(variance.mean() - 1) < 5 * np.sqrt(2 / fields.size)


def surface(control_points):
    """Points of the surface at the control columns and between the control rows."""
    around = (np.roll(control_points, 1, axis=2) + np.roll(control_points, -1, axis=2)) / 8
    around += 0.75 * control_points
    return 0.5 * (around[:, :-1] + around[:, 1:])


def window(patch=PATCH):
    """How a smooth field falls to zero at the rings."""
    z = patch.size_along * np.arange(patch.rows - 1)
    height = FOIL.reference_height
    return (1 - np.exp(-((z / LENGTH) ** 2))) * (1 - np.exp(-(((height - z) / LENGTH) ** 2)))


def test_variance_of_the_smooth_surface_is_the_amplitude_squared_within_its_window():
    fields = np.array([surface(deviation("smoothed", seed)) for seed in range(300)])
    inner = slice(2, -2)
    variance = (fields**2).mean(axis=0)[:, inner] / (AMPLITUDE * window()[inner, None]) ** 2
    assert np.abs(variance - 1).max() < 5 * np.sqrt(2 / len(fields)) + 0.05
    assert abs(variance.mean() - 1) < 5 * np.sqrt(2 / independent_smoothed(fields[:, :, inner]))


def test_smoothed_imperfection_is_the_same_surface_on_every_mesh():
    """To fourth order in the element size, which is that of the spline's fit."""
    shapes = []
    for n in (4, 2, 1):
        sizes = np.pi * DIAMETER * n / 280, FOIL.reference_height * n / 80
        patch = Patch(280 // n, 80 // n, *sizes)
        moved = surface(deviation("smoothed", 7, patch))
        shapes.append(moved[:, :: 4 // n, :: 4 // n])
    coarse, middle = (np.abs(shape - shapes[2])[:, 2:-2].max() for shape in shapes[:2])
    assert coarse < 0.15 * AMPLITUDE
    assert middle < coarse / 8


def test_a_mesh_too_coarse_for_the_correlation_length_is_refused():
    patch = Patch.for_cylinder(DIAMETER, FOIL.reference_height, 2 * LENGTH)
    with pytest.raises(ValueError, match="needs elements of at most"):
        deviation("smoothed", 0, patch)


def test_variance_of_the_buckling_modes_is_the_amplitude_squared():
    fields = np.array([deviation("buckling_modes", seed)[:2] for seed in range(400)])
    radial2 = (fields**2).sum(axis=1)[:, FREE].mean(axis=2) / AMPLITUDE**2
    height = PATCH.size_along * (np.arange(PATCH.rows) - 0.5)[FREE]
    # sin^2 has the mean 1/2 over the height between the rings, which the free rows cover but for
    # one element and a half at each end
    missing = 3 * PATCH.size_along / FOIL.reference_height
    assert height.size == PATCH.rows - 2 * RING_ROWS
    assert abs(radial2.mean() - 1) < missing + 5 / np.sqrt(40 * len(fields))


def test_gaussian_points_are_uncorrelated():
    fields = np.array([deviation("gaussian", seed)[:, FREE] for seed in range(100)])
    for shift in ((0, 0, 1), (0, 1, 0)):
        neighbour = np.roll(fields, shift, axis=1)
        assert abs((fields * neighbour).mean()) / AMPLITUDE**2 < 5 / np.sqrt(fields.size)


def test_smoothed_correlation_is_gaussian_in_distance():
    shapes = np.array([surface(deviation("smoothed", seed)) for seed in range(400)])
    fields = (shapes / (AMPLITUDE * np.maximum(window(), 1e-9)[:, None]))[:, :, 2:-2]
    independent = independent_smoothed(fields)
    for rows, columns in ((0, 1), (0, 2), (0, 4), (1, 0), (3, 0), (2, 2), (0, 20), (10, 0)):
        here = fields[:, :, : fields.shape[2] - rows]
        there = np.roll(fields[:, :, rows:], -columns, axis=3)
        squared = (rows * PATCH.size_along) ** 2 + (columns * PATCH.size_around) ** 2
        measured, theory = (here * there).mean(), np.exp(-squared / (4 * LENGTH**2))
        share = here.shape[2] / fields.shape[2]
        assert abs(measured - theory) < 5 * np.sqrt(2 / (independent * share))


def test_buckling_modes_are_those_of_lowest_classical_stress():
    moved = deviation("buckling_modes", 3)
    angle = np.arctan2(PERFECT[1], PERFECT[0])
    radial = (moved[0] * np.cos(angle) + moved[1] * np.sin(angle)) / AMPLITUDE
    tangential = (moved[1] * np.cos(angle) - moved[0] * np.sin(angle)) / AMPLITUDE
    assert np.abs(tangential).max() < 1e-10 and not moved[2].any()
    # exact spectrum: Fourier around, then sines along through the free rows
    spectrum = np.fft.rfft(radial[FREE], axis=1)
    z = PATCH.size_along * (np.arange(PATCH.rows) - 0.5)[FREE]
    along = np.arange(1, z.size // 2 + 1)
    sines = np.sin(np.outer(z, along) * np.pi / FOIL.reference_height)
    coefficients = np.linalg.lstsq(sines, spectrum, rcond=None)[0]
    assert np.abs(sines @ coefficients - spectrum).max() < 1e-9 * np.abs(spectrum).max()
    power = np.abs(coefficients) ** 2 / (np.abs(coefficients) ** 2).sum()
    # critical stress over E of a mode: bending of the wall plus stretching of its curvature
    radius, thickness, nu = DIAMETER / 2, FOIL.thickness, FOIL.material.poisson_ratio
    p = along[:, None] * np.pi / FOIL.reference_height
    q = np.arange(spectrum.shape[1]) / radius
    curvature = p**2 / (p**2 + q**2) ** 2
    bending = thickness**2 / (12 * (1 - nu**2))
    stress = bending / curvature + curvature / radius**2
    classical = 2 * np.sqrt(bending) / radius
    used = power > 1e-12
    assert 0 < used.sum() <= 40
    within = q[None] * radius < PATCH.elements_around // 2
    within = within & (q[None] * radius >= 2) & (along[:, None] < PATCH.elements_along // 2)
    others = within & ~used
    assert stress[used].max() <= stress[others].min()
    assert (stress[used] >= classical * (1 - 1e-12)).all()


def test_an_unknown_kind_is_refused():
    with pytest.raises(ValueError, match="'dent' is not a known imperfection"):
        deviation("dent", 0)
