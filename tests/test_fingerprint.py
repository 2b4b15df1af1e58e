"""What counts as the code of a record: what its task chooses, whatever else there is to choose."""

import re
import shutil
from functools import cache
from importlib import import_module
from typing import Literal

import pytest
from pydantic import BaseModel
from small_study import sections_with

from foilstudy.base import fingerprint, sources
from foilstudy.base.fingerprint import Code
from foilstudy.base.registry import Choice, Registry
from foilstudy.base.sources import significant, source_of
from foilstudy.config import load_config
from foilstudy.config.choices import choice_of, choices_of
from foilstudy.study.sweep import origins

DEFAULT = {}
OTHER = {
    "mesh": {"element": "one_point"},
    "imperfection": {"kind": "smoothed", "correlation_length_mm": 60.0},
    "dynamics": {"reduction": "guyan", "damping": "structural"},
    "export": {"formats": ["mat", "csv"]},
}
"""Another entry of every registry that has one."""
REGISTRIES = {
    "element": "model.shell.elements",
    "material law": "model.shell.material",
    "imperfection": "model.imperfections",
    "mass scaling": "solve.choices",
    "damping of the relaxation": "solve.choices",
    "search for the minimum": "solve.choices",
    "path": "solve.choices",
    "stress removal": "measure.choices",
    "reduction": "measure.choices",
    "damping": "measure.choices",
    "export format": "export.formats",
    "surrounding air": "measure.choices",
    "enclosed air": "measure.choices",
    "contact": "model.contact",
}
"""By kind, the modules that hold them."""
NOT_IN_TASKS = {
    "stiffness measure": "pipeline.measures",
    "lesser model": "model.shell.elements",
    "estimator": "bench.estimation.estimators",
    "excitation": "bench.signals",
    "format of measured responses": "bench.measured",
    "format of time signals": "bench.signal_files",
    "specimen": "bench.rig.specimens",
}
"""The same of what no configuration chooses from."""
ANOTHER = {
    "solve.choices": "solve.another",
    "measure.choices": "measure.dynamics.another",
    "export.formats": "export.another",
}
"""Where a further strategy would stand, if not in the package of its registry."""
CRUMPLED = "crumple response refined export"
CACHES = source_of, fingerprint._reached, fingerprint._fingerprint
read_once = cache(sources._read)


class Package:
    """A copy of the package whose sources can be edited, and what the fingerprints make of it."""

    def __init__(self, folder):
        self.folder = folder

    def path(self, module):
        path = self.folder.joinpath(*module.split("."))
        return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")

    def append(self, module, text):
        self.path(module).write_text(self.path(module).read_text() + text)

    def replace(self, module, pattern, text):
        content, count = re.subn(pattern, text, self.path(module).read_text())
        assert count == 1
        self.path(module).write_text(content)

    def add(self, kind, entry):
        """Put an entry before all others of a registry."""
        self.replace(REGISTRIES[kind], rf'(Registry\(\s*"{kind}",\s*{{)', rf"\1{entry}")

    def codes(self, sections):
        """Fingerprints of all records of a study, by their names, as of today."""
        forget()
        study = load_config(sections_with(**sections))
        cell = study.cells()[0]
        crumple, response = study.crumple_task(cell), study.response_task(cell)
        refine = load_config(
            sections_with(**sections | {"stiffness": {"relaxed_refinements": 1}})
        ).refine_task(cell)
        recorded = {"task": crumple.model_dump_json(), "digest": ""}
        found = {
            "crumple": origins.crumple_origin(crumple),
            "response": origins.response_origin(response, recorded),
            "refined": origins.refined_origin(refine, recorded),
            "cylinder": origins.cylinder_origin(study),
            "export": origins.export_origin(response, recorded, study.export.formats),
        }
        return {name: origin.code for name, origin in found.items()}

    def changed(self, sections, edit):
        """Names of the records of a study that an edit makes again."""
        before = self.codes(sections)
        edit()
        after = self.codes(sections)
        return {name for name in before if before[name] != after[name]}


@pytest.fixture
def package(tmp_path, monkeypatch):
    folder = tmp_path / "foilstudy"
    shutil.copytree(sources.PACKAGE, folder, ignore=shutil.ignore_patterns("__pycache__", "data"))
    monkeypatch.setattr(sources, "PACKAGE", folder)
    monkeypatch.setattr(sources, "_read", read_once)
    forget()
    yield Package(folder)
    monkeypatch.undo()
    forget()


def forget():
    for each in CACHES:
        each.cache_clear()


def of_all():
    return origins.CRUMPLE.fingerprint(), origins.EXPORT.fingerprint()


