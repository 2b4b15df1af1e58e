"""Signals of the bench, and estimation from them, against theory."""

import numpy as np
import pytest

from foilstudy.base.errors import Refusal
from foilstudy.bench.estimation.best_linear import best_linear
from foilstudy.bench.estimation.channels import Combination, force_sum, frame_motion
from foilstudy.bench.estimation.confidence import deviation, radius
from foilstudy.bench.estimation.estimate import Estimate
from foilstudy.bench.estimation.estimators import ESTIMATORS
from foilstudy.bench.estimation.periods import Periods, period_means, require_synchronous
from foilstudy.bench.estimation.smoothing import moving_average
from foilstudy.bench.estimation.spectra import Blocks, averaged
from foilstudy.bench.estimation.static import Static
from foilstudy.bench.estimation.stitching import stitched
from foilstudy.bench.estimation.subtraction import without_bypass
from foilstudy.bench.recording import (
    Channel,
    MemoryRecording,
    Watched,
    open_recording,
    write_recording,
)
from foilstudy.bench.signals import EXCITATIONS
from foilstudy.bench.signals.multisine import Multisine
from foilstudy.bench.signals.noise import ColouredNoise

RATE = 256.0


def channels(*units, **more):
    return tuple(
        Channel(f"c{k}", unit, "base", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), **more)
        for k, unit in enumerate(units)
    )


def recorded(*rows, rate=RATE):
    values = np.array(rows)
    return MemoryRecording(channels(*["N"] * len(rows)), rate, values)


def noise(seconds, seed, rms=1.0):
    return rms * np.random.default_rng(seed).standard_normal(round(seconds * RATE))


# --- signals -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "excitation",
    [Multisine(1, 50, 3.0), Multisine(1, 50, 3.0, lines="odd_skipped", slope=1.0),
     ColouredNoise(1, 50, 3.0, duration_s=16.0, exponent=-2.0)],
    ids=["all", "odd_skipped", "noise"],
)  # fmt: skip
def test_parseval(excitation):
    """The mean square of the samples is that of the lines."""
    signal = excitation.signal()
    assert np.mean(signal.samples(RATE) ** 2) == pytest.approx(signal.rms**2, rel=1e-12)


def test_multisine_has_the_rms_asked_for_and_is_the_same_again():
    one, again = Multisine(0, 150, 2.0).signal(), Multisine(0, 150, 2.0).signal()
    assert one.rms == pytest.approx(2.0)
    assert np.array_equal(one.amplitudes, again.amplitudes)


def test_published_bands_and_spacing():
    low, high = (each.signal().frequencies for each in Multisine.published(1.0))
    assert (low[0], low[-1], high[0], high[-1]) == (0.125, 150, 100, 500)
    assert np.allclose(np.diff(low), 0.125) and np.allclose(np.diff(high), 0.125)


def test_another_realisation_has_the_same_lines_and_other_phases():
    one, other = (Multisine(1, 50, 1, lines="odd_skipped", realisation=k).signal() for k in (0, 1))
    assert np.array_equal(one.lines, other.lines)
    assert np.allclose(np.abs(one.amplitudes), np.abs(other.amplitudes))
    assert not np.allclose(one.amplitudes, other.amplitudes)


def test_of_every_four_odd_lines_one_detects():
    lines = Multisine(0.125, 50, 1, lines="odd_skipped").signal().lines
    odd = np.arange(1, 400, 2)
    assert (lines % 2 == 1).all()
    missing = np.setdiff1d(odd, lines)
    assert np.array_equal(np.bincount((missing // 2) // 4), np.ones(50))


def test_coloured_noise_has_its_power_and_slope():
    signal = ColouredNoise(1, 100, 2.0, duration_s=200, exponent=-2.0, seed=3).signal()
    assert signal.rms == pytest.approx(2.0, rel=0.2)
    power = np.abs(signal.amplitudes) ** 2
    octaves = [
        power[(signal.frequencies >= f) & (signal.frequencies < 2 * f)].mean() for f in (8, 32)
    ]
    assert octaves[1] / octaves[0] == pytest.approx(1 / 16, rel=0.15)


def test_every_excitation_of_the_registry_loads_by_its_name():
    assert {EXCITATIONS[name].kind for name in EXCITATIONS} == set(EXCITATIONS)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Multisine(1, 50, 1, lines="od"), "did you mean odd"),
        (lambda: Multisine(0.01, 0.02, 1).signal(), "lengthen the period"),
        (lambda: Multisine(1, 50, 1).signal().samples(80.0), "more than 100 Hz"),
        (lambda: Multisine(1, 50, 1, period_s=0.9).signal().samples(255.0), "whole number"),
        (lambda: ColouredNoise(5, 2, 1), "upper end"),
    ],
)
def test_signals_that_cannot_be_are_refused(make, words):
    with pytest.raises(Refusal, match=words):
        make()


