"""Results that cannot be stale: every way we know to mix or spoil them is noticed."""

import json
import os
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import netCDF4
import numpy as np
import pytest
from small_study import compute, sections_with

from foilstudy.base.errors import Refusal
from foilstudy.base.fingerprint import Code
from foilstudy.base.origin import Origin
from foilstudy.base.record import read_record
from foilstudy.config import load_config
from foilstudy.present.files import StudyFiles
from foilstudy.present.redraw import redraw
from foilstudy.present.report.page import _other_physics
from foilstudy.present.shown import shown
from foilstudy.study.stale import sentences
from foilstudy.study.sweep import origins
from foilstudy.study.sweep.crumple import crumple_job
from foilstudy.study.sweep.cube import gather
from foilstudy.study.sweep.export import contents_of, recorded_task
from foilstudy.study.sweep.relax_refined import refine_job
from foilstudy.study.sweep.respond import respond_job
from foilstudy.study.sweep.stale import stale_results

FIRST = Path("realisations/t500um/h143mm/0")


def study_with(**changes):
    return load_config(sections_with(**changes))


STUDY = study_with()


@pytest.fixture(scope="module")
def computed(tmp_path_factory):
    return compute(tmp_path_factory.mktemp("study"))


@pytest.fixture
def results(computed, tmp_path):
    return Path(shutil.copytree(computed, tmp_path / "results"))


def stale(results, study=STUDY):
    presented = shown(StudyFiles(results / "cube.nc"))
    found = stale_results(study, results, presented)
    return {each.path.relative_to(results).as_posix(): each.reason for each in found}


def crumples(found):
    return {name for name in found if name.endswith("crumple.nc")}


def test_a_whole_study_counts_wherever_it_was_copied(results):
    assert stale(results) == {}
    for path in results.rglob("*"):
        os.utime(path, (0, 0))  # dates say nothing
    assert stale(results) == {}


@pytest.mark.parametrize(
    "sections, word",
    [
        ({"material": {"name": "PET"}}, 'material.name "FEP", not "PET"'),
        ({"material": {"youngs_modulus_mpa": 651.0}}, "material.youngs_modulus_mpa 650.0, not 651"),
        ({"sheet": {"diameter_mm": 201}}, "sheet.diameter_mm 200.0, not 201.0"),
        ({"sheet": {"gap_height_mm": 131}}, "sheet.gap_height_mm 130.0, not 131.0"),
        ({"imperfection": {"amplitude_um": 11}}, "imperfection.amplitude_um 10.0, not 11.0"),
        ({"mesh": {"element_size_mm": 17}}, "mesh.element_size_mm 18.0, not 17.0"),
        ({"relaxation": {"ramp_steps": 101}}, "relaxation.ramp_steps 100, not 101"),
    ],
)
def test_another_crumple_is_no_crumple_of_this_study(results, sections, word):
    found = stale(results, study_with(**sections))
    assert len(crumples(found)) == 4
    assert all(word in found[name] for name in crumples(found))
    assert {"cube.nc", "report.html", "powerlaw.csv"} <= found.keys()


@pytest.mark.parametrize(
    "sections",
    [
        {"dynamics": {"shown_max_hz": 60}},
        {"dynamics": {"damping_percent": 4.0}},
        {"stiffness": {"refinements": 1}},
    ],
)
def test_another_band_or_refinement_keeps_the_crumples(results, sections):
    found = stale(results, study_with(**sections))
    assert not crumples(found)
    assert sum(name.endswith("response.nc") for name in found) == 4
    assert "cube.nc" in found


def test_a_title_makes_the_cube_and_its_page_again_but_no_physics(results):
    found = stale(results, study_with(report={"title": "Another"}))
    assert not any(name.startswith(("realisations", "cylinder")) for name in found)
    assert 'report.title "Stiffness of crumpled foil", not "Another"' in found["cube.nc"]


