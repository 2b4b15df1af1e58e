"""What the repository keeps of results: cubes, tables and pictures that a page shows, and small."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PICTURE_BYTES_MAX = 300_000
TREE_BYTES_MAX = 16_500_000


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
    pictures = {path for path in tracked if path.suffix == ".png"}
    assert pictures == shown()
    for path in kept - pictures:
        assert path.suffix in (".csv", ".md") or path.name in ("cube.nc", "manifest.json"), path


def test_a_clone_is_small(tracked):
    assert sum(path.stat().st_size for path in tracked) < TREE_BYTES_MAX
    for path in tracked:
        assert path.suffix != ".png" or path.stat().st_size < PICTURE_BYTES_MAX, path


def test_links_between_pages_lead_to_tracked_files(tracked):
    for page in pages():
        for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text("utf-8")):
            path = (page.parent / target).resolve()
            assert path in tracked or any(path in file.parents for file in tracked), (page, target)
