"""The command `foilstudy`: what it says, what it refuses and with which exit code."""

import importlib
import os
import re
import subprocess
import sys
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import yaml
from runs import run
from synthetic import make_cube, write_cube
from test_workflow import TINY, changed, plan

from foilstudy.base.cube import open_cube
from foilstudy.command import main
from foilstudy.config import load_config, load_merged
from foilstudy.export.formats import FORMATS
from foilstudy.study.sweep.crumple import crumple_job
from foilstudy.study.sweep.expected import MEMORY_SPREAD, SPREAD, expected

ROOT = Path(__file__).parents[1]


def spoken(capsys, *words):
    """What the command prints."""
    main([str(word) for word in words])
    return capsys.readouterr().out


def refusal(*words):
    """What the command is ended with, on stderr with exit code 1."""
    with pytest.raises(SystemExit) as ended:
        main([str(word) for word in words])
    return ended.value.code


def process(*words, folder=ROOT):
    return subprocess.run(
        [sys.executable, "-m", "foilstudy", *map(str, words)],
        capture_output=True,
        text=True,
        cwd=folder,
        check=False,
    )


# --- the command itself --------------------------------------------------------------------------


def test_version_is_that_of_the_package(capsys):
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    assert spoken(capsys, "--version").strip() == re.search(r'^version = "(.*)"', project, re.M)[1]


def test_help_lists_every_command_with_its_purpose(capsys):
    text = " ".join(spoken(capsys, "--help").replace("│", " ").split())
    for name, purpose in {
        "check": "Say what a configuration means",
        "run": "Run a study, or go on",
        "export": "Write one realisation of a finished study",
        "report": "Draw tables, figures and page",
    }.items():
        assert f"{name} {purpose}" in text


def test_help_shows_the_one_call_in_python(capsys):
    text = spoken(capsys, "--help")
    lines = [line.strip() for line in text.splitlines()]
    code = lines[lines.index("from foilstudy import Foil, crumple") :]
    space = {}
    # a foil so thick that a coarse mesh resolves it
    exec("\n".join(code).replace("print", "result = ").replace("500e-6", "4e-3"), space)
    assert space["result"].shape == (2,) and (space["result"] > 1e3).all()


def test_help_of_export_names_every_format(capsys):
    text = spoken(capsys, "export", "--help")
    assert all(re.search(rf"\b{name}\b", text) for name in [*FORMATS, "all"])


def test_import_loads_nothing_heavy():
    code = (
        "import sys, foilstudy.command; "
        "print([m for m in ('numba', 'numpy', 'matplotlib', 'snakemake') if m in sys.modules])"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


def test_check_loads_no_solver():
    code = (
        "import sys; from foilstudy.command import main; main(['check', 'config/thesis.yaml']); "
        "print([m for m in ('numba', 'scipy', 'netCDF4', 'xarray') if m in sys.modules])"
    )
    command = [sys.executable, "-c", code]
    run = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT)
    assert run.stdout.splitlines()[-1] == "[]"


@pytest.mark.parametrize("words", [["chek"], ["check"], ["check", "x.yaml", "--cores", "0"]])
def test_wrong_usage_is_an_error_without_traceback(words):
    run = process(*words)
    assert run.returncode not in (0, None) and "Traceback" not in run.stderr
    assert run.stderr.strip()


def test_a_fault_of_the_package_keeps_its_traceback(tmp_path, monkeypatch):
    """NumPy, pandas and xarray raise ValueError too: one sentence of it would hide where."""
    write_cube(make_cube(seeds=2), tmp_path / "cube.nc")
    module = importlib.import_module("foilstudy.present.redraw")
    monkeypatch.setattr(module, "write_tables", lambda *_: np.zeros(2).reshape(3))
    with pytest.raises(ValueError, match="cannot reshape"):
        main(["report", str(tmp_path)])


# --- check ---------------------------------------------------------------------------------------


def test_check_of_the_default_study_says_what_will_be_computed(capsys):
    """pi 200 mm / 4.56 mm is 137.8, so 140 elements around; 135 and 200 mm are 30 and 44 along."""
    text = spoken(capsys, "check", ROOT / "config/config.yaml")
    assert "results/default" in text
    assert f"{140 * 30} to {140 * 44}" in text and f"{4 * 140 * 30} to {4 * 140 * 44}" in text
    assert "3.85, 15.4, 53.8 %" in text
    assert "18 realisations make 36 jobs (crumple, response for each)" in text
    assert "4000 to 8000 steps of ramp, at most 14000 after it" in text
    for thickness in ("500 um", "700 um", "1000 um"):
        assert thickness in text


