"""Arrows between the rooms of the package run one way."""

import ast
import re
from pathlib import Path

import pytest

import foilstudy

ROOT = Path(foilstudy.__file__).parent
ORDER = (
    "base",
    "linalg",
    "model",
    "plot",
    "solve",
    "measure",
    "bench",
    "pipeline",
    "export",
    "config",
    "study",
    "present",
    "command",
)
"""Rooms from the ground up; each may import those before it."""


def modules():
    """Dotted name and file of every module."""
    for path in sorted(ROOT.rglob("*.py")):
        parts = ["foilstudy", *path.relative_to(ROOT).with_suffix("").parts]
        yield ".".join(parts[:-1] if parts[-1] == "__init__" else parts), path


NAMES = dict(modules())


def imported(name, path):
    """Modules of the package that a module names in its import statements, wherever they stand."""
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            wanted = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            parents = package.split(".")[: len(package.split(".")) - node.level + 1]
            base = ".".join([*parents, *filter(None, [node.module])]) if node.level else node.module
            submodules = [f"{base}.{alias.name}" for alias in node.names]
            wanted = [name if name in NAMES else base for name in submodules]
        else:
            continue
        for each in wanted:
            if each in NAMES and each != name:
                yield each


def room(name):
    return name.split(".")[1] if "." in name else ""


def test_every_room_has_its_place():
    rooms = {room(name) for name in NAMES} - {"", "__main__"}
    assert rooms == set(ORDER)


@pytest.mark.parametrize("name", NAMES)
def test_a_room_imports_only_rooms_below_it(name):
    if room(name) not in ORDER:
        pytest.skip("the package's face, above all rooms")
    place = ORDER.index(room(name))
    up = {other for other in imported(name, NAMES[name]) if room(other) not in ORDER[: place + 1]}
    assert not up


def test_no_modules_import_each_other_in_a_circle():
    graph = {name: set(imported(name, path)) for name, path in NAMES.items()}
    while leaves := {name for name, needs in graph.items() if not needs & graph.keys()}:
        for name in leaves:
            del graph[name]
    assert not graph


def arrows():
    """Rooms by the rooms that they import from."""
    return {
        name: {room(other) for module in NAMES if room(module) == name
               for other in imported(module, NAMES[module])} - {name}
        for name in ORDER
    }  # fmt: skip


def test_the_house_stays_small():
    assert len(ORDER) <= 14
    assert sum(map(len, arrows().values())) <= 51


def test_the_page_shows_the_rooms_as_they_are():
    page = (ROOT.parents[1] / "docs/architecture.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `(\w+)` \| .* \| ([^|]*) \|$", page.split("## Five ideas")[0], re.M)
    shown = {name: re.findall(r"`(\w+)`", imports) for name, imports in rows}
    assert tuple(shown) == ORDER
    assert {name: set(imports) for name, imports in shown.items()} == arrows()
