"""The kernel of the side studies: names, records, costs, and a new study from page to files."""

import csv
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from runs import ROOT, SNAKEMAKE, snakemake
from test_workflow import TINY as SWEEP

from foilstudy.base.costs import Cost, measured
from foilstudy.base.errors import ConfigError, Refusal
from foilstudy.base.tables import csv_text, markdown_table
from foilstudy.study.kernel.files import (
    measure,
    present,
    problems,
    read_record,
    read_records,
    stale_results,
)
from foilstudy.study.kernel.plan import DECIDING, Lazy, Part, Record, Study, case_name
from foilstudy.study.real.settings import ladder
from foilstudy.study.registry import STUDIES, refuse_reserved_name

# --- names ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Case:
    element: str
    thickness_um: int
    size_mm: float = 5.0
    seed: int | None = None
    prestressed: bool = False


def test_names_put_the_unit_behind_the_number_and_leave_out_what_is_not():
    assert case_name(Case("one_point", 50, 1.25)) == "one_point-thickness50um-size1.25mm"
    full = Case("corner", 500, 5.0, 0, True)
    assert case_name(full) == "corner-thickness500um-size5mm-seed0-prestressed"
    assert case_name("as_it_is") == "as_it_is"


@pytest.mark.parametrize("text", ["a/b", "../up", "two words", "", "wild{card}"])
def test_what_makes_no_file_name_is_refused(text):
    with pytest.raises(ValueError, match="makes no file name"):
        case_name(text)


@pytest.mark.parametrize("study", STUDIES.values(), ids=STUDIES)
def test_names_of_every_study_lead_back_to_their_cases(study):
    for part in study.parts:
        assert [part.case(case_name(case)) for case in part.cases] == list(part.cases)
    files = study.records() + study.outputs()
    assert len({file.casefold() for file in files}) == len(files)


@pytest.mark.parametrize("study", STUDIES.values(), ids=STUDIES)
def test_every_function_of_a_study_exists_and_needs_name_earlier_cases(study):
    functions = [*study.tables.values(), *study.figures.values(), study.findings, study.problems]
    for function in functions + [part.measure for part in study.parts]:
        assert callable(function.load() if isinstance(function, Lazy) else function)
    earlier = set()
    for part in study.parts:
        for case in part.by_name:
            assert set(study.needed(part, case)) <= earlier
        earlier |= {part.files(case)[0] for case in part.by_name}


def test_two_cases_of_one_name_are_refused():
    with pytest.raises(ValueError, match="two cases have the same name"):
        Part("part", (Case("corner", 50), Case("corner", 50, 5.0)), len)


def test_an_unknown_case_or_part_is_refused_by_name():
    with pytest.raises(KeyError, match="benchmarks has no case 'flatness-corner' but rigid"):
        STUDIES["verify"].part("benchmarks").case("flatness-corner")
    with pytest.raises(KeyError, match="verify has no part 'records' but benchmarks"):
        STUDIES["verify"].part("records")


def test_the_plans_import_no_numerics():
    heavy = {"numba", "scipy", "matplotlib", "xarray"}
    code = f"import sys, foilstudy.study.registry; print(*{heavy} & set(sys.modules))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == ""


# --- records -------------------------------------------------------------------------------------


FACTOR = 2.0


def double(case):
    block = np.full(4_000_000, FACTOR * case.thickness_um)
    return {"points": block[:6].reshape(2, 3), "mean": block.mean(), "pair": [1.0, np.nan]}


def total(case, shapes):
    found = {f"{c.thickness_um}": float(r.result["points"].sum()) for c, r in shapes.items()}
    return {"case": case, "sums": found}


THIN, THICK = Case("corner", 50), Case("corner", 500)
TINY = Study(
    name="tiny",
    title="a study of nothing",
    parts=(
        Part("shapes", (THIN, THICK), double, arrays=("points",)),
        Part("totals", ("all",), total, needs={"shapes": lambda case: (THIN, THICK)}),
    ),
    tables={
        "means.csv": lambda means: [{"um": um, "mean": mean} for um, mean in means.items()],
        "means.md": lambda means: f"{len(means)} means\n",
    },
    figures={},
    findings=lambda records: {
        case.thickness_um: record.result["mean"] for case, record in records["shapes"].items()
    },
    problems=lambda means: [f"{um} um: {mean:g} is much" for um, mean in means.items() if um > 99],
)


