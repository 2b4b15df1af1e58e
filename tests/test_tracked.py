"""What the repository keeps of results: cubes, tables and pictures that a page shows, and small."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pandas as pd
import pytest

from foilstudy.base.reference import PowerLaw

ROOT = Path(__file__).parents[1]
PICTURE_BYTES_MAX = 300_000
TREE_BYTES_MAX = 10_000_000


@pytest.fixture(scope="module")
def tracked() -> list[Path]:
    """Tracked files that there are."""
    try:
        listed = subprocess.run(
            ["git", "-C", str(ROOT), "ls-files", "-z"], check=True, capture_output=True, text=True
        ).stdout
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("not a repository")
    return [path for name in listed.split("\0") if name and (path := ROOT / name).is_file()]


def pages() -> list[Path]:
    return [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]


def shown() -> set[Path]:
    """Pictures that a page shows."""
    return {
        (page.parent / target).resolve()
        for page in pages()
        for target in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", page.read_text("utf-8"))
    }


def test_results_keep_cubes_tables_and_pictures_that_a_page_shows(tracked):
    kept = {path for path in tracked if path.is_relative_to(ROOT / "results")}
    pictures = {path for path in kept if path.suffix == ".png"}
    assert pictures == shown()
    for path in kept - pictures:
        assert path.suffix in (".csv", ".md") or path.name == "cube.nc", path


def test_a_clone_is_small(tracked):
    assert sum(path.stat().st_size for path in tracked) < TREE_BYTES_MAX
    for path in tracked:
        assert path.suffix != ".png" or path.stat().st_size < PICTURE_BYTES_MAX, path


def test_links_between_pages_lead_to_tracked_files(tracked):
    for page in pages():
        for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text("utf-8")):
            path = (page.parent / target).resolve()
            assert path in tracked or any(path in file.parents for file in tracked), (page, target)


LAW_ROW = re.compile(
    r"^\| \**(axial|radial), ([^|*]+?)\** \| (\S+) ± (\S+) \| (\S+) ± (\S+) \| (\S+) ± (\S+) \| "
    r"(\S+) \|$",
    re.MULTILINE,
)
SOURCES = {
    "mesh limit, trusted": "simulation mesh limit, trusted",
    "mesh limit": "simulation mesh limit",
    "5 mm mesh": "simulation",
    "pre-stressed": "simulation pre-stressed",
    "published simulation": "published simulation",
    "published experiment": "published experiment",
}


def law_table():
    return pd.read_csv(ROOT / "results/thesis/powerlaw.csv").set_index(["direction", "source"])


@pytest.mark.parametrize("page", ["README.md", "docs/comparison.md"])
def test_laws_on_a_page_are_those_of_the_table(page):
    table = law_table()
    rows = LAW_ROW.findall((ROOT / page).read_text("utf-8"))
    assert len(rows) == len(table)
    for direction, name, *numbers in rows:
        law = table.loc[(direction, SOURCES[name])]
        expected = [
            f"{value:.2f}"
            for part in ("alpha", "beta", "gamma")
            for value in (law[part], (law[f"{part}_high"] - law[f"{part}_low"]) / 2)
        ]
        assert numbers == [*expected, f"{law['r2']:.3f}"], (direction, name)


def test_dimensionless_law_of_the_first_page_is_that_of_the_table():
    text = (ROOT / "README.md").read_text("utf-8")
    for direction in ("axial", "radial"):
        law = law_table().loc[(direction, SOURCES["mesh limit, trusted"])]
        free = PowerLaw(law["alpha"], law["beta"], law["gamma"]).dimensionless(100.0, 650.0)
        assert (
            f"{free.constant:.2f} · (overlength/gap)^{free.beta:.2f} · (t/R)^{free.gamma:.2f} "
            f"{direction}ly"
        ) in text
