"""Every Python block of README and docs runs as it stands, and prints what the page says."""

import json
import re
import shlex
import tempfile
from pathlib import Path

import numpy as np
import pytest
import yaml
from pages import ROOT, blocks, pages

from foilstudy.command import app
from foilstudy.config import load_config
from foilstudy.export.contents import Contents
from foilstudy.export.write import write
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.study.sweep.crumple import crumple_job

RECORD = "results/thesis/realisations/t500um/h170mm/0/crumple.nc"
README = (ROOT / "README.md").read_text("utf-8")
NUMBER = re.compile(r"-?\d+\.?\d*(?:e[-+]?\d+)?")


@pytest.fixture(scope="module")
def clone(tmp_path_factory):
    """A clone after its study: the cube of the repository, one realisation, a shape to read."""
    folder = tmp_path_factory.mktemp("clone")
    study = load_config(
        {
            "study": {"name": "thesis"},
            "sweep": {"thickness_um": [500], "reference_height_mm": [170], "realisations": 1},
            "mesh": {"element_size_mm": 12},
        }
    )
    (cell,) = study.cells()
    crumple_job(study.crumple_task(cell), folder / RECORD)
    (folder / "results/thesis/cube.nc").symlink_to(ROOT / "results/thesis/cube.nc")
    shape = Contents.of(Crumpled.recorded(folder / RECORD))
    write(shape, "npz", folder / "scan.npz")
    return folder


RUN = [block for page in pages() for block in blocks(page) if not block.is_module]


def test_every_python_block_is_run_but_the_one_that_is_a_module():
    """Which a test of the kernel of studies runs."""
    found = sum(page.read_text("utf-8").count("```python") for page in pages())
    modules = [str(block) for page in pages() for block in blocks(page) if block.is_module]
    assert len(modules) == 1 and modules[0].startswith("studies.md")
    assert len(RUN) == found - 1 >= 8


@pytest.mark.parametrize("block", RUN, ids=str)
def test_the_python_of_a_page_runs_and_prints_what_the_page_says(block, clone, monkeypatch):
    """Exactly so from the cube; a crumple made here may take another way on another processor."""
    monkeypatch.chdir(clone)
    printed = block.run()
    if block.printed is None:
        return
    if "open_cube" in block.code:
        assert printed == block.printed
        return
    ours, theirs = (NUMBER.sub("#", each).split() for each in (printed, block.printed))
    assert ours == theirs
    ours, theirs = (np.array(NUMBER.findall(x), dtype=float) for x in (printed, block.printed))
    assert (np.abs(np.log(ours / theirs)) < np.log(3)).all()


def test_the_readme_says_what_the_default_study_is_and_took():
    (count,) = re.findall(r"then (\d+) crumples on 2 cores", README)
    assert int(count) == len(load_config(ROOT / "config/config.yaml").cells())
    (took,) = re.findall(r"and (\d+) s for the study \(\[measured\]", README)
    measured = (ROOT / "benchmarks/results.md").read_text("utf-8")
    assert f"| study `default`, two cores | {took} s |" in measured


# --- the notebook --------------------------------------------------------------------------------

NOTEBOOKS = sorted((ROOT / "docs").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_a_notebook_is_kept_without_outputs(path):
    notebook = json.loads(path.read_text("utf-8"))
    cells = notebook["cells"]
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)
    assert path.stat().st_size < 20_000
    assert len({cell["id"] for cell in cells}) == len(cells)
    for cell in cells:
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [] and cell["execution_count"] is None


@pytest.fixture
def run_notebook(monkeypatch):
    """Runs one from its folder and gives its names."""
    import matplotlib.pyplot as plt

    def run(name):
        monkeypatch.chdir(ROOT / "docs")
        space = {"__name__": "notebook"}
        for cell in json.loads(Path(name).read_text("utf-8"))["cells"]:
            if cell["cell_type"] == "code":
                exec(compile("".join(cell["source"]), cell["id"], "exec"), space)
        return space

    yield run
    plt.close("all")


def test_the_bench_notebook_reads_the_truth_from_files(run_notebook, monkeypatch, tmp_path):
    """The bypass and the blocks take off what whole periods and the empty rig bring back."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    space = run_notebook("bench.ipynb")
    value = {name: space["Static"].of(space[name]).value for name in ("published", "clean")}
    assert value["clean"] == pytest.approx(space["truth"], rel=5e-3)
    assert value["published"] < 0.97 * space["truth"] and space["check"].holds


def test_the_notebook_runs_from_its_folder(run_notebook):
    """What it finds is physics: softer at zero element size, and the law of thin shells."""
    space = run_notebook("first-look.ipynb")
    assert space["crumpled"].status == "converged"
    assert (space["limit"].stiffness < space["crumpled"].stiffness()).all()
    alpha, beta, gamma = space["law"]
    assert -1.5 < beta < -0.5 and 1.5 < gamma < 2.5
    assert space["r2"] > 0.95


# --- configurations and commands -----------------------------------------------------------------


def other_blocks(language):
    """Texts of the blocks of a language, with their page."""
    pattern = re.compile(rf"^```{language}\n(.*?)^```$", re.DOTALL | re.MULTILINE)
    return [(page.name, text) for page in pages() for text in pattern.findall(page.read_text())]


@pytest.mark.parametrize(("page", "text"), other_blocks("yaml"))
def test_every_configuration_of_a_page_is_one(page, text):
    least = {
        "study": {"name": "page"},
        "sweep": {"thickness_um": [500], "overlength_percent": [30]},
    }
    load_config(least | yaml.safe_load(text))


def commands():
    lines = [line for _, text in other_blocks("(?:sh)?") for line in text.splitlines()]
    words = [shlex.split(line, comments=True) for line in lines if "foilstudy " in line]
    return [
        line[1:] for line in words if line and line[0].removeprefix(".venv/bin/") == "foilstudy"
    ]


def test_every_command_of_a_page_is_one():
    assert len(commands()) >= 6
    for words in commands():
        command, *_ = app.parse_args(words, exit_on_error=False, print_error=False)
        assert command.__name__ == words[0]
