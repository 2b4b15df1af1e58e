"""Measured responses from files, and beside the simulated ones of a cube."""

import numpy as np
import pytest
import pyuff
from matplotlib.colors import same_color
from scipy.io import savemat
from synthetic import FAILED, make_cube, write_cube

from foilstudy.base.errors import Refusal
from foilstudy.bench.comparison import Comparison, Configuration, frac, simulated
from foilstudy.bench.estimation.estimate import Estimate
from foilstudy.bench.figure import draw
from foilstudy.bench.measured import READERS, read_response
from foilstudy.bench.measured.conversion import UNITS, as_stiffness, unit_named
from foilstudy.bench.measured.table import chosen
from foilstudy.command import main
from foilstudy.config import ConfigError, load_config
from foilstudy.present import jobs
from foilstudy.present import redraw as redrawing
from foilstudy.present.files import StudyFiles
from foilstudy.present.measured import findings
from foilstudy.present.measured_files import MeasuredFile, measured_of, stale_page
from foilstudy.present.report import write_report
from foilstudy.present.statistics.tables import write_tables
from foilstudy.study.sweep.origins import cube_origin

F = np.array([1.0, 2.5, 10.0, 100.0])
K, M = 2000.0, 0.3
STIFFNESS = K * (1 + 0.05j) - M * (2 * np.pi * F) ** 2
"""A mass on a spring with losses, N/m."""


def measured_in(unit):
    """The mass and spring in a unit."""
    quantity, size = UNITS[unit]
    values = {
        "dynamic stiffness": STIFFNESS,
        "receptance": 1 / STIFFNESS,
        "accelerance": -((2 * np.pi * F) ** 2) / STIFFNESS,
    }[quantity.name]
    return values / size


# --- units ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("unit", UNITS)
def test_every_unit_gives_the_stiffness_of_a_known_mass_and_spring(unit, tmp_path):
    path = write_csv(tmp_path / "run.csv", measured_in(unit), unit)
    assert np.allclose(read_response(path).values, STIFFNESS, rtol=1e-12)


def test_one_gram_per_newton_by_hand(tmp_path):
    """1 g/N at 1 Hz: 9.80665 m/s^2 is 0.2484 m, so 4.0257 N/m against the motion."""
    quantity, size = unit_named("g/N", tmp_path)
    found = quantity.stiffness(np.array([1.0]), np.array([size * 1.0]))
    assert found == pytest.approx(-4.0257, rel=1e-4)


@pytest.mark.parametrize(
    ("written", "meant"),
    [("µm/N", "um/N"), ("m/s²/N", "m/s^2/N"), ("(m/s2)/N", "m/s^2/N"), (" kN/m ", "kN/m")],
)
def test_units_as_they_are_also_written(written, meant, tmp_path):
    assert unit_named(written, tmp_path) == UNITS[meant]


def test_deviation_goes_with_the_value():
    quantity, _ = UNITS["m/N"]
    found = as_stiffness(None, quantity, F, 1 / STIFFNESS, 0.01 * np.abs(1 / STIFFNESS))
    assert np.allclose(found.deviation, 0.01 * np.abs(STIFFNESS))
    assert np.isnan(found.coherence).all() and found.trusted.all()


# --- files ---------------------------------------------------------------------------------------


def write_csv(path, values, unit="N/m", mark=","):
    rows = [mark.join([f"frequency (Hz){mark}real ({unit}){mark}imag ({unit})"])]
    for row in zip(F, values.real, values.imag):
        text = mark.join(repr(float(x)) for x in row)
        rows.append(text.replace(".", ",") if mark == ";" else text)
    path.write_text("# measured\n" + "\n".join(rows) + "\n", encoding="utf-8")
    return path


def write_mat(path, values, unit="N/m"):
    savemat(path, {"frequency_Hz": F, "response": values, "unit": unit})
    return path


def function_58(values, types=(13, 8), units=("N", "m"), name="axial"):
    return {
        "type": 58, "func_type": 4, "binary": 0, "id1": name, "x": F, "data": values,
        "rsp_node": 1, "rsp_dir": 3, "ref_node": 2, "ref_dir": 3, "abscissa_spacing": 0,
        "abscissa_spec_data_type": 18, "ordinate_spec_data_type": types[0],
        "orddenom_spec_data_type": types[1], "ordinate_axis_units_lab": units[0],
        "orddenom_axis_units_lab": units[1],
    }  # fmt: skip