# --- recordings ----------------------------------------------------------------------------------


def test_a_recording_comes_back_from_disk_to_single_precision(tmp_path):
    sent = MemoryRecording(
        channels("N", "m/s^2", full_scale=50.0), RATE, np.array([noise(300, 1), noise(300, 2)])
    )
    write_recording(sent, tmp_path / "run.nc")
    with open_recording(tmp_path / "run.nc") as back:
        assert back.channels == sent.channels and back.rate_hz == RATE
        assert back.samples == sent.samples > 1 << 16
        assert np.array_equal(back.read(1000, 70000), sent.values[:, 1000:70000].astype("f4"))


def test_a_file_that_is_no_recording_is_refused(tmp_path):
    path = tmp_path / "run.nc"
    path.write_text("no")
    with pytest.raises(Refusal, match="cannot be read as NetCDF"):
        open_recording(path)


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (lambda v: v.__setitem__((0, 7), np.nan), "c0 holds samples that are no finite"),
        (lambda v: v.__setitem__(1, 2.0), "c1 shows one constant value"),
        (lambda v: v.__setitem__((1, 3), -10.0), "c1 reaches its full scale"),
    ],
)
def test_unsound_channels_are_named(spoil, words):
    values = np.array([noise(4, 1), noise(4, 2)])
    spoil(values)
    watched = Watched(MemoryRecording(channels("N", "N", full_scale=10.0), RATE, values))
    for start in range(0, 1024, 256):
        watched.read(start, start + 256)
    with pytest.raises(Refusal, match=words):
        watched.require_sound()


@pytest.mark.parametrize(
    ("changed", "words"),
    [({"unit": "g"}, "unit 'g'; convert"), ({"body": "floor"}, "on 'floor'"),
     ({"direction": (1.0, 1.0, 0.0)}, "length 1")],
)  # fmt: skip
def test_channels_that_cannot_be_are_refused(changed, words):
    right = {
        "name": "a",
        "unit": "N",
        "body": "base",
        "position": (0, 0, 0),
        "direction": (0, 0, 1),
    }
    with pytest.raises(Refusal, match=words):
        Channel(**right | changed)


# --- spectra and estimators ----------------------------------------------------------------------


def test_density_of_white_noise():
    """Of unit variance up to half of the rate: 2 / rate."""
    spectra = averaged(recorded(noise(400, 5)), Blocks(1.0), 100)
    assert spectra.matrix[:, 0, 0].real.mean() == pytest.approx(2 / RATE, rel=0.01)


def test_power_of_a_sine_is_found_in_its_density():
    t = np.arange(round(20 * RATE)) / RATE
    spectra = averaged(recorded(3 * np.sin(2 * np.pi * 20 * t)), Blocks(2.0), 40)
    assert spectra.matrix[:, 0, 0].real.sum() * 0.5 == pytest.approx(4.5, rel=1e-9)


def test_spectra_read_each_sample_once():
    read = []

    class Counting(MemoryRecording):
        def read(self, start, stop):
            read.extend(range(start, stop))
            return super().read(start, stop)

    recording = Counting(channels("N"), RATE, noise(10, 1)[None])
    averaged(recording, Blocks(2.0, 0.75), 50)
    assert read == list(range(recording.samples))


def test_blocks_with_overlap_equal_those_cut_by_hand():
    from scipy.signal import csd

    x, y = noise(30, 1), noise(30, 2)
    ours = averaged(recorded(x, x + y), Blocks(2.0, 0.5), 100).of(0, 1)[2]
    _, theirs = csd(x, x + y, RATE, "hann", nperseg=512)
    assert np.allclose(ours, theirs[1:201], rtol=1e-10)


