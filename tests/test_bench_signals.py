"""Time signals from files of other tools: the same recording, and what is refused."""

import numpy as np
import pytest
import pyuff
from scipy.io import savemat

from foilstudy.base.errors import Refusal
from foilstudy.bench.estimation.best_linear import best_linear, measured_lines
from foilstudy.bench.estimation.periods import Periods
from foilstudy.bench.estimation.procedure import Published
from foilstudy.bench.estimation.static import Static
from foilstudy.bench.recording import MemoryRecording
from foilstudy.bench.rig.measurement import measured
from foilstudy.bench.rig.rig import Rig
from foilstudy.bench.rig.sensors import Sensors
from foilstudy.bench.rig.specimens.spring import Spring
from foilstudy.bench.signal_files import SIGNAL_FORMATS, read_signals, write_signals
from foilstudy.bench.signal_files.roles import as_recording, read_roles
from foilstudy.bench.signal_files.signals import Signals, even_rate
from foilstudy.bench.signals.multisine import Multisine

GAP, RATE = 0.13, 256.0
FORCE = Multisine(0.5, 60.0, rms=5.0, period_s=4.0).signal()


@pytest.fixture(scope="module")
def recording():
    link = Spring(axial=2000.0, radial=2000.0, rocking=50.0, torsion=50.0, gap_m=GAP)
    sensors = Sensors(full_scale_acceleration=100.0, full_scale_force=500.0)
    made = measured(Rig(link, GAP, sensors=sensors), FORCE, RATE, 16.0)
    return MemoryRecording(made.channels, RATE, made.read(0, made.samples))


def rewrite(path, sets):
    path.unlink()
    pyuff.UFF(str(path)).write_sets(sets, "add")


# --- there and back ------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["csv", "mat", "uff", "unv"])
def test_a_recording_comes_back_to_the_last_bit(recording, kind, tmp_path):
    write_signals(recording, tmp_path / f"run.{kind}")
    back = read_signals(tmp_path / f"run.{kind}")
    assert back.channels == recording.channels and back.rate_hz == RATE
    assert np.array_equal(back.values, recording.values)


def test_universal_files_in_text_have_twelve_digits(recording, tmp_path):
    write_signals(recording, tmp_path / "run.uff")
    sets = pyuff.UFF(str(tmp_path / "run.uff")).read_sets()
    rewrite(tmp_path / "run.uff", [each | {"binary": 0} for each in sets])
    back = read_signals(tmp_path / "run.uff")
    assert np.allclose(back.values, recording.values, rtol=1e-11, atol=0)


def test_a_step_of_six_digits_is_the_whole_rate_that_it_stands_for(recording, tmp_path):
    fast = MemoryRecording(recording.channels[:2], 51200.0, recording.values[:2])
    write_signals(fast, tmp_path / "run.uff")
    step = pyuff.UFF(str(tmp_path / "run.uff")).read_sets()[0]["abscissa_inc"]
    assert step != 1 / 51200 and read_signals(tmp_path / "run.uff").rate_hz == 51200


def test_the_same_code_reads_the_same_stiffness_from_files(recording, tmp_path):
    write_signals(recording, tmp_path / "run.mat")
    back = read_signals(tmp_path / "run.mat")
    for source in (recording, back):
        lines = measured_lines(source, Periods(4.0), 2, GAP, 60.0)
        found = Static.of(best_linear([lines], FORCE.lines).estimate)
        assert found.value == pytest.approx(2000, rel=5e-3)
    one, other = (Published().estimate([x], 2, GAP).within(1, 59) for x in (back, recording))
    assert np.allclose(one.values, other.values, rtol=1e-9)


@pytest.mark.parametrize(
    ("unit", "size"), [("mm/s^2", 1e-3), ("g", 9.80665), ("m/s²", 1.0), ("kN", 1e3), ("mN", 1e-3)]
)
def test_units_become_those_of_a_recording(unit, size, recording, tmp_path):
    write_signals(recording, tmp_path / "run.csv")
    roles = read_roles(tmp_path / "run.channels.csv")
    at = 0 if "s" in unit or unit == "g" else -1
    wanted = recording.channels[at]
    signals = Signals((wanted.name,), (unit,), RATE, recording.values[[at]] / size)
    (role,) = (r for r in roles if r.name == wanted.name)
    found = as_recording(tmp_path, signals, [role])
    assert np.allclose(found.values[0], recording.values[at], rtol=1e-14)
    assert found.channels[0].unit == wanted.unit
    assert found.channels[0].full_scale == pytest.approx(size * wanted.full_scale)


def test_factors_count_where_an_axis_has_no_label(tmp_path, recording):
    """A thousand millimetres to a metre: 1000 of the file's units of acceleration to one."""
    write_signals(recording, tmp_path / "run.uff")
    sets = pyuff.UFF(str(tmp_path / "run.uff")).read_sets()
    bare = [s | {"ordinate_axis_units_lab": "NONE"} for s in sets]
    units = pyuff.prepare_164(
        units_code=9, units_description="", temp_mode=1, length=1e3, force=1.0, temp=1.0,
        temp_offset=0.0,
    )  # fmt: skip
    rewrite(tmp_path / "run.uff", [units, *bare])
    back = read_signals(tmp_path / "run.uff")
    assert np.allclose(back.values[0], 1e-3 * recording.values[0], rtol=1e-14)
    assert np.array_equal(back.values[-1], recording.values[-1])


# --- what is refused -----------------------------------------------------------------------------


@pytest.fixture
def run(recording, tmp_path):
    """A file to spoil, and its table of channels."""
    short = MemoryRecording(recording.channels, RATE, recording.values[:, :200])
    write_signals(short, tmp_path / "run.csv")
    return tmp_path / "run.csv"