def test_check_of_the_published_study_says_what_will_be_computed(capsys):
    text = spoken(capsys, "check", ROOT / "config/thesis.yaml", "--cores", 8)
    assert "120 realisations make 240 jobs" in text
    assert f"{16 * 126 * 27} to {16 * 126 * 50}" in text and "refined twice" in text
    assert "8 free cores" in text


def test_check_says_what_the_accuracy_decided_and_what_overrules_it(tmp_path, capsys):
    config = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
    path = tmp_path / "quick.yaml"
    words = {"accuracy": "quick", "relaxation": {"ramp_steps": 1500}}
    path.write_text(yaml.safe_dump(config | words), encoding="utf-8")
    text = spoken(capsys, "check", path)
    assert "accuracy   quick, overruled by relaxation.ramp_steps: 1500\n" in text
    assert text.count("25 % energy error") == 3
    assert "1500 steps of ramp" in text and "rational_krylov to 0.01," in text
    text = spoken(capsys, "check", ROOT / "config/tiny.yaml")
    assert "standard, overruled by mesh.element_size_mm: 12, relaxation.ramp_steps: 400" in text
    assert text.count("12 mm  as given") == 2


def test_check_says_that_contacts_rub(tmp_path, capsys):
    path = tmp_path / "study.yaml"
    path.write_text(yaml.safe_dump(changed(contact={"kind": "barrier", "friction": 0.3})))
    assert "between parts of the foil, friction of 0.3\n" in spoken(capsys, "check", path)


def test_check_says_which_small_motions_are_asked_for(tmp_path, capsys):
    path = tmp_path / "study.yaml"
    asked = {"stiffness": {"one_sided": ["axial"]}, "dynamics": {"contacts": ["normal", "stuck"]}}
    path.write_text(yaml.safe_dump(changed(contact={"kind": "barrier"}, **asked)))
    text = spoken(capsys, "check", path)
    assert "; loading and unloading axially\n" in text
    assert "; closed contacts normal, stuck, too\n" in text


def test_check_looks_for_measurements_where_a_run_does(tmp_path, monkeypatch):
    path = tmp_path / "study.yaml"
    runs = [{"file": "no-such-run.csv", "thickness_um": 500, "height_mm": 170}]
    path.write_text(yaml.safe_dump(changed(report={"measured": runs})))
    (tmp_path / "no-such-run.csv").write_text(
        "frequency (Hz),real (N/m),imag (N/m)\n1,2,3\n2,3,4\n"
    )
    monkeypatch.chdir(tmp_path)
    assert f"{ROOT / 'no-such-run.csv'}: there is no such file" in refusal("check", path)
    (tmp_path / "Snakefile").touch()
    main(["check", str(path)])


def test_check_counts_the_jobs_that_snakemake_plans(tmp_path):
    study = changed(export={"formats": ["npz"]}, stiffness={"relaxed_refinements": 1})
    for config in (TINY, study):
        jobs = plan(tmp_path, config)
        planned = sum(jobs.get(rule, 0) for rule in ("crumple", "response", "refine", "export"))
        assert expected(load_config(config)).jobs == planned


def test_expected_elements_are_those_of_a_crumple(tmp_path):
    """54 elements around, as 53 is prime, and 12 along: 150 mm / 12 mm, rounded to even."""
    study = load_config(TINY)
    cell = study.cell("t500um", "h150mm", 0)
    task = study.crumple_task(cell)
    task = task.model_copy(
        update={"relaxation": task.relaxation.model_copy(update={"relaxation_steps_max": 0})}
    )
    crumple_job(task, tmp_path / "crumple.nc")
    with netCDF4.Dataset(tmp_path / "crumple.nc") as file:
        rows, columns = (file.dimensions[name].size for name in ("node_row", "node_column"))
    asked = next(c for c in expected(study).configurations if c.reference_height_mm == 150)
    assert asked.elements[0] == (rows - 1) * columns == 54 * 12


def test_auto_mesh_is_resolved_for_each_thickness(tmp_path, capsys):
    config = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
    config["mesh"] = {"element_size_mm": "auto"}
    path = tmp_path / "auto.yaml"
    path.write_text(yaml.safe_dump(config), encoding="utf-8")
    text = spoken(capsys, "check", path)
    study = load_config(path)
    sizes = [study.mesh_of(thickness).element_size_mm for thickness in study.thicknesses_um]
    assert all(f"{size:g} mm" in text for size in sizes) and len(set(sizes)) == 3
    assert "corner elements for 10 % of energy error" in text


def test_check_says_every_problem_in_a_sentence(tmp_path):
    path = tmp_path / "bad.yaml"
    path.write_text("sweep:\n  thickness_um: [-1]\n  heights: [150]\n", encoding="utf-8")
    said = refusal("check", path).splitlines()
    assert len(said) == 2 and all(line.startswith(f"{path}: sweep.") for line in said)
    assert process("check", path).returncode == 1
    assert process("check", path).stderr.splitlines() == said