@pytest.mark.parametrize("name", list(ESTIMATORS))
def test_estimators_and_coherence_equal_those_from_the_spectra_of_scipy(name):
    """H1 = S_xy / S_xx, H2 = S_yy / S_yx, Hv their geometric mean."""
    from scipy.signal import coherence, csd, welch

    x, n = noise(60, 1), noise(60, 2)
    y = np.convolve(x, [0.5, 1.0, -0.3])[: x.size] + 0.4 * n
    ours = averaged(recorded(x, y), Blocks(2.0, 0.5), 100)
    how = {"window": "hann", "nperseg": 512, "fs": RATE}
    (_, xx), (_, yy), (_, xy) = welch(x, **how), welch(y, **how), csd(x, y, **how)
    h1, h2 = xy / xx, yy / xy.conj()
    theirs = {"h1": h1, "h2": h2, "hv": np.sqrt(np.abs(h1 * h2)) * xy / np.abs(xy)}[name]
    found = ESTIMATORS[name](*ours.of(0, 1))
    assert np.allclose(found, theirs[1:201], rtol=1e-10)
    assert np.allclose(ours.coherence(0, 1), coherence(x, y, **how)[1][1:201], rtol=1e-10)


def pyfrf_of(x, y):
    """pyFRF on blocks of 2 s that overlap by half, cut and windowed here: its own Hann window is
    the symmetric one."""
    from pyFRF import FRF

    window = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(512) / 512)
    cut = [np.lib.stride_tricks.sliding_window_view(each, 512)[::256] for each in (x, y)]
    blocks = [(each - each.mean(axis=1, keepdims=True)) * window for each in cut]
    return FRF(int(RATE), *blocks, resp_type="d")


def test_h1_h2_and_coherence_are_those_of_pyfrf():
    x, n = noise(60, 1), noise(60, 2)
    y = np.convolve(x, [0.5, 1.0, -0.3])[: x.size] + 0.4 * n
    ours, theirs = averaged(recorded(x, y), Blocks(2.0, 0.5), 100), pyfrf_of(x, y)
    assert np.array_equal(theirs.get_f_axis()[1:201], ours.frequencies)
    for name in ("h1", "h2"):
        known = theirs.get_FRF(name.upper())[0, 0, 1:201]
        assert np.allclose(ESTIMATORS[name](*ours.of(0, 1)), known, rtol=1e-10)
    assert np.allclose(ours.coherence(0, 1), theirs.get_coherence()[0, 1:201], rtol=1e-10)


@pytest.mark.parametrize("line", [0, 80, 199])
def test_hv_is_that_of_pyfrf_where_both_signals_are_of_one_size(line):
    """Its Hv takes noise of one size, in whatever units, at both; ours one share of either."""
    x, n = noise(60, 1), noise(60, 2)
    y = np.convolve(x, [0.5, 1.0, -0.3])[: x.size] + 0.4 * n
    spectra = averaged(recorded(x, y), Blocks(2.0, 0.5), 100).of(0, 1)
    size = np.sqrt(spectra[0] / spectra[1])[line]
    theirs = pyfrf_of(x, size * y).get_FRF("Hv")[0, 0, 1 + line] / size
    assert ESTIMATORS["hv"](*spectra)[line] == pytest.approx(theirs, rel=1e-10)


def test_independent_averages_of_overlapping_blocks():
    """Scatter of many densities of white noise is that of as many independent blocks."""
    values = np.random.default_rng(8).standard_normal((60, 20 * 64))
    spectra = averaged(MemoryRecording(channels(*["N"] * 60), 64.0, values), Blocks(1.0), 30)
    density = np.diagonal(spectra.matrix, axis1=1, axis2=2).real
    scatter = (density.std() / density.mean()) ** 2
    assert spectra.blocks == 39
    assert 1 / scatter == pytest.approx(spectra.averages, rel=0.1)
    assert spectra.averages == pytest.approx(39 / (1 + 2 * 38 / 39 / 36), rel=1e-3)