@pytest.fixture
def folder(tmp_path):
    """All records of the tiny study."""
    for part in TINY.parts:
        for case in part.by_name:
            needed = [tmp_path / file for file in TINY.needed(part, case)]
            measure(TINY, part.name, case, tmp_path / part.files(case)[0], needed)
    return tmp_path


def test_records_are_read_as_they_were_measured(folder):
    record = read_record(TINY, folder / "shapes/corner-thickness50um-size5mm.json")
    assert (record.part, record.case) == ("shapes", THIN)
    np.testing.assert_array_equal(record.result["points"], np.full((2, 3), 100.0))
    np.testing.assert_array_equal(record.result["pair"], [1.0, np.nan])
    assert record.result["mean"] == 100.0
    assert (folder / "shapes/corner-thickness50um-size5mm.npz").is_file()


def test_a_part_takes_the_records_it_needs(folder):
    record = read_records(TINY, folder)["totals"]["all"]
    assert record.result == {"case": "all", "sums": {"50": 600.0, "500": 6000.0}}


def test_records_say_where_they_come_from_and_what_they_cost(folder):
    text = (folder / "totals/all.json").read_text()
    for word in ("git_commit", "package_versions", "machine", '"study": "tiny"'):
        assert word in text
    cost = read_records(TINY, folder)["shapes"][THIN].cost
    assert cost.seconds > 0 and cost.peak_memory_mb > 32


def test_tables_and_costs_are_written_of_the_findings(folder):
    present(TINY, folder)
    assert (folder / "means.csv").read_text() == "um,mean\n50,100\n500,1000\n"
    assert (folder / "means.md").read_text() == "2 means\n"
    rows = list(csv.DictReader((folder / "costs.csv").open()))
    assert [row["case"] for row in rows][2] == "all" and len(rows) == 3
    assert float(rows[0]["peak_memory_mb"]) > 32
    assert problems(TINY, folder) == ["500 um: 1000 is much"]


def stale(folder):
    return {
        each.path.relative_to(folder).as_posix(): each.reason
        for each in stale_results(TINY, folder)
    }


THIN_JSON = "shapes/corner-thickness50um-size5mm.json"
THICK_JSON = "shapes/corner-thickness500um-size5mm.json"
SHOWN = {"means.csv", "means.md", "costs.csv"}


def test_a_finished_study_counts(folder):
    assert stale(folder) == {}
    present(TINY, folder)
    assert stale(folder) == {}