def test_a_longer_or_a_shorter_sweep_keeps_what_it_shares(results):
    found = stale(results, study_with(sweep={"realisations": 3}))
    assert not any(name.startswith("realisations") for name in found) and "cube.nc" in found
    found = stale(results, study_with(sweep={"realisations": 1}))
    assert not any(name.startswith("realisations") for name in found) and "cube.nc" in found


def test_other_formats_make_the_exports_again(results):
    found = stale(results, study_with(export={"formats": ["npz", "vtu"]}))
    assert sum(name.endswith("export") for name in found) == 4
    assert not crumples(found)
    (results / FIRST / "export" / "crumple.npz").unlink(missing_ok=True)
    for path in (results / FIRST / "export").iterdir():
        if path.suffix == ".npz":
            path.unlink()
    assert stale(results)[f"{FIRST}/export"] == "is not complete"


@pytest.mark.parametrize(
    "other, word",
    [
        ("t500um/h143mm/1", "seed 1, not 0"),
        ("t500um/h150mm/0", "reference_height_mm 150.0, not 143"),
    ],
)
@pytest.mark.parametrize("name", ["crumple.nc", "response.nc"])
def test_a_record_in_the_place_of_another_is_noticed(results, other, word, name):
    shutil.copy(results / "realisations" / other / name, results / FIRST / name)
    assert word in stale(results)[f"{FIRST}/{name}"]
    with pytest.raises(Refusal, match=f"{name}: was made for another task .* run the study again"):
        gather(STUDY, results, results / "other.nc")
    assert not (results / "other.nc").exists()


def test_both_records_of_another_cell_are_noticed_too(results):
    shutil.rmtree(results / FIRST)
    shutil.copytree(results / "realisations/t500um/h150mm/1", results / FIRST)
    assert f"{FIRST}/crumple.nc" in stale(results)


def truncate(path):
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def empty(path):
    path.write_bytes(b"")


def foreign(path):
    with netCDF4.Dataset(path, "w") as file:
        file.title = "weather"


def no_netcdf(path):
    path.write_text("a text")


