"""Realisations that grow in rounds until the means are known as well as wished."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
import yaml
from runs import ROOT, command, heed_interrupts, plan, snakemake
from test_confidence import covered, lognormal, skewed

from foilstudy.base.outcome import NOT_NEEDED
from foilstudy.command import main
from foilstudy.config import ConfigError, load_config
from foilstudy.config.sections import FIRST_ROUND as FIRST
from foilstudy.measure.verdicts import is_fault
from foilstudy.study.sweep.cube import gather
from foilstudy.study.sweep.respond import respond_job
from foilstudy.study.sweep.rounds import (
    Round,
    Standing,
    Wish,
    recorded_values,
    rounds,
    wanted_cells,
)
from foilstudy.study.sweep.stale import stale_results

# --- what a round asks for ------------------------------------------------------------------------


def stiffness(axial, radial=1.0):
    """What a realisation holds, without a mesh limit."""
    nothing = np.full(2, np.nan)
    return {
        "static_stiffness": np.array([axial, radial]),
        "static_stiffness_converged": nothing,
        "static_stiffness_mesh_error": nothing,
    }


def standing_of(values, wish):
    return Standing.of([stiffness(value, value) for value in values], wish)


def test_enough_are_enough():
    standing = standing_of([1.0, 1.1, 0.9, 1.0, 1.05, 0.95], Wish(0.2, 24))
    assert (standing.made, standing.usable, standing.wanted) == (6, 6, 6)
    assert standing.half_width < 0.2 and standing.takes <= 6


def test_the_scatter_says_how_many_more():
    values = 1 + 0.3 * np.array([-1, 1, -1, 1, -1, 1]) * np.sqrt(5 / 6)  # cv of 0.3
    standing = standing_of(values, Wish(0.2, 24))
    assert standing.takes == standing.wanted == 12
    assert standing_of(values, Wish(0.19, 24)).wanted == 12  # 13, but no round more than doubles
    assert standing_of(values, Wish(0.2, 10)).wanted == 10
    assert standing_of(values, Wish(0.2, 6)).wanted == 6
    assert standing_of(values, Wish(0.3, 24)).wanted == 8  # one more seldom is the last one


def test_both_directions_count():
    axial = np.array([1.0, 2.0, 1.0, 2.0, 1.0, 2.0])
    for values in ([stiffness(a, 1) for a in axial], [stiffness(1, r) for r in axial]):
        assert Standing.of(values, Wish(0.2, 24)).wanted > 6


def test_the_mean_that_answers_is_the_one_to_be_known():
    """The mesh limit where an error of it is stated."""
    values = [stiffness(1.0) for _ in range(6)]
    for each, limit in zip(values, [1.0, 2.0, 1.0, 2.0, 1.0, 2.0], strict=True):
        each["static_stiffness_converged"] = np.array([limit, 1.0])
    assert Standing.of(values, Wish(0.2, 24)).wanted == 6
    for each in values:
        each["static_stiffness_mesh_error"] = np.array([0.01, 0.01])
    assert Standing.of(values, Wish(0.2, 24)).wanted > 6


def test_failed_realisations_do_not_count():
    good = [stiffness(v, v) for v in (1.0, 1.2, 0.8, 1.1)]
    with_failures = Standing.of([*good, {}, {}], Wish(0.2, 24))
    assert (with_failures.made, with_failures.usable) == (6, 4)
    assert with_failures.takes > 4
    assert with_failures.wanted - 6 == max(2, with_failures.takes - 4)
    assert Standing.of([{}, {}, {}, {}, {}, stiffness(1)], Wish(0.2, 24)).wanted == 12
    nothing = Standing.of([{}] * 6, Wish(0.2, 24))
    assert (nothing.usable, nothing.wanted) == (0, 6)  # more would hardly do better


SECTIONS = {
    "study": {"name": "rounds"},
    "sweep": {
        "thickness_um": [250, 500],
        "reference_height_mm": [150],
        "realisations": "auto",
        "realisations_max": 8,
    },
    "mesh": {"element_size_mm": 18},
    "relaxation": {"ramp_steps": 100},
    "stiffness": {"refinements": 0},
    "dynamics": {"shown_max_hz": 50, "frequencies": 4, "eigenfrequencies": 2},
    "report": {"confidence_percent": 30},
}


def sections_with(**changes):
    return {name: SECTIONS[name] | changes.get(name, {}) for name in SECTIONS}


def prescribed(cell):
    """Scatter of the thin foil 40 %, of the thick one 5 %."""
    rng = np.random.default_rng([int(cell.thickness_um), cell.seed])
    return stiffness(*lognormal(rng, 0.4 if cell.thickness_um == 250 else 0.05, 2))


def test_every_configuration_takes_what_it_needs():
    study = load_config(sections_with(sweep={"realisations_max": 40}))
    found = list(rounds(study, prescribed))
    assert [each.number for each in found] == list(range(len(found))) and len(found) > 1
    thin, thick = (("t250um", "h150mm"), ("t500um", "h150mm"))
    assert found[-1].wanted[thick] == FIRST < found[-1].wanted[thin] < 40
    assert all(each.half_width <= 0.3 for each in found[-1].standings.values())
    for before, after in zip(found, found[1:], strict=False):
        assert {name: s.made for name, s in after.standings.items()} == before.wanted
    cells = wanted_cells(study, prescribed)
    assert len(cells) == sum(found[-1].wanted.values())
    tighter = load_config(
        sections_with(sweep={"realisations_max": 40}, report={"confidence_percent": 10})
    )
    assert set(cells) < set(wanted_cells(tighter, prescribed))


def test_never_more_than_the_cap():
    study = load_config(sections_with(report={"confidence_percent": 0.1}))
    *_, last = rounds(study, prescribed)
    assert set(last.wanted.values()) == {8}
    study = load_config(sections_with(sweep={"realisations_max": 4}))
    assert len(wanted_cells(study, prescribed)) == 8


def test_a_fixed_number_is_that_number():
    study = load_config(SECTIONS | {"sweep": SECTIONS["sweep"] | FIXED, "report": {}})
    assert wanted_cells(study, None) == study.cells() and len(study.cells()) == 6


FIXED = {"realisations": 3, "realisations_max": None}


def test_a_round_is_read_as_it_was_written(tmp_path):
    first = next(rounds(load_config(SECTIONS), lambda cell: {}))
    second = next(rounds(load_config(SECTIONS), prescribed))
    for each in (first, second):
        (tmp_path / "0.json").write_text(each.text())
        read = Round.read(tmp_path / "0.json")
        assert read.text() == each.text() and read.wanted == each.wanted
        assert read.is_last == each.is_last


@pytest.mark.parametrize("draw", [lognormal, skewed])
@pytest.mark.parametrize("cv", [0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
def test_it_still_does_where_its_own_width_ends_the_rounds(draw, cv):
    """Those that end early are the narrow ones by chance, which costs some coverage."""
    rng, wish = np.random.default_rng(1), Wish(0.2, 24)
    ended = []
    for sample in draw(rng, cv, (1500, wish.most)):
        made, standing = 0, standing_of(sample[:FIRST], wish)
        while standing.wanted > made:
            made = standing.wanted
            standing = standing_of(sample[:made], wish)
        ended.append(sample[: standing.made])
    assert 0.9 < covered(ended) < 0.97


# --- the workflow ---------------------------------------------------------------------------------

RESULTS = Path("results/rounds")
CUBE = str(RESULTS / "cube.nc")
STUDY = load_config(SECTIONS)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A study of two configurations up to its cube."""
    folder = tmp_path_factory.mktemp("made")
    run = snakemake(folder, SECTIONS, "-j2", CUBE)
    assert run.returncode == 0, run.stderr
    return folder