def units_164(length=1.0, force=1.0):
    return pyuff.prepare_164(
        units_code=9, units_description="", temp_mode=1, length=length, force=force, temp=1.0,
        temp_offset=0.0,
    )  # fmt: skip


def write_uff(path, *sets):
    pyuff.UFF(str(path)).write_sets(list(sets), "overwrite")
    return path


@pytest.mark.parametrize("mark", [",", ";", "\t"])
def test_a_table_comes_back_to_the_last_digit(mark, tmp_path):
    found = read_response(write_csv(tmp_path / "run.csv", STIFFNESS, mark=mark))
    assert np.array_equal(found.frequencies, F) and np.array_equal(found.values, STIFFNESS)


def test_a_table_of_magnitude_and_phase_with_quality(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text(
        "frequency (Hz),magnitude (kN/m),phase (deg),deviation (kN/m),coherence\n"
        "1,2,90,0.1,0.99\n2,3,180,0.2,0.5\n"
    )
    found = read_response(path)
    assert np.allclose(found.values, [2000j, -3000])
    assert np.allclose(found.deviation, [100, 200])
    assert found.trusted.tolist() == [True, False]


def test_matlab_variables_come_back_to_the_last_bit(tmp_path):
    found = read_response(write_mat(tmp_path / "run.mat", STIFFNESS))
    assert np.array_equal(found.frequencies, F) and np.array_equal(found.values, STIFFNESS)


def test_a_structure_of_matlab_is_found_by_its_name(tmp_path):
    one, other = ({"frequency_Hz": F, "response": n * STIFFNESS, "unit": "N/m"} for n in (1.0, 2.0))
    savemat(tmp_path / "run.mat", {"axial": one, "radial": other})
    found = read_response(tmp_path / "run.mat", "rad")
    assert np.array_equal(found.values, 2 * STIFFNESS)


def test_a_universal_file_comes_back_to_its_twelve_digits(tmp_path):
    found = read_response(write_uff(tmp_path / "run.uff", units_164(), function_58(STIFFNESS)))
    assert np.allclose(found.values, STIFFNESS, rtol=1e-12)
    assert np.allclose(found.frequencies, F, rtol=1e-6)


@pytest.mark.parametrize(
    ("types", "unit"), [((13, 8), "N/m"), ((8, 13), "m/N"), ((12, 13), "m/s^2/N")]
)
def test_units_of_a_universal_file_are_its_factors(types, unit, tmp_path):
    """Millimetre and kilonewton: 1000 and 0.001 units to one of SI."""
    per_length = measured_in(unit) * (1e-6 if types[0] == 13 else 1e6)
    path = write_uff(tmp_path / "run.unv", units_164(1e3, 1e-3), function_58(per_length, types))
    assert np.allclose(read_response(path).values, STIFFNESS, rtol=1e-5)


def test_without_factors_the_labels_of_the_axes_count(tmp_path):
    receptance = function_58(measured_in("mm/N"), (8, 13), ("mm", "N"))
    found = read_response(write_uff(tmp_path / "run.uff", receptance))
    assert np.allclose(found.values, STIFFNESS, rtol=1e-5)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("frequency (Hz),real (N/m)\n1,2\n2,3\n", "are no complex number"),
        ("frequency (Hz),real (N/in),imag (N/in)\n1,2,0\n2,3,0\n", "'N/in' is no unit"),
        ("frequency (kHz),real (N/m),imag (N/m)\n1,2,0\n2,3,0\n", "in 'kHz'; give it in Hz"),
        ("f,real (N/m),imag (N/m)\n1,2,0\n2,3,0\n", "no column is headed"),
        ("frequency (Hz),real (N/m),imag (N/mm)\n1,2,0\n2,3,0\n", "different units"),
        ("frequency (Hz),magnitude (N/m),phase (turn)\n1,2,0\n2,3,0\n", "phase is in 'turn'"),
        ("frequency (Hz),real (N/m),imag (N/m)\n1,2,0\n2,x,0\n", "row 3 holds '2,x,0'"),
        ("frequency (Hz),real (N/m),imag (N/m)\n1,2\n2,3,0\n", "not 3 numbers"),
        ("frequency (Hz),real (N/m),imag (N/m)\n2,2,0\n1,3,0\n", "do not rise"),
        ("frequency (Hz),real (N/m),imag (N/m)\n1,nan,0\n2,3,0\n", "missing, infinite"),
        ("frequency (Hz),real (m/N),imag (m/N)\n1,0,0\n2,3,0\n", "or zero"),
        ("frequency (Hz),real (N/m),imag (N/m)\n1,2,0\n", "has 2 lines"),
        ("frequency (Hz)\n1\n2\n", "holds no response"),
        ("frequency,real (N/m),imag (N/m)\n1,2,0\n2,3,0\n", "frequency states no unit"),
        (
            "frequency (Hz),real (N/m),imag (N/m),coherence\n1,2,0,99\n2,3,0,98\n",
            "coherence is not within 0 and 1; give it as a share",
        ),
        (
            "frequency (Hz),real (N/m),imag (N/m),deviation (N/m)\n1,2,0,-1\n2,3,0,1\n",
            "standard deviation is negative",
        ),
        ("frequency (Hz),a real (N/m),b real (N/m)\n1,1,1\n2,1,1\n", "2 functions fit; name one"),
    ],
)
def test_tables_that_say_too_little_are_refused_in_a_sentence(text, words, tmp_path):
    path = tmp_path / "run.csv"
    path.write_text(text)
    with pytest.raises(Refusal, match=words) as refused:
        read_response(path)
    assert str(path) in str(refused.value) and str(refused.value).endswith(".")