@pytest.mark.parametrize("command", ["check", "run"])
def test_missing_or_unreadable_file_is_one_sentence(tmp_path, command):
    assert refusal(command, tmp_path / "none.yaml").endswith(
        "there is no such file; check the path."
    )
    assert "this is a folder" in refusal(command, tmp_path)
    (tmp_path / "binary.yaml").write_bytes(b"\x89HDF\x00")
    assert "not a text file" in refusal(command, tmp_path / "binary.yaml")


# --- expected cost -------------------------------------------------------------------------------


def test_expected_time_of_the_default_study_is_that_of_a_run():
    """Its 36 jobs took 247 s on two processors, all of it 148 s; largest job 1551 MB.

    Each shape was refined once.
    """
    cost = expected(load_merged([ROOT / "config/config.yaml"], ["stiffness={refinements: 1}"]))
    assert 247 / 2 < cost.realisation_seconds < 247 * 2
    assert 148 / 2 < cost.wall_seconds(2) < 148 * 2
    assert cost.peak_memory_mb == pytest.approx(1551, rel=0.4)


def test_expected_time_of_the_published_study_is_within_the_stated_factor():
    cube = open_cube(ROOT / "results/thesis/cube.nc")
    cost = expected(load_config(yaml.safe_load(cube.attrs["config"])))
    shape = (cube.sizes["thickness"], cube.sizes["overlength"], 1)
    seconds = np.reshape([each.seconds for each in cost.configurations], shape)
    measured = sum(cube[f"seconds_{name}"].values for name in ("crumple", "static", "dynamic"))
    beyond = np.abs(np.log(measured / seconds)) > np.log(SPREAD)
    assert beyond.mean() < 0.1
    memory = np.reshape([each.peak_memory_mb for each in cost.configurations], shape)
    assert (np.abs(np.log(cube.peak_memory.values / memory)) < np.log(MEMORY_SPREAD)).all()


def test_expected_cost_grows_with_what_is_asked_for():
    def cost(**sections):
        return expected(load_config(changed(**sections)))

    plain = cost()
    assert cost(sweep={"realisations": 6}).realisation_seconds == pytest.approx(
        3 * plain.realisation_seconds
    )
    finer = cost(mesh={"element_size_mm": 6}, relaxation={"ramp_steps": 4000})
    for dearer in (
        finer,
        cost(stiffness={"refinements": 2}),
        cost(stiffness={"relaxed_refinements": 1}),
        cost(export={"formats": ["mat"]}),
        cost(dynamics={"shown_max_hz": 800}),
    ):
        assert dearer.realisation_seconds > plain.realisation_seconds
    assert plain.wall_seconds(1) > plain.wall_seconds(2) > plain.wall_seconds(8)
    assert plain.wall_seconds(8) == plain.wall_seconds(100)
    assert plain.total_memory_mb(4) == 4 * plain.peak_memory_mb


# --- run -----------------------------------------------------------------------------------------


def test_run_hands_over_to_snakemake(tmp_path, monkeypatch):
    """From another folder, with options of Snakemake; Snakemake's exit code is the command's."""
    path = tmp_path / "study.yaml"
    path.write_text(yaml.safe_dump(changed(study={"name": "of-the-test"})), encoding="utf-8")
    done = process("run", "study.yaml", "--cores", 3, "--dry-run", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "results/of-the-test" in done.stdout and "8 crumple" in done.stdout
    assert not (ROOT / "results/of-the-test").exists()

    def hand_over(file, words):
        handed.append([str(file), *words[1:]])
        sys.exit(0)

    handed = []
    monkeypatch.setattr(os, "execv", hand_over)
    monkeypatch.chdir(tmp_path)
    for words in (["verify", "--dry-run"], ["--no-such-option"]):
        with pytest.raises(SystemExit):
            main(["run", str(path), *words])
    verified, refused = map(run, handed)
    assert verified.returncode == 0 and "verify_present" in verified.stdout
    assert refused.returncode == 2 and "--no-such-option" in refused.stderr


def test_run_needs_a_snakefile(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    module = sys.modules["foilstudy.command.run"]
    monkeypatch.setattr(module, "__file__", str(tmp_path / "src/foilstudy/command/run.py"))
    assert "no Snakefile here" in refusal("run", ROOT / "config/tiny.yaml")


# --- report --------------------------------------------------------------------------------------


def test_report_without_a_cube_is_one_sentence(tmp_path):
    assert str(tmp_path / "cube.nc") in refusal("report", tmp_path)
    (tmp_path / "cube.nc").write_text("no NetCDF")
    assert "is not a NetCDF file that can be read" in refusal("report", tmp_path)
