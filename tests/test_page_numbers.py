"""The numbers of the published study on the pages are those of its cube and tables."""

import importlib.util
import shutil
import sys
from pathlib import Path

import pandas as pd
import pytest

from foilstudy.present.statistics.tables import write_tables

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def pages():
    spec = importlib.util.spec_from_file_location("page_numbers", ROOT / "docs/page_numbers.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def study(pages):
    return pages.Study()


def test_every_page_says_what_the_study_says(pages, study):
    found = set()
    for name in pages.PAGES:
        text = (ROOT / name).read_text("utf-8")
        assert pages.written(text, study) == text, f"{name}: run docs/page_numbers.py"
        found |= {block for _, block, _, _ in pages.BLOCK.findall(text)}
    assert found <= set(pages.BLOCKS)
    assert {"law", "trust", "simulation", "experiment", "shapes", "costs"} <= found


def test_another_table_makes_another_page(pages, study, tmp_path):
    shutil.copytree(study.folder, tmp_path / "thesis")
    table = pd.read_csv(tmp_path / "thesis/powerlaw.csv")
    table["gamma"] += 0.5
    table.to_csv(tmp_path / "thesis/powerlaw.csv", index=False)
    text = (ROOT / "README.md").read_text("utf-8")
    other = pages.written(text, pages.Study(tmp_path / "thesis"))
    different = [a for a, b in zip(text.splitlines(), other.splitlines(), strict=True) if a != b]
    laws = tuple(
        mark.format(d) for mark in ("| {}, ", "- {}: k/(E t)") for d in ("axial", "radial")
    )
    assert different and all(line.startswith(laws) for line in different)


def test_the_tables_of_the_repository_are_those_of_its_cube(study, tmp_path):
    for path in write_tables(study.cube, tmp_path):
        ours, kept = pd.read_csv(path), study.table(path.stem)
        pd.testing.assert_frame_equal(ours, kept, rtol=1e-4, obj=path.stem)