@pytest.mark.parametrize("kind, holder", REGISTRIES.items())
@pytest.mark.parametrize("sections", [DEFAULT, OTHER], ids=["default", "other"])
def test_a_strategy_that_nobody_chooses_makes_nothing_again(package, kind, holder, sections):
    another = ANOTHER.get(holder, f"{holder}.another")

    def edit():
        package.path(another).write_text("class Another:\n    pass\n")
        package.add(kind, f'"another": Choice("{another}:Another", "another one"), ')

    everything = of_all()
    assert package.changed(sections, edit) == set()
    assert of_all() != everything
    chosen = [code.choosing({kind: ["another"]}) for code in (origins.CRUMPLE, origins.EXPORT)]
    assert another in {module for code in chosen for module in code.modules()}


@pytest.mark.parametrize(
    "module, default, other",
    [
        ("model.imperfections.gaussian", "crumple", "crumple"),  # the default is named in the code
        ("model.imperfections.smoothed", "", "crumple"),
        ("model.imperfections.buckling_modes", "", ""),
        ("model.shell.elements.one_point_kernel", "cylinder export", "all"),
        ("measure.dynamics.reductions.guyan", "", "response export"),
        ("measure.dynamics.reductions.craig_bampton", "", ""),
        ("measure.dynamics.damping", "response export", "response export"),
        ("export.matlab", "", "export"),
        ("export.calculix", "", ""),
        ("solve.paths.relaxation", CRUMPLED, CRUMPLED),
        ("model.patch", "all", "all"),
        ("linalg.factorisation", "all", "all"),
        ("base.registry", "", ""),
        ("model.material_table", "", ""),
        ("config.scene", "crumple response export", "crumple response export"),
    ],
)  # fmt: skip
def test_an_edit_makes_again_what_was_made_by_it(package, module, default, other):
    for number, (sections, words) in enumerate([(DEFAULT, default), (OTHER, other)]):
        found = package.changed(sections, lambda n=number: package.append(module, f"EDIT = {n}\n"))
        every = {"crumple", "response", "refined", "cylinder", "export"}
        assert found == (every if words == "all" else set(words.split()))


def test_the_line_of_what_is_chosen_counts_and_no_other(package):
    def edit(name):
        return lambda: package.replace(
            "model.imperfections", rf"{name}:deviation", rf"{name}:other"
        )

    assert package.changed(OTHER, edit("buckling_modes")) == set()
    assert package.changed(OTHER, edit("smoothed")) == {"crumple"}


@pytest.mark.parametrize(
    "line",
    [
        'NAMED = ELEMENTS["one_point"]',
        'def made(name="one_point"):\n    return ELEMENTS[name]',
        "ALL = [ELEMENTS[name] for name in ELEMENTS]",
        "ALL = list(ELEMENTS.values())",
        "ALL = [choice.load() for choice in ELEMENTS.choices.values()]",
        "from foilstudy.model.shell.elements import ELEMENTS as E",
        "from foilstudy.model.shell.elements.one_point import OnePoint",
    ],
)
def test_what_code_takes_of_a_registry_by_itself_is_followed(package, line):
    module = "model.shell.elements.one_point"
    package.append("model.patch", "\nfrom foilstudy.model.shell.elements import ELEMENTS\n")

    def modules():
        package.codes(DEFAULT)
        return origins.CRUMPLE.choosing({"element": ["corner"]}).modules()

    package.append("model.patch", 'KNOWN = "one_point" in ELEMENTS\n')
    assert module not in modules()
    package.append("model.patch", f"{line}\n")
    assert module in modules()


def test_of_a_registry_that_no_key_speaks_of_all_is_followed():
    modules = set(origins.CRUMPLE.choosing({"imperfection": ["gaussian"]}).modules())
    assert {"model.shell.elements.corner", "model.shell.elements.one_point"} <= modules
    assert "model.imperfections.smoothed" not in modules


# --- what a task chooses --------------------------------------------------------------------------


FEW = Registry("few", {name: Choice(f"few:{name}", name) for name in ("a", "b", "c")})
MANY = Registry("many", {name: Choice(f"many:{name}", name) for name in ("a", "b", "c")})


class Inner(BaseModel):
    one: choice_of(FEW) = "a"


class Outer(BaseModel):
    inner: Inner = Inner()
    inners: tuple[Inner, ...] = ()
    named: dict[str, choice_of(MANY)] = {}
    many: tuple[choice_of(MANY), ...] = ("b",)
    perhaps: choice_of(FEW) | Literal["auto"] | None = "b"
    text: str = "c"