@pytest.fixture
def finished(made, tmp_path):
    return Path(shutil.copytree(made, tmp_path / "copied"))


def counts(folder):
    """Realisations of each configuration in the cube of a folder."""
    with xr.open_dataset(folder / CUBE) as cube:
        return (cube.status != NOT_NEEDED).sum("seed").values.ravel().tolist()


def records(folder):
    found = sorted(folder.glob(f"{RESULTS}/realisations/**/*.nc"))
    return {path.relative_to(folder): path.stat().st_mtime_ns for path in found}


def stale(folder, study=STUDY):
    return {each.path.relative_to(folder / RESULTS).as_posix(): each.reason
            for each in stale_results(study, folder / RESULTS)}  # fmt: skip


def test_the_study_ends_where_the_wish_is_met_or_at_the_cap(made):
    *_, last = rounds(STUDY, lambda cell: recorded_values(STUDY, made / RESULTS, cell))
    assert counts(made) == list(last.wanted.values())
    assert len(records(made)) == 2 * sum(counts(made))  # none made in vain
    for standing in last.standings.values():
        assert standing.half_width <= 0.3 or standing.made == 8
        assert standing.made >= FIRST
    files = sorted((made / RESULTS / "rounds").iterdir())
    assert [path.name for path in files] == [f"{n}.json" for n in range(last.number + 1)]
    assert files[-1].read_text() == last.text()


def test_what_was_not_needed_is_told_apart_from_what_failed(made):
    with xr.open_dataset(made / CUBE) as cube:
        cube = cube.load()
    missing = cube.status == NOT_NEEDED
    assert cube.sizes["seed"] == max(counts(made))
    assert (
        cube.static_stiffness.isnull()
        .all("direction")
        .equals(missing.drop_vars("status", errors="ignore"))
    )
    assert (cube.crumple_digest.where(missing, "") == "").all()
    assert (cube.crumple_digest.where(~missing, "none") != "").all()