@pytest.mark.parametrize(
    ("sets", "words"),
    [
        ([function_58(STIFFNESS, units=("NONE", "NONE"))], "states no units"),
        ([function_58(STIFFNESS, units=("m", "N"))], "say dynamic stiffness, its units receptance"),
        ([units_164(), function_58(STIFFNESS, (11, 13))], "data types 11 over 13"),
        ([units_164(), function_58(STIFFNESS), function_58(STIFFNESS)], "2 functions are called"),
        ([units_164()], "holds no response"),
    ],
)
def test_universal_files_that_say_too_little_are_refused(sets, words, tmp_path):
    with pytest.raises(Refusal, match=words):
        read_response(write_uff(tmp_path / "run.uff", *sets))


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("run.xls", b"", "read from .csv, .mat, .uff, .unv"),
        ("run.mat", b"no file", "cannot be read as a MATLAB file"),
        ("run.csv", b"\xff\xfe\x00", "no text in UTF-8"),
        ("run.uff", b"no file", "cannot be read as a Universal File|holds no response"),
    ],
)
def test_files_that_are_none_are_refused(name, content, words, tmp_path):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(Refusal, match=words):
        read_response(tmp_path / name)


def test_matlab_variables_that_are_missing_are_named(tmp_path):
    savemat(tmp_path / "run.mat", {"frf": STIFFNESS})
    with pytest.raises(Refusal, match="holds frf, not frequency_Hz, response, unit"):
        read_response(tmp_path / "run.mat")


def test_a_file_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(Refusal, match="no such file"):
        read_response(tmp_path / "run.csv")


def test_every_format_of_the_registry_loads():
    assert all(callable(READERS[name]) for name in READERS)


def test_a_response_without_name_is_called_by_none(tmp_path):
    with pytest.raises(Refusal, match="its one response has no name; leave --function out"):
        chosen(tmp_path, [""], "axial")


def test_an_exact_name_wins_over_longer_ones(tmp_path):
    assert chosen(tmp_path, ["axial", "transfer axial"], "axial") == "axial"
    with pytest.raises(Refusal, match="no function is called 'axal'; did you mean axial"):
        chosen(tmp_path, ["axial", "radial"], "axal")


# --- comparison ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def cube():
    return make_cube(cv=lambda overlength, direction: 0.1)


CASE = Configuration(500.0, 170.0)