def test_every_key_whose_value_is_of_a_registry_says_what_is_chosen():
    assert choices_of(Outer(named={"x": "c"})) == {"few": ("a", "b")}  # x might be a choice
    assert choices_of(Outer(inners=(Inner(one="c"),), named={"b": "c"}))["few"] == ("a", "b", "c")
    assert choices_of(Outer(named={"b": "c"}))["many"] == ("b", "c")
    assert choices_of(Inner(one="c"), Inner(one="b")) == {"few": ("b", "c")}


@pytest.mark.parametrize("value", ["auto", None])
def test_a_key_that_leaves_the_choice_open_chooses_all(value):
    assert "few" not in choices_of(Outer(perhaps=value))


def test_the_keys_of_a_study_choose_from_every_registry():
    study = load_config(sections_with())
    cell = study.cells()[0]
    assert choices_of(study).keys() == REGISTRIES.keys()
    tasks = study.crumple_task(cell), study.response_task(cell)
    assert choices_of(*tasks).keys() == REGISTRIES.keys() - {"export format"}
    assert choices_of(tasks[0])["element"] == ("corner",)


# --- what a source says ---------------------------------------------------------------------------


def registries():
    """Every registry of the package, by module and variable."""
    for path in sorted(sources.PACKAGE.rglob("*.py")):
        for variable in re.findall(r"^(\w+) = Registry\(", path.read_text(), re.M):
            parts = path.relative_to(sources.PACKAGE).with_suffix("").parts
            module = ".".join(parts).removesuffix(".__init__")
            yield module, variable, getattr(import_module(f"foilstudy.{module}"), variable)


def test_every_registry_is_read_as_it_is():
    kinds = {}
    for module, variable, registry in registries():
        entries = [e for e in source_of(module).entries if e.variable == variable]
        names = [
            name for name in registry if "receptance" not in name and "accelerance" not in name
        ]
        assert [entry.name for entry in entries] == names
        for entry in entries:
            assert entry.kind == registry.kind
            assert entry.places == {registry.choice(entry.name).place.partition(":")[0]}
        assert registry.kind not in kinds
        kinds[registry.kind] = module
    assert kinds == REGISTRIES | NOT_IN_TASKS


def read(text):
    return sources._read("solve.choices", False, text)


def test_an_entry_is_its_words_and_not_their_place_on_the_page():
    flat = read('A = Registry("a", {"é": Choice("solve.paths:P", "x"), "y": Choice("b:c", "d")})\n')
    text = (
        'A = Registry(\n    "a",\n    {\n        "é": Choice(\n            "solve.paths:P",  # y\n'
        '            "x",\n        ),\n        "y": Choice("b:c", "d"),\n    },\n)\n'
    )
    assert read(text) == flat
    assert [entry.name for entry in flat.entries] == ["é", "y"]
    assert flat.entries[0].places == {"solve.paths"} and "solve" in flat.entries[0].imports
    assert "solve.paths" not in flat.imports


@pytest.mark.parametrize(
    "text",
    [
        'A = Registry("a", dict(x=Choice("solve.paths:P", "x")))',
        'A = Registry("a", {n: Choice("solve.paths:P", "x") for n in "xy"})',
        'A = Registry("a", {"x": lambda y, z: "solve.paths:P"})',
        'A = Registry("a", {**OTHERS, NAME: Choice("solve.paths:P", "x")})',
        'A = Registry("a", {"x": Choice("solve.paths:P", "x"), "x": 1})',
        'A = Registry(KIND, {"x": Choice("solve.paths:P", "x")})',
        'A = Registry("a", choices={"x": Choice("solve.paths:P", "x")})',
        'A = wrapped(Registry("a", {"x": Choice("solve.paths:P", "x")}))',
        'if True:\n    A = Registry("a", {"x": Choice("solve.paths:P", "x")})',
    ],
)
def test_an_entry_that_cannot_be_told_apart_counts(text):
    source = read(text + "\n")
    assert source.entries == () and "solve.paths" in source.imports
    assert read(text.replace(":P", ":Q") + "\n").text != source.text


def test_comments_and_words_are_no_code():
    code = 'import a\n\n\ndef f(x):\n    return x + 1\n\n\nS = """text"""\n'
    same = (
        '"""Module."""\nimport a  # why\n\n# more\ndef f(x):\n    """Add\n    one."""\n'
        '    # one\n    return x + 1\nS = """text"""\n"""What S is."""\n'
    )
    assert significant(code) == significant(same)
    for other in (
        code.replace("+ 1", "+ 2"),
        code.replace("text", "test"),
        code.replace("import a", "import b"),
    ):
        assert significant(other) != significant(code)


def test_the_order_of_choices_is_no_difference():
    one = Code((), ()).choosing({"b": ["y", "x"], "a": ("z",)})
    assert one == Code((), ()).choosing({"a": ["z"], "b": ("x", "y")})
    assert hash(one)