def test_the_same_command_again_has_nothing_to_do(finished):
    assert stale(finished) == {}
    run = snakemake(finished, SECTIONS, "--dry-run", CUBE)
    assert "Nothing to be done" in run.stdout
    shutil.rmtree(finished / ".snakemake")  # as in a copy
    run = snakemake(finished, SECTIONS, "--dry-run", CUBE)
    assert "Nothing to be done" in run.stdout
    jobs = plan(finished, SECTIONS)
    assert not {"crumple", "response", "round", "cube", "cylinder"} & jobs.keys()


def test_a_tighter_wish_only_adds_realisations(finished):
    tighter = sections_with(report={"confidence_percent": 1})
    before = records(finished)
    assert not any(
        name.startswith("realisations") for name in stale(finished, load_config(tighter))
    )
    run = snakemake(finished, tighter, "-j2", CUBE)
    assert run.returncode == 0, run.stderr
    after = records(finished)
    assert counts(finished) == [8, 8] and len(after) == 32
    assert {path: after[path] for path in before} == before
    # a looser one afterwards is the study as it was before
    run = snakemake(finished, SECTIONS, "-j2", CUBE)
    assert run.returncode == 0, run.stderr
    assert "crumple" not in run.stderr and records(finished) == after


def test_a_stale_record_of_the_first_round_is_made_again(finished, made):
    place = finished / RESULTS / "realisations/t500um/h150mm"
    shutil.copy(place / "1/response.nc", place / "0/response.nc")
    found = stale(finished)
    assert "seed 1, not 0" in found["realisations/t500um/h150mm/0/response.nc"]
    assert {"rounds/0.json", "cube.nc"} <= found.keys()
    run = snakemake(finished, SECTIONS, "-j2", CUBE)
    assert run.returncode == 0, run.stderr
    assert stale(finished) == {} and counts(finished) == counts(made)


@pytest.mark.parametrize("spoil", ["cut", "other", "wish"])
def test_a_round_that_says_something_else_is_made_again(finished, made, spoil):
    path = finished / RESULTS / "rounds/0.json"
    content = json.loads(path.read_text())
    if spoil == "cut":
        path.write_text(path.read_text()[:100])
    elif spoil == "other":
        content["configurations"][1]["wanted"] = 8
        path.write_text(json.dumps(content))
    else:
        content["wish"]["half_width"] = 0.1
        path.write_text(json.dumps(content))
    assert stale(finished).keys() == {"rounds/0.json"}
    run = snakemake(finished, SECTIONS, "-j2", CUBE)
    assert run.returncode == 0, run.stderr
    assert path.read_text() == (made / RESULTS / "rounds/0.json").read_text()
    assert "crumple" not in run.stderr


def test_a_missing_realisation_is_made_again_alone(finished, made):
    shutil.rmtree(finished / RESULTS / "realisations/t250um/h150mm/0")
    jobs = snakemake(finished, SECTIONS, "--dry-run", CUBE).stdout
    assert "1 crumple, 1 response, 1 round" in jobs
    run = snakemake(finished, SECTIONS, "-j2", CUBE)
    assert run.returncode == 0, run.stderr
    assert counts(finished) == counts(made)


def test_a_failed_realisation_is_flagged_and_another_takes_its_place(finished, monkeypatch):
    """At the cap nothing can; else the rounds ask for as many more."""
    first = STUDY.cells()[0]
    place = finished / RESULTS / "realisations" / first.thickness_id / first.overlength_id / "0"
    module = sys.modules["foilstudy.study.sweep.respond"]

    def explode(*_):
        raise RuntimeError("no factor")

    monkeypatch.setattr(module, "fixed_stiffness", explode)
    respond_job(STUDY.response_task(first), place / "crumple.nc", place / "response.nc")
    monkeypatch.undo()
    assert "rounds/0.json" in stale(finished)
    run = snakemake(finished, SECTIONS, "-j2", CUBE)
    assert run.returncode == 0, run.stderr
    with xr.open_dataset(finished / CUBE) as cube:
        status = cube.status.values[0, 0].tolist()
        faults = sum(map(is_fault, cube.verdict.values[0, 0]))
    assert status[0] == "failed" and status.count("converged") >= 5
    *_, last = rounds(STUDY, lambda cell: recorded_values(STUDY, finished / RESULTS, cell))
    standing = last.standings[first.thickness_id, first.overlength_id]
    assert faults >= 1
    assert (standing.made, standing.usable) == (counts(finished)[0], counts(finished)[0] - faults)
    assert standing.half_width <= 0.3 or standing.made == 8


