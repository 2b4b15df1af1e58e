"""The Snakemake workflow: what it plans, what it refuses, what it makes again."""

import os
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

import frozen
import markupsafe
import numpy as np
import pytest
import xarray as xr
import yaml
from runs import ROOT, command, heed_interrupts, plan, run, snakemake
from small_study import SECTIONS, compute, sections_with

from foilstudy.base.record import read_record
from foilstudy.config.sections import CONSTANTS
from foilstudy.export.formats import FORMATS
from foilstudy.model.materials import MATERIALS
from foilstudy.present.figures import FIGURES

TINY = yaml.safe_load((ROOT / "config/tiny.yaml").read_text(encoding="utf-8"))
FEP = {key: getattr(MATERIALS["FEP"], key) for key in CONSTANTS}
# What differs between two runs of one study, and nothing else may.
COSTS = ("seconds_crumple", "seconds_static", "seconds_dynamic", "peak_memory")
OCCASION = ("created", "machine")


def changed(**sections):
    """The tiny study with some keys set otherwise."""
    return {name: {**TINY.get(name, {}), **sections.get(name, {})} for name in {**TINY, **sections}}


@pytest.fixture(scope="module")
def computed(tmp_path_factory):
    """A folder with a finished small study, of which Snakemake has never heard."""
    folder = tmp_path_factory.mktemp("computed")
    compute(folder / "results" / "small")
    return folder


@pytest.fixture
def finished(computed, tmp_path):
    return Path(shutil.copytree(computed, tmp_path / "copied"))


def test_tiny_study_has_one_job_per_step_and_realisation(tmp_path):
    jobs = plan(tmp_path, TINY)
    assert jobs == {
        "crumple": 8,
        "response": 8,
        "cylinder": 1,
        "cube": 1,
        "tables": 1,
        "figure": len(FIGURES),
        "report": 1,
        "study": 1,
    }
    assert not (tmp_path / "results").exists()


def test_bad_config_is_refused_in_one_sentence(tmp_path):
    run = snakemake(tmp_path, changed(sweep={"thickness_um": [-250, 500]}), "-j1")
    assert run.returncode != 0
    said = [line for line in run.stderr.splitlines() if not line.startswith("Using ")]
    assert len(said) == 1 and "sweep.thickness_um[0]" in said[0]
    assert not (tmp_path / "results").exists()


def test_unwritable_results_are_refused_in_one_sentence(tmp_path):
    (tmp_path / "results").write_text("a file where the folder should be")
    run = snakemake(tmp_path, TINY, "-j1")
    assert run.returncode != 0
    said = [line for line in run.stderr.splitlines() if not line.startswith("Using ")]
    assert len(said) == 1 and "results/tiny: cannot be written" in said[0]


def test_numbers_of_several_files_and_of_words_follow_yaml_1_2(tmp_path):
    (tmp_path / "other.yaml").write_text("sweep: {thickness_um: [0250], realisations: 010}\n")
    first, *rest = command(tmp_path, TINY, "--dry-run")
    done = run(
        [first, *rest[:-1], str(tmp_path / "other.yaml"), rest[-1]]
        + ["--config", "sweep={reference_height_mm: [0150]}"]
    )
    assert "10 crumple" in done.stdout, done.stderr
    assert "results/tiny/realisations/t250um/h150mm/9/crumple.nc" in done.stdout


@pytest.mark.parametrize("place", ["results", "results/tiny"])
def test_a_link_that_leads_nowhere_is_named(tmp_path, place):
    (tmp_path / place).parent.mkdir(exist_ok=True)
    (tmp_path / place).symlink_to("/nowhere/at/all")
    run = snakemake(tmp_path, TINY, "--dry-run")
    assert run.returncode != 0
    assert f"({place} is a link to /nowhere/at/all, which is not there)" in run.stdout