def test_frac_does_not_see_a_factor_and_is_small_for_another_shape():
    assert frac(STIFFNESS, 3j * STIFFNESS) == pytest.approx(1)
    one, other = np.array([1.0, 1.0, 0.0]), np.array([1.0, -1.0, 5.0])
    assert frac(one, other) == pytest.approx(0)
    assert frac(one, np.array([1.0, 0, 0])) == pytest.approx(0.5)


def test_the_realisations_of_a_configuration_are_found(cube):
    own = simulated(cube, CASE)
    assert (own.thickness_um, own.height_mm) == (500, 170) and len(own.curves) == 6
    there = cube["dynamic_stiffness"].sel(thickness=500, direction="axial", definition="transfer")
    assert np.array_equal(own.curves, there.isel(overlength=2).values)
    assert np.allclose(own.at(own.frequencies), own.curves)


def test_failed_realisations_do_not_count():
    own = simulated(make_cube(verdicts={(3, 2, 1): FAILED}), CASE)
    assert len(own.curves) == 5 and own.static.n == 5


def one_of(own, factor=1.0, deviation=0.0, coherence=1.0):
    full = np.ones(own.frequencies.size)
    return Estimate(own.frequencies, factor * own.curves[0], deviation * full, coherence * full)


def test_a_realisation_itself_lies_in_the_band_and_has_frac_1(cube):
    own = simulated(cube, CASE)
    found = Comparison.of(one_of(own), own)
    assert found.excursions == []
    assert found.frac_range[1] == pytest.approx(1) and found.frac > 0.9


def test_what_leaves_the_band_is_a_run_with_its_side_and_factor(cube):
    own = simulated(cube, CASE)
    top = np.abs(own.curves).max(axis=0)
    inside = own.curves[0].copy()
    run = (own.frequencies > 20) & (own.frequencies < 50)
    inside[run] *= (2 * top / np.abs(inside))[run]
    low = own.frequencies > 400
    inside[low] *= 1e-3
    (above, below) = Comparison.of(
        Estimate(own.frequencies, inside, 0 * top, top / top), own
    ).excursions
    assert above.above and above.factor == pytest.approx(2)
    assert (above.low_hz, above.high_hz) == tuple(own.frequencies[run][[0, -1]])
    assert not below.above and below.low_hz == own.frequencies[low][0]


def test_an_interval_that_reaches_the_band_has_not_left_it(cube):
    own = simulated(cube, CASE)
    factor = 1.5
    outside = Comparison.of(one_of(own, factor), own)
    wide = Comparison.of(one_of(own, factor, deviation=10 * np.abs(own.curves).max()), own)
    assert outside.excursions and not wide.excursions


def test_values_that_are_not_coherent_do_not_count(cube):
    own = simulated(cube, CASE)
    estimate = one_of(own, 5.0)
    estimate.coherence[:] = np.where(own.frequencies < 30, 1.0, 0.5)
    found = Comparison.of(estimate, own)
    assert found.ratio == pytest.approx(5, rel=0.2)
    (run,) = found.excursions
    assert run.high_hz < 30


def test_values_that_are_not_coherent_are_never_on_a_solid_line(cube):
    own = simulated(cube, CASE)
    estimate = one_of(own, 5.0)
    estimate.coherence[:] = np.where(own.frequencies < 30, 1.0, 0.5)
    doubtful = own.frequencies[own.frequencies >= 30]
    for ax in draw(Comparison.of(estimate, own), "").axes:
        lines = [line for line in ax.lines if same_color(line.get_color(), "#b2182b")]
        dots = [line for line in lines if line.get_linestyle() == "None"]
        (solid,) = (line for line in lines if line.get_linestyle() == "-")
        assert np.isnan(solid.get_ydata()[own.frequencies >= 30]).all()
        assert np.isfinite(solid.get_ydata()[own.frequencies < 30]).all()
        assert any(np.array_equal(line.get_xdata(), doubtful) for line in dots)


def test_without_coherence_at_low_frequencies_there_is_no_static_value(cube):
    own = simulated(cube, CASE)
    estimate = one_of(own)
    estimate.coherence[own.frequencies < 15] = 0.5
    found = Comparison.of(estimate, own)
    assert found.static is None and found.frac_range[1] == pytest.approx(1)
    assert "ratio" in dict(findings(found))


