"""Modes: MAC, modal density beside theory, and whether overlengths become one curve."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure
from synthetic import COARSE, FAILED, MODES_PER_HZ, make_cube

from foilstudy.measure.dynamics.mac import mac
from foilstudy.model.materials import Material
from foilstudy.plot.mac import ModeLabels, draw_mac
from foilstudy.present.report.modes import modal_density_findings, overlength_findings
from foilstudy.present.statistics.modal_density import (
    Plate,
    counted_modal_density,
    modal_density,
    plate_modal_density,
    resolved_up_to,
)
from foilstudy.present.statistics.overlength_spread import (
    leave_one_out,
    overlength_spread,
    relative_magnitude,
)

FEP = Material(youngs_modulus=650e6, poisson_ratio=0.4, density=2150.0, yield_stress=12e6)
GRID = np.geomspace(1, 800, 200)


@pytest.fixture
def shapes():
    return np.random.default_rng(0).standard_normal((40, 5))


def test_mac_of_a_shape_with_itself_is_one_whatever_its_sign_and_scale(shapes):
    other = shapes * np.array([-1, 2, -1e-6, 1e6, 3])
    np.testing.assert_allclose(np.diag(mac(shapes, other)), 1, rtol=1e-12)
    np.testing.assert_allclose(mac(shapes, other), mac(shapes, shapes), rtol=1e-9)


def test_mac_of_modes_weighted_by_their_mass_is_the_identity():
    from scipy.linalg import eigh

    rng = np.random.default_rng(1)
    k, m = (root @ root.T + 30 * np.eye(30) for root in rng.standard_normal((2, 30, 30)))
    modes = eigh(k, m)[1][:, :8]
    np.testing.assert_allclose(mac(modes, modes, m), np.eye(8), atol=1e-12)


def test_mac_between_a_shape_and_its_turned_self_is_the_squared_cosine():
    angle = 0.3
    turned = np.array([[np.cos(angle)], [np.sin(angle)]])
    np.testing.assert_allclose(
        mac(np.eye(2), turned), np.array([[np.cos(angle)], [turned[1, 0]]]) ** 2
    )


def test_mac_lies_between_zero_and_one(shapes):
    matrix = mac(shapes, np.hstack([shapes[:, ::-1], 1e-150 * shapes]))
    assert matrix.shape == (5, 10)
    assert (matrix >= 0).all() and (matrix <= 1).all()


def test_mac_refuses_what_cannot_be_compared(shapes):
    with pytest.raises(ValueError, match="one column per mode"):
        mac(shapes, shapes[:-1])
    for bad in (0.0, np.nan):
        broken = shapes.copy()
        broken[:, 2] = bad
        with pytest.raises(ValueError, match="mode 3 of the second set is zero, not finite"):
            mac(shapes, broken)


def test_mac_picture_writes_values_while_they_fit():
    matrix = np.array([[1.0, 0.25], [0.0, 0.5], [0.1, 0.2]])
    ax = Figure().subplots()
    draw_mac(ax, matrix, ModeLabels("5 mm", [10.0, 20.0, 30.0]), ModeLabels("2.5 mm"))
    assert [text.get_text() for text in ax.texts] == [
        "1.00",
        "0.25",
        "0.00",
        "0.50",
        "0.10",
        "0.20",
    ]
    assert ax.get_ylabel() == "mode of 5 mm"
    assert [tick.get_text() for tick in ax.get_yticklabels()] == [
        "1\n10 Hz",
        "2\n20 Hz",
        "3\n30 Hz",
    ]
    many = Figure().subplots()
    draw_mac(many, np.eye(30), ModeLabels("a"), ModeLabels("b"))
    assert not many.texts and len(many.get_xticks()) <= 12


def test_modal_density_of_a_known_count_is_its_slope():
    np.testing.assert_allclose(modal_density(GRID, 0.7 * GRID), 0.7)
    np.testing.assert_allclose(modal_density(GRID, np.stack([GRID, 2 * GRID]))[1], 2.0)
    # Of a count that grows as the square it is the slope at the mean of the band's ends.
    half = 2**0.25
    inside = slice(20, -20)
    expected = 2 * GRID * (half + 1 / half) / 2
    np.testing.assert_allclose(modal_density(GRID, GRID**2)[inside], expected[inside], rtol=2e-3)


def test_modal_density_refuses_frequencies_out_of_order():
    with pytest.raises(ValueError, match="ascending order"):
        modal_density(GRID[::-1], GRID)
    with pytest.raises(ValueError, match="do not fit 200 frequencies"):
        modal_density(GRID, GRID[1:])


def test_plate_estimate_is_the_modal_density_of_a_simply_supported_plate():
    a, b, thickness = 0.7, 0.4, 500e-6
    bending = FEP.youngs_modulus * thickness**3 / 12 / (1 - FEP.poisson_ratio**2)
    m, n = np.meshgrid(np.arange(1, 400), np.arange(1, 400))
    # Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells: f of mode (m, n).
    f = np.pi / 2 * np.sqrt(bending / (FEP.density * thickness)) * ((m / a) ** 2 + (n / b) ** 2)
    grid = np.geomspace(100, 4000, 100)
    count = np.searchsorted(np.sort(f, axis=None), grid)
    counted = modal_density(grid, count)
    estimate = Plate(FEP, thickness).modal_density(a * b)
    # Supported edges take perimeter / (4 pi) dk/df away from the asymptotic value.
    k = np.sqrt(2 * np.pi * grid) * (FEP.density * thickness / bending) ** 0.25
    edges = 2 * (a + b) / (4 * np.pi) * k / (2 * grid)
    np.testing.assert_allclose(counted[50:-10], (estimate - edges)[50:-10], rtol=0.02)
    assert counted[-10] == pytest.approx(estimate, rel=0.05)


def test_frequency_of_a_wave_is_that_of_the_plate_mode_with_the_same_wavelength():
    side, thickness = 0.3, 250e-6
    bending = FEP.youngs_modulus * thickness**3 / 12 / (1 - FEP.poisson_ratio**2)
    first = np.pi * np.sqrt(bending / (FEP.density * thickness)) / side**2
    wave = Plate(FEP, thickness).frequency_of_wave(side * np.sqrt(2))
    assert wave == pytest.approx(first, rel=1e-12)


def test_plate_of_a_study_has_the_area_of_its_foil():
    cube = make_cube(seeds=1)
    density = plate_modal_density(cube).sel(thickness=500).sel(overlength=30.77, method="nearest")
    expected = Plate(FEP, 500e-6).modal_density(np.pi * 0.2 * 0.17)
    assert float(density) == pytest.approx(expected)
    unknown = cube.assign_attrs(config="")
    assert plate_modal_density(unknown) is None
    assert resolved_up_to(unknown) is None


def test_counted_density_leaves_failed_realisations_out():
    cube = make_cube(seeds=2, verdicts={(3, 2, 0): FAILED})
    cube["mode_count"][3, 2, 0] = 7.0
    density = counted_modal_density(cube).isel(thickness=3, overlength=2)
    assert np.isnan(density[0]).all()
    top = density[1].sel(frequency=slice(500, None))
    np.testing.assert_allclose(top, MODES_PER_HZ, rtol=0.02)


def curves(offset, scatter, seeds, rng):
    """|D| of overlengths with ln-offsets (o, f) and seeds that scatter by `scatter`."""
    shape = (len(offset), seeds, GRID.size)
    noise = scatter * rng.standard_normal(shape)
    return 1e4 * np.exp(np.asarray(offset)[:, None] + noise)


def test_spread_finds_the_standard_deviations_it_was_made_with():
    rng = np.random.default_rng(4)
    offset = rng.standard_normal((60, 1)) * np.ones(GRID.size)
    offset *= 0.4 / offset[:, 0].std(ddof=1)
    spread = overlength_spread(GRID, curves(offset, 0.1, 40, rng))
    np.testing.assert_allclose(spread.between, 0.4, rtol=0.02)
    np.testing.assert_allclose(spread.within, 0.1, rtol=0.02)
    np.testing.assert_allclose(spread.deviation.mean(axis=0), 0, atol=1e-12)


def test_overlengths_become_one_curve_where_their_spread_meets_that_of_the_seeds():
    rng = np.random.default_rng(5)
    offset = np.array([-1.0, 0.0, 1.0])[:, None] * (1.0 / GRID)  # deviation 1 / f
    magnitude = curves(offset, 0.02, 200, rng)
    spread = overlength_spread(GRID, magnitude)
    octave = np.linspace(-0.5, 0.5, 1001)
    factor = np.sqrt(np.mean(4.0**-octave))  # of 1 / f: root mean square over an octave
    assert spread.one_curve_from_hz == pytest.approx(50 * factor, rel=0.06)
    low, high = leave_one_out(GRID, magnitude[:, :12])
    assert low <= overlength_spread(GRID, magnitude[:, :12]).one_curve_from_hz <= high


def test_few_seeds_do_not_pretend_that_equal_overlengths_differ():
    rng = np.random.default_rng(6)
    spread = overlength_spread(GRID, curves(np.zeros((5, 1)), 0.2, 3, rng))
    assert spread.ratio.max() < 0.6
    assert spread.one_curve_from_hz == GRID[0]


def test_curves_that_part_again_are_not_one():
    rng = np.random.default_rng(7)
    apart = (GRID < 10) | (GRID > 700)
    offset = np.array([-1.0, 1.0])[:, None] * apart
    spread = overlength_spread(GRID, curves(offset, 0.1, 6, rng))
    assert spread.ratio[100] < 1
    assert np.isnan(spread.one_curve_from_hz)
    assert np.isnan(leave_one_out(GRID, curves(offset, 0.1, 6, rng))).all()


def test_missing_realisations_leave_the_spread_of_the_others():
    rng = np.random.default_rng(8)
    offset = np.linspace(-1, 1, 6)[:, None] * np.ones(GRID.size)
    magnitude = curves(offset, 0.1, 30, rng)
    magnitude[0, 4:] = np.nan
    magnitude[5] = np.nan
    spread = overlength_spread(GRID, magnitude)
    assert np.isnan(spread.deviation[5]).all()
    expected = np.linspace(-1, 0.6, 5).std(ddof=1)
    np.testing.assert_allclose(spread.between, expected, rtol=0.03)


@pytest.mark.parametrize("shape", [(1, 6), (5, 1), (0, 0)])
def test_spread_without_overlengths_or_seeds_is_refused(shape):
    with pytest.raises(ValueError, match="two overlengths, and two of one of them"):
        overlength_spread(GRID, np.ones((*shape, GRID.size)))


def test_findings_tell_the_frequency_from_which_the_overlengths_agree():
    cube = make_cube(thickness_um=(500.0,), seeds=6, cv=lambda overlength, direction: 0.2)
    each = cube["dynamic_stiffness"]
    agree = each.mean("overlength").broadcast_like(each)
    below = cube["frequency"] < 100
    cube["dynamic_stiffness"] = (agree + below * (each - agree)).transpose(*each.dims)
    start = overlength_spread(
        cube["frequency"].values, relative_magnitude(cube, 500.0, "axial")
    ).one_curve_from_hz
    levels, verdict = overlength_findings(cube)
    assert "at 1 Hz and of 1.0 between 400 and 800 Hz" in levels
    assert "in 2 of 2 cases: axial 500 µm from " in verdict
    assert f"from {start:.0f} Hz" in verdict
    assert overlength_findings(make_cube(seeds=1)) == []


def test_findings_tell_the_modal_density_beside_a_plate():
    cube = make_cube(thickness_um=(50.0, 500.0), seeds=2, case=COARSE)
    first, mesh = modal_density_findings(cube)
    assert "has 0.30 modes per Hz" in first and "flat plate of the same foil" in first
    assert "above 136 Hz at 50 µm: beyond" in mesh
    assert modal_density_findings(cube.drop_vars("mode_count")) == []