def spoil(path, old, new):
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("base_1z (m/s^2)", "base_1z (V)", "channel base_1z is in 'V', which is no unit"),
        ("base_1z (m/s^2)", "base_1z", "states no unit"),
        (
            "base_1z (m/s^2)",
            "base_1a (m/s^2)",
            "names base_1z, which is not in it; did you mean base_",
        ),
        ("time (s)", "time (ms)", "first column is headed 'time .ms.'"),
        ("\n0.00390625,", "\n0.005,", "not evenly spaced"),
        ("\n0.00390625,", "\nx,", "holds other than numbers"),
    ],
)
def test_signals_that_say_too_little_are_refused_in_a_sentence(run, old, new, words):
    spoil(run, old, new)
    with pytest.raises(Refusal, match=words) as refused:
        read_signals(run)
    assert str(run) in str(refused.value) and str(refused.value).endswith(".")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (",base,", ",floor,", "is on 'floor'; say which of base, metrology"),
        ("name,", "channel,", "give a row a channel with name, body"),
        ("base_1t,", "base_1z,", "base_1z stands there twice"),
        (",0.0,0.0,1.0,", ",up,0.0,1.0,", "the row of base_1z holds other than numbers"),
        (",0.0,0.0,1.0,", ",0.0,0.0,2.0,", "a direction of length 1, not 2"),
    ],
)
def test_tables_of_channels_that_say_too_little_are_refused(run, old, new, words):
    spoil(run.with_name("run.channels.csv"), old, new)
    with pytest.raises(Refusal, match=words):
        read_signals(run)


def test_without_a_table_of_channels_the_refusal_says_how_to_write_one(run):
    run.with_name("run.channels.csv").unlink()
    with pytest.raises(Refusal, match="write one with the columns name, body, x_m"):
        read_signals(run)


def test_a_sensor_that_is_saturated_is_found_without_its_full_scale(recording, tmp_path):
    flat = recording.values.copy()
    flat[3] = np.clip(flat[3], -np.inf, 0.5 * flat[3].max())
    spoiled = MemoryRecording(recording.channels, RATE, flat)
    write_signals(spoiled, tmp_path / "run.mat")
    with pytest.raises(Refusal, match="channel base_2t shows its extreme value .* saturated"):
        read_signals(tmp_path / "run.mat")


@pytest.mark.parametrize("steps", [3, 20, 1000])
def test_coarse_steps_are_no_flat_top(steps, tmp_path, recording):
    channel = recording.channels[0]
    write_signals(MemoryRecording((channel,), RATE, recording.values[:1]), tmp_path / "a.csv")
    roles = read_roles(tmp_path / "a.channels.csv")
    for phase in np.linspace(0, 1, 7):
        sine = (steps + phase) * np.sin(2 * np.pi * 0.61803 * np.arange(5000))
        signals = Signals((channel.name,), ("m/s^2",), RATE, np.round(sine)[None])
        assert as_recording(tmp_path, signals, roles).samples == 5000


def test_samples_that_are_none_and_channels_not_sampled_together_are_refused(recording, tmp_path):
    bad = recording.values.copy()
    bad[2, 7] = np.nan
    write_signals(MemoryRecording(recording.channels, RATE, bad), tmp_path / "run.mat")
    with pytest.raises(Refusal, match="channel base_2z has samples that are no finite numbers"):
        read_signals(tmp_path / "run.mat")
    write_signals(recording, tmp_path / "run.uff")
    sets = pyuff.UFF(str(tmp_path / "run.uff")).read_sets()
    sets[4] = sets[4] | {"x": sets[4]["x"][:-5], "data": sets[4]["data"][:-5]}
    rewrite(tmp_path / "run.uff", sets)
    with pytest.raises(Refusal, match="base_1z and base_3z were not sampled together"):
        read_signals(tmp_path / "run.uff")
    with pytest.raises(Refusal, match="several channels are called 'base_1z'"):
        rewrite(tmp_path / "run.uff", [sets[0], sets[0]])
        read_signals(tmp_path / "run.uff")


def test_files_that_are_none_are_refused(tmp_path):
    with pytest.raises(Refusal, match="no such file"):
        read_signals(tmp_path / "run.csv")
    (tmp_path / "run.wav").write_bytes(b"")
    with pytest.raises(Refusal, match="exchanged as .csv, .mat, .uff, .unv"):
        read_signals(tmp_path / "run.wav")
    savemat(tmp_path / "run.mat", {"signals": np.ones(3)})
    with pytest.raises(Refusal, match="holds signals, not signals, rate_Hz"):
        read_signals(tmp_path / "run.mat")
    names = np.array(["a", "b"], dtype=object)
    content = {"signals": np.ones((3, 1)), "rate_Hz": 1.0, "names": names, "units": names}
    savemat(tmp_path / "run.mat", content)
    with pytest.raises(Refusal, match="do not belong to 2 names and 2 units"):
        read_signals(tmp_path / "run.mat")
    with pytest.raises(Refusal, match="do not rise"):
        even_rate(tmp_path, np.zeros(3))
    assert all(callable(SIGNAL_FORMATS[name].read) for name in SIGNAL_FORMATS)


def test_too_few_periods_and_no_clock_in_common_are_refused_where_it_is_processed(recording):
    with pytest.raises(Refusal, match="leaves 1 whole periods of 7.5 s"):
        measured_lines(recording, Periods(7.5), 2, GAP, 60.0)
    with pytest.raises(Refusal, match="does not repeat from period to period"):
        measured_lines(recording, Periods(3.5), 2, GAP, 60.0)