@pytest.fixture(scope="module")
def noisy():
    """Gain 5 between white noise of unit power, noise of 0.5 in the input, of 4 in the output."""
    true = noise(1500, 1)
    x, y = true + noise(1500, 2, np.sqrt(0.5)), 5 * true + noise(1500, 3, 2.0)
    return averaged(recorded(true, x, 5 * true, y), Blocks(1.0), 100)


def mean_response(spectra, name, source, sink):
    return ESTIMATORS[name](*spectra.of(source, sink)).mean().real


def test_noise_at_the_input_lowers_h1_as_theory_says(noisy):
    assert mean_response(noisy, "h1", 1, 2) == pytest.approx(5 / 1.5, rel=5e-3)
    assert mean_response(noisy, "h1", 0, 3) == pytest.approx(5, rel=5e-3)


def test_noise_at_the_output_raises_h2_as_theory_says(noisy):
    assert mean_response(noisy, "h2", 0, 3) == pytest.approx(5 * (1 + 4 / 25), rel=5e-3)
    assert mean_response(noisy, "h2", 1, 2) == pytest.approx(5, rel=5e-3)


def test_hv_is_the_geometric_mean(noisy):
    h1, h2, hv = (ESTIMATORS[name](*noisy.of(1, 3)) for name in ("h1", "h2", "hv"))
    assert np.allclose(np.abs(hv) ** 2, np.abs(h1 * h2))
    assert np.allclose(np.angle(hv), np.angle(h1))


@pytest.mark.parametrize("name", ESTIMATORS)
def test_a_delay_has_its_phase(name):
    """Of 3 samples: 3 / rate."""
    x = noise(200, 4)
    spectra = averaged(recorded(x, np.roll(x, 3)), Blocks(4.0), 100)
    response = ESTIMATORS[name](*spectra.of(0, 1))
    expected = np.exp(-2j * np.pi * spectra.frequencies * 3 / RATE)
    assert np.abs(response - expected).max() < 0.1


def test_coherence_of_known_noise(noisy):
    """1 / ((1 + 0.5)(1 + 4/25))."""
    assert noisy.coherence(1, 3).mean() == pytest.approx(1 / (1.5 * 1.16), rel=5e-3)


def test_h1_lies_within_its_stated_confidence():
    """In 95 % of 100 frequencies and 30 records, and scatters as stated."""
    inside, errors, stated = [], [], []
    for seed in range(30):
        x = noise(12, [seed, 0])
        spectra = averaged(recorded(x, 2 * x + noise(12, [seed, 1], 1.5)), Blocks(1.0), 100)
        response, coherence = ESTIMATORS["h1"](*spectra.of(0, 1)), spectra.coherence(0, 1)
        inside.append(np.abs(response - 2) <= radius(response, coherence, spectra.averages))
        errors.append(np.abs(response - 2) ** 2)
        stated.append(deviation(response, coherence, spectra.averages) ** 2)
    assert np.mean(inside) == pytest.approx(0.95, abs=0.015)
    assert np.mean(stated) == pytest.approx(np.mean(errors), rel=0.1)


def test_radius_is_that_of_fishers_quantile():
    from scipy.stats import f

    found = radius(np.array([2.0]), np.array([0.8]), 12.0)
    assert found == pytest.approx(2 * np.sqrt(0.25 * f.ppf(0.95, 2, 22) / 11))


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: averaged(recorded(noise(2, 1)), Blocks(2.0), 50), "gives 1 blocks"),
        (lambda: averaged(recorded(noise(9, 1)), Blocks(2.0), 200), "cannot be had"),
        (lambda: period_means(recorded(noise(9, 1)), Periods(4.0), 50), "leaves 1 whole"),
        (lambda: period_means(recorded(noise(9, 1)), Periods(0.3), 50), "whole number"),
        (lambda: Blocks(overlap=1.0), "overlap"),
    ],
)
def test_records_that_do_not_suffice_are_refused(call, words):
    with pytest.raises(Refusal, match=words):
        call()


# --- periods -------------------------------------------------------------------------------------


def filtered(signal):
    """A known linear system, a mass on a spring, in its steady state: values and response."""
    f = signal.frequencies
    response = 1 / (1 - (f / 20) ** 2 + 0.1j * f / 20)
    return type(signal)(signal.period_s, signal.lines, signal.amplitudes * response), response