def test_without_coherence_anywhere_it_says_so_and_no_number(cube):
    own = simulated(cube, CASE)
    estimate = one_of(own)
    estimate.coherence[:] = 0.5
    said = dict(findings(Comparison.of(estimate, own)))
    assert said["not compared"] == "no value of enough coherence in the whole band"
    assert "nan" not in " ".join(said.values())


@pytest.mark.parametrize(
    ("wanted", "words"),
    [
        ({"thickness_um": None}, "has thickness 50, 130, 250, 500 um; say which by --thickness"),
        ({"thickness_um": 400.0}, "no thickness of 400 um; choose one of 50"),
        ({"height_mm": 171.0}, "no height of 171 mm"),
        ({"direction": "axal"}, "did you mean axial"),
        ({"definition": "drive"}, "'drive' is no definition"),
    ],
)
def test_a_configuration_that_the_cube_does_not_have_is_refused(cube, wanted, words):
    with pytest.raises(Refusal, match=words):
        simulated(cube, Configuration(**{"thickness_um": 500.0, "height_mm": 170.0} | wanted))


def test_bands_that_do_not_meet_are_refused(cube):
    own = simulated(cube, CASE)
    high = Estimate(np.array([900.0, 950.0]), np.ones(2) + 0j, np.zeros(2), np.ones(2))
    with pytest.raises(Refusal, match="share 0 frequencies"):
        Comparison.of(high, own)


def test_a_configuration_without_usable_realisation_is_refused():
    cube = make_cube(verdicts={(3, 2, s): FAILED for s in range(6)})
    with pytest.raises(Refusal, match="no realisation of 500 um, 170 mm is usable"):
        simulated(cube, CASE)


# --- the command ---------------------------------------------------------------------------------


def written(own, path, factor=1.0):
    """The first realisation as a measured one."""
    rows = ["frequency (Hz),real (N/m),imag (N/m)"]
    rows += [
        f"{f!r},{v.real!r},{v.imag!r}"
        for f, v in zip(own.frequencies.tolist(), (factor * own.curves[0]).tolist())
    ]
    path.write_text("\n".join(rows))
    return path


def test_compare_prints_and_draws(cube, tmp_path, capsys):
    write_cube(cube.copy(), tmp_path / "cube.nc")
    written(simulated(cube, CASE), tmp_path / "run.csv")
    words = ["--thickness", "500", "--height", "170"]
    main(["compare", str(tmp_path / "run.csv"), str(tmp_path), *words])
    said = capsys.readouterr().out
    assert "500 um, 170 mm (30.8 %), axial transfer stiffness" in said
    assert "0 % of the values leave the band" in said and "to 1.000 with one each" in said
    assert "60 values from 1 to 800 Hz, their coherence unknown" in said
    assert (tmp_path / "run-compared.png").stat().st_size > 10_000
    with pytest.raises(SystemExit, match="say which by --height"):
        main(["compare", str(tmp_path / "run.csv"), str(tmp_path), "--thickness", "500"])
    with pytest.raises(SystemExit, match="there is no such file"):
        main(["compare", str(tmp_path / "ran.csv"), str(tmp_path)])


def test_the_page_of_a_study_shows_what_was_measured_beside_it(cube, tmp_path):
    write_cube(cube.copy(), tmp_path / "cube.nc")
    own = simulated(cube, CASE)
    measured = [
        MeasuredFile(written(own, tmp_path / "run.csv"), CASE),
        MeasuredFile(written(own, tmp_path / "hard.csv", 3.0), CASE),
    ]
    files = StudyFiles(tmp_path / "cube.nc", measured=tuple(measured))
    write_tables(files.cube, tmp_path)
    page = write_report(files, tmp_path / "report.html").read_text("utf-8")
    section = page[page.index('<section id="measured">') :].split("</section>")[0]
    assert section.count("data:image/svg+xml") == 2 and '<a href="#measured">' in page
    soft, hard = section.split("<h3>")[1:]
    assert "run.csv: 500 um, 170 mm (30.8 %), axial transfer stiffness" in soft
    assert "to 1.000 with one each" in soft and "0 % of the values leave the band" in soft
    assert "1 to 800 Hz: above, by up to" in hard