def half_copied(path):
    content = path.read_bytes()
    path.write_bytes(content[: len(content) // 2] + bytes(len(content) - len(content) // 2))


def altered(path):
    with netCDF4.Dataset(path, "a") as file:
        name = "radial_displacement" if "crumple" in path.name else "static_stiffness"
        file[name][...] = 2 * file[name][...]


SPOILT = [truncate, empty, foreign, no_netcdf, half_copied, altered]


@pytest.mark.parametrize("spoil", SPOILT)
@pytest.mark.parametrize("name", ["crumple.nc", "response.nc"])
def test_a_spoilt_record_is_named_and_made_again_and_no_outcome(results, spoil, name):
    path = results / FIRST / name
    spoil(path)
    found = stale(results)
    assert f"{FIRST}/{name}" in found and "cube.nc" in found
    with pytest.raises(Refusal, match=f"{name}: .*; run the study again, which makes it anew"):
        gather(STUDY, results, results / "other.nc")
    if name == "crumple.nc":
        cell = STUDY.cells()[0]
        response = (results / FIRST / "response.nc").read_bytes()
        for job, task in (
            (respond_job, STUDY.response_task(cell)),
            (refine_job, STUDY.response_task(cell)),
        ):
            with pytest.raises(Refusal, match="crumple.nc"):
                job(task, path, results / FIRST / "response.nc")
        assert (results / FIRST / "response.nc").read_bytes() == response


def test_altered_words_of_a_record_are_noticed_like_its_values(results):
    """The foil by which a response would go on, not only what stands in the arrays."""
    with netCDF4.Dataset(results / FIRST / "crumple.nc", "a") as file:
        file.foil = file.foil.replace("0.0005", "0.0009")
    assert stale(results)[f"{FIRST}/crumple.nc"] == "holds other values than were written"


def test_an_altered_cube_is_gathered_again_and_not_shown(results):
    with netCDF4.Dataset(results / "cube.nc", "a") as file:
        file["static_stiffness"][0] = 2 * file["static_stiffness"][0]
    assert stale(results)["cube.nc"] == "holds other values than were written"
    with pytest.raises(Refusal, match="cube.nc: holds other values than were written; run"):
        redraw(results)


@pytest.mark.parametrize("name", ["crumple.nc", "cube.nc"])
def test_damage_anywhere_in_a_file_is_a_refusal(results, name):
    """Reading a damaged file ends in several kinds of errors, or in other values."""
    path = results / name if name == "cube.nc" else results / FIRST / name
    whole, random = path.read_bytes(), np.random.default_rng(0)
    noticed = 0
    for place in random.integers(0, len(whole) - 8, 24):
        path.write_bytes(whole[:place] + b"\xff" * 8 + whole[place + 8 :])
        noticed += any(key.endswith(name) for key in stale(results))
    assert noticed > 1  # there are places in a file where nothing stands


@pytest.mark.parametrize("spoil", SPOILT[:4])
def test_a_spoilt_cube_is_gathered_again(results, spoil):
    spoil(results / "cube.nc")
    assert "cube.nc" in stale(results)


def test_a_cube_of_other_records_is_gathered_again(results, computed):
    cell = STUDY.cells()[0]
    task = STUDY.crumple_task(cell)
    # the same task, other bits, as from another machine
    values, attributes = read_record(results / FIRST / "crumple.nc")
    from foilstudy.base.record import write_record
    from foilstudy.study.sweep.quantities import quantities

    values["radial_displacement_max"] = np.nextafter(values["radial_displacement_max"], 1)
    kept = ("foil", "mesh", "imperfection", "method", "status", "message", "thickness_um")
    write_record(
        results / FIRST / "crumple.nc",
        quantities(values),
        {name: attributes[name] for name in kept},
        origins.crumple_origin(task),
    )
    found = stale(results)
    assert found[f"{FIRST}/response.nc"] == "was made from other records than those beside it"
    assert "cube.nc" in found and not crumples(found)


def test_a_shipped_cube_is_no_result_of_ones_own(results):
    shutil.rmtree(results / "realisations")
    found = stale(results)
    assert found["cube.nc"] == "was made from other records than those beside it"
    assert found["report.html"] == "was made from another cube"


def test_other_code_makes_again_what_it_decides(results, monkeypatch):
    decided = {
        "CRUMPLE": ("crumple.nc",),
        "RESPONSE": ("response.nc",),
        "CYLINDER": ("cylinder.nc",),
        "CUBE": ("cube.nc",),
        "EXPORT": ("export",),
    }
    for name, made in decided.items():
        with monkeypatch.context() as patch:
            patch.setattr(Code, "fingerprint", _changed(getattr(origins, name)))
            found = stale(results)
        assert {Path(n).name for n, reason in found.items() if "other code" in reason} == set(made)
    shown_again = {".csv", ".png", ".svg", ".html"}
    with monkeypatch.context() as patch:
        patch.setattr(Code, "fingerprint", _changed(origins.PRESENTING))
        assert {Path(name).suffix for name in stale(results)} == shown_again
    monkeypatch.setattr(origins, "fingerprint_of_files", lambda *_: "other")
    assert {Path(name).suffix for name in stale(results)} == shown_again


def _changed(code):
    true = Code.fingerprint
    return lambda self: "other" if replace(self, chosen=()) == code else true(self)


@pytest.mark.parametrize("name", ["energy.png", "report.html", "powerlaw.csv"])
def test_what_is_shown_is_not_to_be_swapped_either(results, name):
    (path,) = results.rglob(name)
    path.write_text("something else")
    assert stale(results) == {path.relative_to(results).as_posix(): "was changed since it was made"}
    (results / "manifest.json").write_text("{")
    assert len(stale(results)) == len(shown(StudyFiles(results / "cube.nc")))


def test_an_export_that_is_no_folder_is_made_again(results):
    shutil.rmtree(results / FIRST / "export")
    (results / FIRST / "export").write_text("no folder")
    assert stale(results) == {f"{FIRST}/export": "is not complete"}


def test_an_edit_during_a_job_does_not_reach_its_record(tmp_path, monkeypatch):
    """The code counts as it was when the job began."""
    task, path = STUDY.crumple_task(STUDY.cells()[0]), tmp_path / "crumple.nc"
    before = origins.crumple_origin(task).code
    true = sys.modules["foilstudy.pipeline.retry"].crumple

    def edited(*arguments):
        monkeypatch.setattr(Code, "fingerprint", lambda code: "edited")
        return true(*arguments)

    monkeypatch.setattr(sys.modules["foilstudy.pipeline.retry"], "crumple", edited)
    crumple_job(task, path)
    assert read_record(path)[1]["code"] == before


def test_an_export_of_mixed_records_is_refused(results):
    folder = results / FIRST
    assert recorded_task(folder).seed == 0
    shutil.copy(results / "realisations/t500um/h143mm/1/response.nc", folder / "response.nc")
    with pytest.raises(Refusal, match=r"crumple.nc: was made for another task \(seed 0, not 1\)"):
        recorded_task(folder)
    with pytest.raises(Refusal, match="material.name"):
        task = study_with(material={"name": "PET"}).response_task(STUDY.cells()[0])
        contents_of(task, folder / "crumple.nc")


def test_the_page_is_drawn_from_the_records_of_its_cube_alone(results):
    assert len(StudyFiles.found(results / "cube.nc").crumple_paths) == 4
    shutil.copy(results / "realisations/t500um/h150mm/1/crumple.nc", results / FIRST / "crumple.nc")
    assert StudyFiles.found(results / "cube.nc").crumple_paths == ()


def test_the_page_says_where_the_code_of_its_cube_is_no_more(results, monkeypatch):
    cube = StudyFiles(results / "cube.nc").cube
    assert _other_physics(cube) == []
    with monkeypatch.context() as patch:
        patch.setattr(Code, "fingerprint", _changed(origins.RESPONSE))
        assert "has changed since this cube was made" in _other_physics(cube)[0]
    assert _other_physics(cube.assign_attrs(config="study: {}")) != []


# --- origins and fingerprints --------------------------------------------------------------------


def test_a_departure_says_first_what_a_user_can_understand():
    made = Origin(json.dumps({"a": {"b": 1}, "c": "x"}), "code", ("r",))
    assert made.departure(made) == ""
    assert made.departure(Origin('{"a": {"b": 2}, "c": "x"}')) == "for another task (a.b 1, not 2)"
    assert made.departure(Origin('{"a": {}, "c": "x"}')) == "for another task (with a.b)"
    assert made.departure(Origin(made.task, "other", ("r",))) == "by other code"
    assert "other records" in made.departure(Origin(made.task, "code", ("s",)))
    assert Origin().departure(Origin("{}", "code")) == "by code that is not recorded"
    assert "for another task" in Origin("no json").departure(made)
    long = Origin(json.dumps({"a": "x" * 10_000}))
    assert len(long.departure(made)) < 300


def test_the_code_of_a_crumple_is_what_crumples():
    modules = origins.CRUMPLE.modules()
    assert {"model.shell.elements.corner_kernel", "solve.equilibrium.settle", "linalg.pardiso",
            "model.imperfections.buckling_modes", "config.scene"} <= set(modules)  # fmt: skip
    measuring = {module for module in modules if module.startswith("measure")}
    assert "measure.verdicts.shape" in measuring  # what is seen in a shape stands in its record
    assert not any(module.startswith(("measure.d", "measure.st")) for module in measuring)
    rooms = {module.partition(".")[0] for module in set(modules) - measuring}
    assert rooms == {"base", "config", "linalg", "model", "solve", "pipeline", "study"}
    responding = set(origins.RESPONSE.modules())
    assert {"measure.dynamics.reductions.rational_krylov", "pipeline.static"} <= responding
    assert not any(m.startswith(("present", "plot", "export")) for m in responding)
    showing = set(origins.PRESENTING.modules())
    assert {"measure.isolation.limits", "study.sweep.expected", "config.model"} <= showing


RUN = """
import json, sys, tempfile
from dataclasses import replace
from pathlib import Path
from foilstudy.base.fingerprint import Code
from foilstudy.study.sweep import origins
from foilstudy.study.sweep.warmup import _smallest
from foilstudy.config import load_config
from foilstudy.study.sweep.crumple import crumple_job
from foilstudy.study.sweep.respond import respond_job
from foilstudy.study.sweep.cylinder import cylinder_bounds
from foilstudy.study.sweep.export import export_realisation
from foilstudy.study.sweep.relax_refined import refine_job
import foilstudy
root = str(Path(foilstudy.__file__).parent) + "/"
study = load_config(_smallest(json.loads(sys.argv[1])))
(cell,) = study.cells()
called, asked, true = set(), [], Code.fingerprint
def asking(code):
    asked.append(code)
    return true(code)
Code.fingerprint = asking
def note(frame, event, argument):
    if event == "call" and frame.f_code.co_filename.startswith(root):
        called.add(frame.f_code.co_filename[len(root):])
def modules(work):
    called.clear()
    sys.setprofile(note)
    work()
    sys.setprofile(None)
    names = (name.removesuffix(".py").removesuffix("/__init__") for name in called)
    return {name.replace("/", ".") for name in names}
with tempfile.TemporaryDirectory() as folder:
    crumple, response, refined, cylinder, export = (
        Path(folder, name) for name in ("c.nc", "r.nc", "f.nc", "y.nc", "export")
    )
    jobs = {
        "CRUMPLE": lambda: crumple_job(study.crumple_task(cell), crumple),
        "RESPONSE": lambda: respond_job(study.response_task(cell), crumple, response),
        "REFINED": lambda: refine_job(study.refine_task(cell), crumple, refined),
        "EXPORT": lambda: export_realisation(
            study.response_task(cell), crumple, export, *study.export.formats
        ),
        "CYLINDER": lambda: cylinder_bounds(study, cylinder),
    }
    for name, job in jobs.items():
        ran = modules(job)
        whole = getattr(origins, name)
        (code,) = {code for code in asked if replace(code, chosen=()) == whole}
        # a cheaper fingerprint of everything would notice all, and notice too much
        assert code.chosen and ran
        print(name, *ran - set(code.modules()))
"""
CHOICES = {
    "default": {"export": {"formats": ["mat"]}},
    "other": {
        "mesh": {"element": "one_point"},
        "imperfection": {"kind": "buckling_modes"},
        "dynamics": {"reduction": "craig_bampton", "damping": "structural"},
        "export": {"formats": ["nc", "csv", "inp", "vtu"]},
    },
}


@pytest.mark.parametrize("choice", CHOICES)
def test_nothing_that_runs_is_left_out_of_the_code(choice):
    """The modules whose functions a job calls, against those whose sources are fingerprinted."""
    sections = {"stiffness": {"refinements": 1, "relaxed_refinements": 1}} | CHOICES[choice]
    command = [sys.executable, "-c", RUN, json.dumps(sections)]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    lines = [line.split() for line in run.stdout.splitlines()]
    found = {words[0]: set(words[1:]) for words in lines if words and words[0] in vars(origins)}
    assert found.keys() == {"CRUMPLE", "RESPONSE", "REFINED", "EXPORT", "CYLINDER"}
    for name, others in found.items():
        # base writes and reads, config checks the task, which is compared by itself
        others = {other for other in others if not other.startswith(("base.", "config"))}
        # nor does it count how config counts steps, which are in the task
        assert others <= {"study.sweep.origins", "study.sweep.quantities", "solve.pace"}, name


def test_few_lines_tell_why_many_files_are_made_again(results):
    found = list(
        stale_results(
            study_with(material={"name": "PET"}),
            results,
            shown(StudyFiles(results / "cube.nc")),
        )
    )
    lines = sentences("results/x", found)
    assert len(lines) <= 6
    assert lines[0].startswith("results/x: 6 files, each was made for another task")