def test_a_linear_system_is_recovered_within_the_stated_noise():
    signal = Multisine(1, 50, 1.0, period_s=4.0).signal()
    out, response = filtered(signal)
    x, y = (np.tile(each.samples(RATE), 9) for each in (signal, out))
    x, y = x + noise(36, 1, 0.3), y + noise(36, 2, 0.5)
    means = period_means(recorded(x, y), Periods(4.0), 60)
    best = best_linear([means], signal.lines)
    assert np.array_equal(best.frequencies, signal.frequencies)
    errors = np.abs(best.values - response) ** 2
    assert np.mean(errors / best.noise**2) == pytest.approx(1.15, abs=0.35)
    assert np.isnan(best.distortion).all()


def test_noise_that_input_and_output_share_is_no_error():
    """As of a rig that shakes by itself: the response is the same for it."""
    x = np.tile(Multisine(1, 50, 1.0, period_s=4.0).signal().samples(RATE), 6) + noise(24, 1)
    means = period_means(recorded(x, 2 * x), Periods(4.0), 50)
    assert np.allclose(means.variance(0, 1), 0, atol=1e-12)


def test_means_over_periods_do_not_leak():
    signal = Multisine(1, 50, 1.0, period_s=4.0).signal()
    out, response = filtered(signal)
    x, y = (np.tile(each.samples(RATE), 3) for each in (signal, out))
    best = best_linear([period_means(recorded(x, y), Periods(4.0), 60)], signal.lines)
    assert np.allclose(best.values, response, rtol=1e-10)


def test_distortion_is_told_from_noise():
    """y = x + 0.1 x^2 + 0.05 x^3: of a Gaussian-like x the best linear gain is 1 + 3*0.05*rms^2."""
    realisations, quiet = [], []
    for k in range(12):
        signal = Multisine(1, 50, 1.0, period_s=4.0, lines="odd_skipped", realisation=k).signal()
        x = np.tile(signal.samples(RATE), 3)
        y = x + 0.1 * x**2 + 0.05 * x**3
        means = period_means(recorded(x, y + noise(12, k, 1e-3)), Periods(4.0), 60)
        realisations.append(means)
        quiet.append(period_means(recorded(x, x + noise(12, k, 1e-3)), Periods(4.0), 60))
    best, linear = best_linear(realisations, signal.lines), best_linear(quiet, signal.lines)
    assert best.values.mean() == pytest.approx(1.15, abs=0.01)
    assert best.distortion.mean() > 30 * best.noise.mean()
    assert linear.total.mean() == pytest.approx(linear.noise.mean(), rel=0.1)
    # even lines and the odd ones left out show what kind it is
    lines = np.rint(means.frequencies * 4).astype(int)
    level = np.abs(means.means[:, 1])
    even = level[(lines % 2 == 0) & (lines < 200)].mean()
    odd = level[(lines % 2 == 1) & ~np.isin(lines, signal.lines) & (lines < 200)].mean()
    assert even > 20 * 1e-4 and odd > 20 * 1e-4


def test_a_record_that_does_not_repeat_is_refused():
    signal = np.tile(Multisine(1, 50, 1.0, period_s=4.0).signal().samples(RATE), 6)
    require_synchronous(period_means(recorded(signal), Periods(4.0), 60))
    with pytest.raises(Refusal, match="does not repeat"):
        require_synchronous(period_means(recorded(signal), Periods(3.0), 60))


# --- sensors to motions --------------------------------------------------------------------------


def placed(unit, count=3):
    found = []
    for k in range(count):
        angle = 2 * np.pi * k / count
        x, y = np.cos(angle), np.sin(angle)
        for axis, direction in enumerate(((0, 0, 1), (-y, x, 0))):
            place = (0.2 * x, 0.2 * y, 0.05)
            found.append(Channel(f"{k}{axis}", unit, "base", place, direction))
    return found


def test_rigid_motion_of_a_frame_comes_back_from_its_sensors():
    sensors = placed("m/s^2")
    motion = np.array([1.0, -2.0, 0.5, 0.1, 0.3, -0.2])
    point = np.array([0.01, 0.02, -0.1])
    shown = [
        np.dot(s.direction, motion[:3] + np.cross(motion[3:], np.array(s.position) - point))
        for s in sensors
    ]
    found = frame_motion(sensors, "base", tuple(point))
    assert np.allclose(found.weights @ shown, motion)
    omega2 = (2 * np.pi * 3.0) ** 2
    assert np.allclose(found.at(np.array([3.0]))[0] @ shown, -motion / omega2)