def test_the_cube_refuses_a_record_that_was_exchanged(finished):
    place = finished / RESULTS / "realisations/t500um/h150mm"
    shutil.copy(place / "1/response.nc", place / "0/response.nc")
    with pytest.raises(ValueError, match="response.nc: was made for another task"):
        gather(STUDY, finished / RESULTS, finished / "other.nc")


def test_exports_follow_the_realisations(finished, made):
    jobs = plan(finished, SECTIONS | {"export": {"formats": ["npz"]}})
    assert jobs["export"] == sum(counts(made)) and "crumple" not in jobs


# --- the configuration ----------------------------------------------------------------------------


def config(sweep=None, **sections):
    grid = {"thickness_um": [500], "reference_height_mm": [150, 170]}
    return load_config({"sweep": grid | (sweep or {})} | sections)


def test_auto_says_what_it_goes_by():
    study = config({"realisations": "auto"})
    assert (study.sweep.realisations_max, study.report.confidence_percent) == (24, 20.0)
    assert len(study.cells()) == 48 and study.seeds == tuple(range(24))
    assert "2 heights x at most 24 realisations" in repr(study)
    assert load_config(yaml.safe_load(study.to_yaml())) == study
    study = config({"realisations": "auto"}, report={"confidence_percent": 5, "title": "x"})
    assert (study.report.confidence_percent, study.report.title) == (5, "x")
    fixed = config({"realisations": 3})
    assert fixed.sweep.realisations_max is None and fixed.report.confidence_percent is None


@pytest.mark.parametrize(
    ("sweep", "sections", "words"),
    [
        ({"realisations": 6, "realisations_max": 9}, {}, "sweep.realisations_max is given, but"),
        ({"realisations_max": 9}, {}, "which settles their number; remove one of them"),
        ({"realisations": "auto", "realisations_max": 1}, {}, "use a value of at least 2"),
        ({"realisations": "automatic"}, {}, "sweep.realisations is the text 'automatic', not a"),
        ({"realisations": "auto"}, {"report": {"confidence_percent": 0}}, "at least 0.1 %"),
        ({"realisations": "auto", "realisations_max": 10_000, "thickness_um": [500, 600]}, {},
         "sweep.realisations_max is 10000, which makes 40000 realisations"),
    ],
)  # fmt: skip
def test_what_auto_cannot_have_is_refused(sweep, sections, words):
    with pytest.raises(ConfigError) as caught:
        config(sweep, **sections)
    assert words in str(caught.value) and "\n" not in str(caught.value)


def test_the_cylinder_does_not_ask_how_many_there_are():
    tasks = {
        config(sweep).cylinder_task() for sweep in ({"realisations": "auto"}, {"realisations": 2})
    }
    assert len(tasks) == 1


def test_check_says_how_many_there_may_be(tmp_path, capsys):
    path = tmp_path / "study.yaml"
    path.write_text(yaml.safe_dump(SECTIONS))
    main(["check", str(path)])
    said = capsys.readouterr().out
    assert "auto, 6 to 8 for each of 2 configurations, until" in said
    assert re.search(r"With 6 realisations of each configuration about .* of processor time", said)
    path.write_text(yaml.safe_dump(SECTIONS | {"sweep": SECTIONS["sweep"] | FIXED, "report": {}}))
    main(["check", str(path)])
    assert "3 for each of 2 configurations" in capsys.readouterr().out


# --- interrupts -----------------------------------------------------------------------------------


@pytest.mark.slow
def test_an_interrupted_round_goes_on_to_the_same_cube(made, tmp_path):
    tight = sections_with(report={"confidence_percent": 1})
    process = subprocess.Popen(
        command(tmp_path, tight, "-j2", CUBE),
        cwd=ROOT,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=heed_interrupts,
    )
    for line in process.stderr:
        if "round 0" in line:
            break
    os.killpg(process.pid, signal.SIGINT)
    try:
        assert process.wait(timeout=120) == 1
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
    before = records(tmp_path)
    assert 24 <= len(before) < 32
    run = snakemake(tmp_path, tight, "-j2", CUBE)
    assert run.returncode == 0, run.stderr
    assert counts(tmp_path) == [8, 8]
    after = records(tmp_path)
    assert {path: after[path] for path in before} == before
    other = Path(shutil.copytree(made, tmp_path / "other"))
    assert snakemake(other, tight, "-j1", CUBE).returncode == 0
    with xr.open_dataset(tmp_path / CUBE) as one, xr.open_dataset(other / CUBE) as two:
        costs = ["seconds_crumple", "seconds_static", "seconds_dynamic", "peak_memory"]
        xr.testing.assert_equal(one.drop_vars(costs), two.drop_vars(costs))