def test_a_home_without_a_place_for_caches_is_no_obstacle(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", "/dev/null")
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    # imports too look for such a place
    words = command(tmp_path, TINY, "--dry-run")
    run = subprocess.run(words, capture_output=True, text=True, cwd=ROOT, check=False)
    assert run.returncode == 0 and "8 crumple" in run.stdout, run.stderr


WILD = "{x} {wildcards.y} {{ $HOME `ls` \"q\" 's' \\ % <b>&amp;\n\u591a\U0001f642 {"


def test_texts_and_paths_may_hold_anything(tmp_path):
    """Snakemake takes what stands in braces for a wildcard, a shell what follows a dollar."""
    folder = tmp_path / "{a} $b 'c\" \u00e9"
    folder.mkdir()
    study = changed(report={"title": WILD}, material={"name": WILD, **FEP})
    assert plan(folder, study)["report"] == 1


@pytest.mark.slow
def test_wild_texts_reach_the_report(tmp_path):
    study = changed(
        report={"title": WILD},
        material={"name": WILD, **FEP},
        sweep={"realisations": 1, "thickness_um": [500]},
        export={"formats": list(FORMATS)},
    )
    run = snakemake(tmp_path, study, "-j2")
    assert run.returncode == 0, run.stderr
    page = (tmp_path / "results/tiny/report.html").read_text(encoding="utf-8")
    assert str(markupsafe.escape(WILD)) in page
    assert snakemake(tmp_path, study, "--report", "all.html").returncode == 0
    assert plan(tmp_path, study) == {}


@pytest.mark.slow
def test_an_interrupted_study_says_how_to_go_on_and_does(tmp_path):
    process = subprocess.Popen(
        command(tmp_path, TINY, "-j2"),
        cwd=ROOT,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=heed_interrupts,
    )
    for line in process.stderr:
        if line.startswith("[") and ": crumple " in line:  # the first job may be the cylinder's
            break
    os.killpg(process.pid, signal.SIGINT)
    said = [line for line in process.stderr if not line.startswith("[")]
    assert said == ["Stopped; the same command goes on where it stopped.\n"]
    assert process.wait() == 1
    assert 0 < plan(tmp_path, TINY)["crumple"] < 8


def test_finished_study_has_nothing_to_do(finished):
    assert plan(finished, SECTIONS) == {}


def test_title_leaves_all_physics_alone(finished):
    jobs = plan(finished, sections_with(report={"title": "Another title"}))
    assert (jobs["cube"], jobs["tables"], jobs["report"]) == (1, 1, 1)
    assert not {"crumple", "response", "cylinder", "export"} & set(jobs)


def test_a_measurement_makes_the_page_alone_again(finished):
    (finished / "run{1}.csv").write_text("frequency (Hz),real (N/m),imag (N/m)\n1,2,3\n2,3,4\n")
    run = {"file": "run{1}.csv", "height_mm": 143}
    assert plan(finished, sections_with(report={"measured": [run]})) == {"report": 1, "study": 1}
    said = snakemake(
        finished, sections_with(report={"measured": [run | {"file": "ran.csv"}]}), "-n"
    )
    assert said.returncode and "report.measured[0].file: ran.csv: there is no such" in said.stdout


def test_new_thickness_leaves_finished_realisations_alone(finished):
    jobs = plan(finished, sections_with(sweep={"thickness_um": [500, 130]}))
    assert (jobs["crumple"], jobs["response"], jobs["cube"]) == (4, 4, 1)


def test_dynamics_leaves_crumples_alone(finished):
    jobs = plan(finished, sections_with(dynamics={"frequencies": 5}))
    assert jobs["response"] == 4
    assert "crumple" not in jobs


def test_imperfection_crumples_all_again(finished):
    jobs = plan(finished, sections_with(imperfection={"amplitude_um": 20}))
    assert (jobs["crumple"], jobs["response"], jobs["export"]) == (4, 4, 4)
    assert "cylinder" not in jobs


def test_another_material_is_told_and_crumpled_whatever_the_dates(finished):
    """As in a clone or a copy, where every file may have any date."""
    for path in finished.rglob("*"):
        os.utime(path)
    config = sections_with(material={"name": "PET"})
    run = snakemake(finished, config, "--dry-run")
    said = 'small: 6 files, each was made for another task (material.name "FEP", not "PET", and'
    assert said in run.stdout + run.stderr
    jobs = plan(finished, config)
    assert (jobs["crumple"], jobs["response"], jobs["cylinder"], jobs["cube"]) == (4, 4, 1, 1)


def test_a_cube_without_its_records_stops_nobody(finished):
    """As a clone brings it along."""
    shutil.rmtree(finished / "results/small/realisations")
    jobs = plan(finished, SECTIONS)
    assert (jobs["crumple"], jobs["response"], jobs["cube"], jobs["report"]) == (4, 4, 1, 1)


def test_a_spoilt_record_is_repaired_by_the_same_command(finished):
    record = finished / "results/small/realisations/t500um/h143mm/0/crumple.nc"
    whole = record.read_bytes()
    record.write_bytes(whole[:1000])
    target = str(record.relative_to(finished))
    run = snakemake(finished, SECTIONS, "-j1", target)
    assert run.returncode == 0, run.stderr
    assert "small: crumple.nc cannot be read as a record" in run.stdout + run.stderr
    # a run begins with what it chose, and why, and with what it costs
    lines = (
        r"^Accuracy standard, overruled by .*\n  500 um: .*\n  mesh.element_size_mm .*\n"
        r"  The ramp hurries .*\n  about .*$"
    )
    told = re.search(lines, run.stderr, re.M)
    assert "elements of 18 mm (as given), 100 steps of ramp" in told[0]
    assert told[0].endswith("of processor time for the whole study")
    values, _ = read_record(record)
    record.write_bytes(whole)
    before, _ = read_record(record)
    np.testing.assert_array_equal(values["control_points"], before["control_points"])


def assert_same_cube(first, second):
    """The cubes of two folders agree to the last bit, but for what the runs cost."""
    with (
        xr.open_dataset(first / "results/tiny/cube.nc") as one,
        xr.open_dataset(second / "results/tiny/cube.nc") as two,
    ):
        attributes = [
            {name: value for name, value in cube.attrs.items() if name not in OCCASION}
            for cube in (one, two)
        ]
        assert attributes[0] == attributes[1]
        xr.testing.assert_equal(one.drop_vars(COSTS), two.drop_vars(COSTS))


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """Folder of the tiny study, run on two cores without a break."""
    folder = tmp_path_factory.mktemp("undisturbed")
    run = snakemake(folder, TINY, "-j2")
    assert run.returncode == 0, run.stderr
    return folder


@pytest.mark.slow
def test_the_tiny_study_is_the_same_to_the_last_bit(undisturbed):
    """As it was before the code was rearranged, see `frozen`."""
    kept = frozen.read("tiny")
    if kept["processor"] != frozen.processor():
        pytest.skip("its last bits belong to the processor it ran on")
    with xr.open_dataset(undisturbed / "results/tiny/cube.nc") as cube:
        values = {name: v.values for name, v in cube.data_vars.items() if v.dtype.kind == "f"}
        status = ", ".join(cube.status.values.ravel())
    now, record = frozen.frozen(values, {"status": status}), kept["records"]["cube"]
    assert now["status"] == record["status"]
    assert {name: now["values"][name] for name in record["values"]} == record["values"]


@pytest.mark.slow
def test_cores_do_not_change_the_cube(undisturbed, tmp_path):
    run = snakemake(tmp_path, TINY, "-j1")
    assert run.returncode == 0, run.stderr
    assert_same_cube(undisturbed, tmp_path)


@pytest.mark.slow
def test_killed_study_resumes_to_the_same_cube(undisturbed, tmp_path):
    process = subprocess.Popen(
        command(tmp_path, TINY, "-j2"),
        cwd=ROOT,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=heed_interrupts,
    )
    finished = 0
    while finished < 5:
        line = process.stderr.readline()
        assert line, "the study ended before it could be killed"
        finished += line.startswith("[")
    os.killpg(process.pid, signal.SIGKILL)
    process.stderr.close()
    process.wait()
    # Time for the kernel to end the jobs of the killed session too.
    time.sleep(0.5)
    before = modification_times(tmp_path)

    run = snakemake(tmp_path, TINY, "-j2")
    assert run.returncode == 0, run.stderr
    after = modification_times(tmp_path)
    remade = {path for path, when in before.items() if after[path] != when}
    # Only what the two running jobs had in hand when they were killed.
    assert len(before) >= 3 and len(remade) <= 2
    assert_same_cube(undisturbed, tmp_path)


def modification_times(folder):
    return {path: path.stat().st_mtime_ns for path in folder.glob("results/tiny/**/*.nc")}