@pytest.mark.parametrize(
    "spoil",
    [
        lambda text: text[: len(text) // 2],
        lambda text: "",
        lambda text: "[]",
        lambda text: text.replace('"mean": 100.0', '"mean": 101.0'),
        lambda text: text.replace(r"\"study\": \"tiny\"", r"\"study\": \"other\""),
    ],
)
def test_a_spoilt_record_and_what_is_made_of_it_are_made_again(folder, spoil):
    present(TINY, folder)
    path = folder / THIN_JSON
    path.write_text(spoil(path.read_text()))
    found = stale(folder)
    # the job of the totals follows from its own input
    assert found.keys() - {"totals/all.json"} == {THIN_JSON} | SHOWN
    with pytest.raises(Refusal, match="run the study again, which makes it anew"):
        present(TINY, folder)


def test_the_record_or_the_arrays_of_another_case_are_noticed(folder):
    npz = Path(THIN_JSON).with_suffix(".npz"), Path(THICK_JSON).with_suffix(".npz")
    kept = (folder / npz[0]).read_bytes()
    shutil.copy(folder / npz[1], folder / npz[0])
    assert "other values than were written" in stale(folder)[THIN_JSON]
    (folder / npz[0]).write_bytes(kept)
    assert stale(folder) == {}
    for suffix in (".json", ".npz"):
        source = (folder / THICK_JSON).with_suffix(suffix)
        shutil.copy(source, (folder / THIN_JSON).with_suffix(suffix))
    assert "another task" in stale(folder)[THIN_JSON]


def test_a_record_made_of_others_follows_them(folder, monkeypatch):
    needed = [folder / file for file in TINY.needed(TINY.parts[1], "all")]
    monkeypatch.setattr(sys.modules[__name__], "FACTOR", 3.0)
    measure(TINY, "shapes", THIN_JSON[7:-5], folder / THIN_JSON)
    assert stale(folder) == {"totals/all.json": "was made from other records than those beside it"}
    measure(TINY, "totals", "all", folder / "totals/all.json", needed)
    assert stale(folder) == {}


def test_other_code_of_a_measurement_makes_its_records_again(folder, monkeypatch):
    present(TINY, folder)
    monkeypatch.setattr(Part, "code", property(lambda part: f"other {part.name == 'totals'}"))
    assert stale(folder).keys() == {THIN_JSON, THICK_JSON} | SHOWN
    monkeypatch.undo()
    monkeypatch.setattr(Study, "presenting_code", "other")
    assert stale(folder).keys() == SHOWN
    assert set(stale(folder).values()) == {"was made by other code"}


def test_other_words_make_tables_and_figures_again_and_no_record(folder, monkeypatch):
    present(TINY, folder)
    monkeypatch.setitem(TINY.shown_by, "thin", "of 50 um")
    assert stale(folder).keys() == SHOWN
    assert set(stale(folder).values()) == {"was made for another task (without thin)"}
    present(TINY, folder)
    assert stale(folder) == {}


@pytest.mark.parametrize("name", ["real", "truth"])
def test_words_of_a_model_are_among_what_its_tables_show(name):
    study = STUDIES[name]
    steps = {trial.step for trial in study.part("trials").cases}
    of_studies = {entry.name for entry in ladder(name).studied}
    assert study.shown_by.keys() == steps | of_studies
    assert all(words for words, *_ in study.shown_by.values())


def test_tables_without_records_are_no_result_of_ones_own(folder):
    present(TINY, folder)
    shutil.rmtree(folder / "shapes")
    assert stale(folder).keys() - {"totals/all.json"} == SHOWN


@pytest.mark.parametrize("study", STUDIES.values(), ids=STUDIES)
def test_the_code_of_a_study_is_its_own_and_the_physics(study):
    for part in study.parts:
        modules = set(part.measured_by.modules())
        rooms = {module.partition(".")[0] for module in modules}
        assert {"model", "study"} <= rooms <= {*DECIDING, "config"}
        shown = ("figures", "kernel", "tables")
        assert not any(m.startswith("study.") and m.endswith(shown) for m in modules)
    assert part.code != study.presenting_code


def test_tables_leave_empty_what_is_not_there():
    rows = [{"a": 1.23456789, "b": None, "c": True}, {"a": np.nan, "b": "x, y", "c": 3}]
    assert csv_text(rows) == 'a,b,c\n1.23457,,True\n,"x, y",3\n'
    assert markdown_table(["a", "b"], [[1, "x"]]) == "| a | b |\n|---|---|\n| 1 | x |\n"


# --- costs ---------------------------------------------------------------------------------------


def test_costs_of_nested_blocks_are_apart():
    with measured() as outer:
        with measured() as large:
            block = np.ones(20_000_000)
            del block
        with measured() as small:
            pass
    assert outer.seconds >= large.seconds + small.seconds
    assert outer.cpu_seconds >= large.cpu_seconds > small.cpu_seconds
    assert outer.peak_memory_mb == large.peak_memory_mb > 0
    if sys.platform == "linux":
        assert large.peak_memory_mb > small.peak_memory_mb + 100


def test_costs_of_what_failed_are_known():
    with pytest.raises(RuntimeError), measured() as cost:
        raise RuntimeError
    assert cost.seconds > 0
    assert Record("part", "case", {}, cost).cost != Cost()


# --- workflow ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["elements", "verify", "verification", "Dynamics"])
def test_a_study_may_not_be_named_like_a_side_study(name):
    with pytest.raises(ConfigError, match=f"study.name: '{name}' is the side study"):
        refuse_reserved_name(name)
    refuse_reserved_name("elements_of_mine")


def snakemake_with(packages, folder, *options):
    """Of another package than the one here."""
    command = [SNAKEMAKE, "--snakefile", ROOT / "Snakefile", "--directory", folder]
    command += ["--configfile", ROOT / "config/tiny.yaml", *options]
    environment = os.environ | {"PYTHONPATH": str(packages)}
    return subprocess.run(
        command, capture_output=True, text=True, cwd=ROOT, check=False, env=environment
    )


def test_the_name_is_refused_before_any_job(tmp_path):
    run = snakemake(tmp_path, SWEEP, "-n", "--config", "study={name: elements}")
    assert run.returncode != 0
    assert "study.name: 'elements' is the side study" in run.stdout


def test_workflow_plans_every_case_once(tmp_path):
    run = snakemake(tmp_path, SWEEP, "-n", *STUDIES)
    assert run.returncode == 0, run.stderr
    for study in STUDIES.values():
        for part in study.parts:
            assert f"{len(part.cases)} {study.name}_{part.name}" in run.stdout
        assert f"1 {study.name}_present" in run.stdout
    assert not (tmp_path / "results").exists()


def test_the_study_of_the_page_runs_and_one_run_at_a_time_writes_it(tmp_path):
    """As the page says: one file and one line, on top of the package as it is."""
    page = (ROOT / "docs/studies.md").read_text(encoding="utf-8")
    (module,) = re.findall("```python\n(.*?)```", page, re.DOTALL)
    package = tmp_path / "src/foilstudy"
    (package / "study").mkdir(parents=True)
    for entry in (ROOT / "src/foilstudy").iterdir():
        if entry.name not in ("study", "__pycache__"):
            (package / entry.name).symlink_to(entry)
    for entry in (ROOT / "src/foilstudy/study").iterdir():
        if entry.name not in ("registry.py", "__pycache__"):
            (package / "study" / entry.name).symlink_to(entry)
    (package / "study/plate.py").write_text(module, encoding="utf-8")
    registry = (ROOT / "src/foilstudy/study/registry.py").read_text(encoding="utf-8")
    registry = registry.replace("MODULES = (\n", 'MODULES = (\n    "plate",\n')
    (package / "study/registry.py").write_text(registry, encoding="utf-8")

    # on a file system without locks
    lockless = "import fcntl\n\ndef flock(*_):\n    raise OSError(37, 'No locks available')\n\n"
    (package.parent / "sitecustomize.py").write_text(lockless + "fcntl.flock = flock\n")
    results = tmp_path / "results/plate"
    run = snakemake_with(package.parent, tmp_path, "-j1", "plate")
    assert run.returncode == 0, run.stderr
    assert "results/plate: not locked (No locks available)" in run.stderr
    rows = list(csv.DictReader((results / "plate.csv").open()))
    assert [row["elements_along"] for row in rows] == ["8", "16", "32"] * 2
    errors = np.array([float(row["error"]) for row in rows]).reshape(2, 3)
    # quadratic splines: second order
    np.testing.assert_allclose(np.log2(errors[:, :-1] / errors[:, 1:]), 2, atol=0.2)
    assert (results / "error.png").is_file() and (results / "costs.csv").is_file()
    assert (results / ".lock").is_file() and not (tmp_path / "results/tiny/.lock").exists()

    (package.parent / "sitecustomize.py").unlink()
    with (results / ".lock").open("w") as lock:
        fcntl = pytest.importorskip("fcntl")
        fcntl.flock(lock, fcntl.LOCK_EX)
        again = ("-j1", "plate", "--forcerun", "plate_present")
        run = snakemake_with(package.parent, tmp_path, *again)
        assert run.returncode != 0
        assert "results/plate: another run is writing this study" in run.stderr
        assert snakemake_with(package.parent, tmp_path, *again, "-n").returncode == 0
