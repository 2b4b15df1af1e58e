"""What comes with the package: requirements, citation."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
PINNED = sorted((ROOT / "requirements").glob("*.txt"))


def pins(path):
    """Versions by package."""
    return dict(re.findall(r"^([\w.-]+)==([^\s;]+)", path.read_text("utf-8"), re.MULTILINE))


@pytest.mark.parametrize("path", PINNED, ids=lambda path: path.stem)
def test_every_requirement_is_pinned_with_its_hashes_and_no_address(path):
    text = path.read_text("utf-8")
    assert "://" not in text and path.with_suffix(".in").is_file()
    blocks = re.split(r"^(?=[\w.-]+==)", text, flags=re.MULTILINE)[1:]
    assert len(blocks) == len(pins(path)) > 5
    assert all("--hash=sha256:" in block for block in blocks)


def test_further_requirements_agree_with_those_of_the_package():
    base = pins(ROOT / "requirements/requirements.txt")
    for path in PINNED:
        shared = pins(path).keys() & base.keys()
        assert {name: pins(path)[name] for name in shared} == {name: base[name] for name in shared}


def test_the_extra_for_a_cluster_is_pinned():
    (plugin,) = PROJECT["optional-dependencies"]["slurm"]
    assert plugin in pins(ROOT / "requirements/slurm.txt")
    profile = (ROOT / "workflow/profiles/slurm/config.yaml").read_text("utf-8")
    assert yaml.safe_load(profile)["executor"] == "slurm"
    assert "-r requirements/slurm.txt" in profile


def test_the_citation_names_this_release_and_the_thesis():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    assert citation["cff-version"] == "1.2.0" and citation["message"]
    assert citation["title"].startswith("foilstudy") and citation["type"] == "software"
    assert citation["version"] == PROJECT["version"]
    assert citation["license"] == PROJECT["license"]
    assert citation["authors"] == PROJECT["authors"]
    (thesis,) = citation["references"]
    assert thesis["type"] == "thesis" and thesis["year"] == 2026
    assert thesis["title"] in " ".join((ROOT / "README.md").read_text("utf-8").split())
    assert thesis["institution"] == {"name": "TU Delft"}