def test_a_measurement_that_has_no_place_in_the_cube_stops_the_page(cube, tmp_path):
    write_cube(cube.copy(), tmp_path / "cube.nc")
    run = written(simulated(cube, CASE), tmp_path / "run.csv")
    words = ["report", str(tmp_path), "--measured", str(run), "--thickness", "500"]
    with pytest.raises(SystemExit, match="say which by --height"):
        main(words)
    with pytest.raises(SystemExit, match="--height is given 2 times for 1 measured files"):
        main([*words, "--height", "170", "--height", "135"])
    assert {path.name for path in tmp_path.iterdir()} == {"cube.nc", "run.csv"}


# --- by the configuration of a study -------------------------------------------------------------


def asked(file, **changed):
    """A configuration that names a measurement of a thickness and height that it has."""
    run = {"file": str(file), "thickness_um": 500, "height_mm": 170} | changed
    sweep = {"thickness_um": [50, 500], "reference_height_mm": [135, 170]}
    return load_config({"study": {"name": "seen"}, "sweep": sweep, "report": {"measured": [run]}})


def test_a_study_names_what_was_measured_and_only_its_page_depends_on_it(
    cube, tmp_path, monkeypatch
):
    write_cube(cube.copy(), tmp_path / "cube.nc")
    run = written(simulated(cube, CASE), tmp_path / "run.csv")
    study, page = asked(run), tmp_path / "report.html"
    plain = study.simulated
    assert not plain.report.measured and cube_origin(plain, {}, "") == cube_origin(
        asked(run, direction="radial").simulated, {}, ""
    )
    write_tables(cube, tmp_path)
    jobs.report(study, page)
    assert "run.csv: 500 um, 170 mm (30.8 %), axial transfer" in page.read_text("utf-8")
    assert list(stale_page(study, page)) == []
    others = plain, asked(run, definition="driving")
    assert all([each.path for each in stale_page(other, page)] == [page] for other in others)
    written(simulated(cube, CASE), run, factor=2.0)
    assert [each.path for each in stale_page(study, page)] == [page]
    monkeypatch.setattr(redrawing, "draw_figures", lambda *_: [])
    redrawing.redraw(tmp_path)  # keeps those that the page shows
    assert "run.csv: 500 um" in page.read_text("utf-8") and list(stale_page(study, page)) == []


def test_a_page_says_why_a_measurement_stands_alone(tmp_path):
    cube = make_cube(verdicts={(3, 2, s): FAILED for s in range(6)})
    write_cube(cube, tmp_path / "cube.nc")
    run = written(simulated(make_cube(), CASE), tmp_path / "run.csv")
    write_tables(cube, tmp_path)
    jobs.report(asked(run), tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text("utf-8")
    assert "no realisation of 500 um, 170 mm is usable" in page


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        (
            {"thickness_um": 130},
            r"measured\[0\].thickness_um is 130 um, which is not among sweep.t",
        ),
        ({"height_mm": 150}, r"height_mm is 150 mm, which is not among the reference heights"),
        ({"height_mm": None}, r"height_mm is missing, and the study has several \(135, 170 mm\)"),
        ({"hight_mm": 170}, r"report.measured\[0\].hight_mm is not a known key; did you mean"),
    ],
)
def test_a_measurement_that_the_study_does_not_have_is_refused(changed, words):
    with pytest.raises(ConfigError, match=words):
        asked("run.csv", **changed)


def test_a_measurement_that_cannot_be_read_is_refused_before_any_job(tmp_path):
    with pytest.raises(Refusal, match=r"report.measured\[0\].file: .*there is no such file"):
        measured_of(asked(tmp_path / "ran.csv"))
    (tmp_path / "feet.csv").write_text("frequency (Hz),real (lbf/ft),imag (lbf/ft)\n1,2,3\n2,3,4\n")
    with pytest.raises(Refusal, match=r"report.measured\[0\].file: .*lbf/ft"):
        measured_of(asked(tmp_path / "feet.csv"))