def test_forces_add_up_to_force_and_moment():
    sensors = placed("N")
    forces = np.arange(6.0)
    found = force_sum(sensors, "base", (0.0, 0.0, 0.0)).weights @ forces
    vectors = [f * np.array(s.direction) for f, s in zip(forces, sensors)]
    moments = [np.cross(s.position, v) for v, s in zip(vectors, sensors)]
    assert np.allclose(found, [*np.sum(vectors, axis=0), *np.sum(moments, axis=0)])


def test_arrays_that_leave_a_motion_open_are_refused():
    with pytest.raises(Refusal, match="do not tell its six motions apart"):
        frame_motion(placed("m/s^2")[:5], "base", (0.0, 0.0, 0.0))
    on_a_line = [s for s in placed("m/s^2", 6) if s.direction == (0, 0, 1)]
    with pytest.raises(Refusal, match="do not tell its six motions apart"):
        frame_motion(on_a_line, "base", (0.0, 0.0, 0.0))
    with pytest.raises(Refusal, match="no force channel"):
        force_sum(placed("m/s^2"), "base", (0.0, 0.0, 0.0))


def test_spectra_of_combinations_are_those_of_combined_signals():
    x, y = noise(30, 1), noise(30, 2)
    mixing = Combination(np.array([[1.0, 2.0], [0.5, -1.0]]), np.zeros(2, dtype=int))
    ours = averaged(recorded(x, y), Blocks(1.0), 50).combined(mixing)
    theirs = averaged(recorded(x + 2 * y, 0.5 * x - y), Blocks(1.0), 50)
    assert np.allclose(ours.matrix, theirs.matrix)


# --- smoothing, stitching, static value, subtraction ---------------------------------------------


def estimate(frequencies, values, deviation=0.0, coherence=1.0):
    frequencies = np.asarray(frequencies, float)
    full = np.ones_like(frequencies)
    return Estimate(frequencies, values * full + 0j, deviation * full, coherence * full)


def test_moving_average_leaves_a_line_alone_but_at_the_ends():
    f = np.arange(0.5, 100.5, 0.5)
    smooth = moving_average(f, 3 * f, 30.0)
    assert np.allclose(smooth[30:-30], 3 * f[30:-30])
    assert smooth[np.searchsorted(f, 10.0)] == pytest.approx(3 * f[f <= 25].mean())
    assert np.allclose(moving_average(f, f, 0.0), f)


def test_stitching_takes_each_band_on_its_side():
    low, high = estimate(np.arange(1, 151), 1.0), estimate(np.arange(100, 501), 2.0)
    whole = stitched(low, high, 120)
    assert np.array_equal(whole.frequencies, np.arange(1, 501))
    assert (whole.values[:119] == 1).all() and (whole.values[119:] == 2).all()
    with pytest.raises(Refusal, match="cannot be stitched at 160"):
        stitched(low, high, 160)


def test_static_value_is_the_mean_of_the_magnitude_with_its_interval():
    found = Static.of(estimate(np.arange(1, 21), 100j, deviation=np.sqrt(20.0)))
    assert (found.value, found.count) == (100.0, 10)
    assert found.high - found.value == pytest.approx(1.959964)
    with pytest.raises(Refusal, match="coherence is below"):
        Static.of(estimate(np.arange(1, 21), 100.0, coherence=0.5))


def test_subtraction_is_complex_and_adds_noise():
    both = estimate([1, 2], 5 + 2j, deviation=3.0, coherence=0.99)
    alone = estimate([1, 2], 1 + 2j, deviation=4.0, coherence=0.5)
    found = without_bypass(both, alone)
    assert np.allclose(found.values, 4) and np.allclose(found.deviation, 5)
    assert np.allclose(1 / found.coherence - 1, (29 / 99 + 5) / 16)
    with pytest.raises(Refusal, match="other frequencies"):
        without_bypass(both, estimate([1, 3], 1.0))
