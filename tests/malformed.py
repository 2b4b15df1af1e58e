"""Configurations that cannot be run, of every kind a user, an editor or a script may leave."""

from __future__ import annotations

import codecs
from collections.abc import Iterator
from typing import Any

import yaml

from foilstudy.config import StudyConfig

SWEEP = "sweep: {thickness_um: [500], reference_height_mm: [170]}\n"
NUMBERS = (".nan", ".inf", "-.inf", "-2e9", "9" * 300, "9" * 5000, "1e999", "12 mm", "'5'", "~")
NOT_NUMBERS = ("[1, 2, x]", "{a: 1}", "true", "\u0663\u0664", "5,0", "2026-01-01", "0x1F", "1_000")
NOT_TEXT = (
    "5",
    "~",
    "true",
    "[a]",
    "{a: b}",
    ".nan",
    "2.5",
    '"\\0"',
    '"\\e[31m"',
    '""',
    '"\\ud83d"',
)
NOT_CHOICES = ("5", "~", "[]", "'of course'", "true", "{}", "x" * 3000)


def _nested_aliases() -> str:
    """Lists that name each other, shallow one by one and a thousand deep together."""
    lines = ["a0: &a0 [1]"]
    lines += [f"a{n}: &a{n} {'[' * 12}*a{n - 1}{']' * 12}" for n in range(1, 80)]
    return "\n".join(lines) + "\n"


def malformed() -> dict[str, bytes]:
    """Contents of files by what is wrong with them."""
    texts = dict(_syntax()) | dict(_yaml_kinds()) | dict(_structure()) | dict(_values())
    whole = {name: text.encode("utf-8", "surrogatepass") for name, text in texts.items()}
    return whole | dict(_encodings())


def _encodings() -> Iterator[tuple[str, bytes]]:
    text = SWEEP + "report: {title: Fl\u00e4che}\n"
    for name in ("latin-1", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "cp037"):
        yield f"encoding {name}", text.encode(name)
    yield "encoding utf-16 without content", codecs.BOM_UTF16_LE
    yield "encoding half a character at the end", text.encode()[:-5] + b"\xc3"
    yield "a picture", b"\x89PNG\r\n\x1a\n" + bytes(range(256))
    yield "a record", b"\x89HDF\r\n\x1a\n" + bytes(500)
    yield "zeros", bytes(5000)
    yield "a marked end", b"\xef\xbb\xbf"


def _syntax() -> Iterator[tuple[str, str]]:
    yield from {
        "empty": "",
        "blank lines": "\n\n  \n",
        "a comment alone": "# nothing yet\n",
        "an empty document": "---\n",
        "an ended document": "---\n...\n",
        "null": "~\n",
        "an empty mapping": "{}\n",
        "an empty list": "[]\n",
        "a word": "sweep\n",
        "a number": "5\n",
        "a list": "- sweep\n- mesh\n",
        "lines of Python": "import os\nx = 5\n",
        "a table": "thickness,height\n500,170\n",
        "an INI file": "[sweep]\nthickness_um = 500\n",
        "an XML file": "<sweep><thickness>5</thickness></sweep>\n",
        "an open list": "sweep: {thickness_um: [500, 250\n",
        "an open mapping": "sweep: {thickness_um: 5\n",
        "an open quote": "report: {title: 'abc}\n",
        "an open double quote": 'report: {title: "abc}\n',
        "a closed list too many": SWEEP + "mesh: ]\n",
        "a comma too many": "sweep: {thickness_um: [1,,2]}\n",
        "two colons": "sweep: thickness_um: 5\n",
        "no space after a colon": "sweep:5\n",
        "a tab for an indent": "sweep:\n\tthickness_um: [500]\n",
        "a tab in a list": "sweep:\n  thickness_um:\n\t- 5\n",
        "a wrong indent": "sweep:\n   thickness_um: [5]\n  realisations: 2\n",
        "an indent too few": "sweep:\nthickness_um: [5]\n",
        "a forbidden first character": "sweep: @5\n",
        "a backtick": "sweep: `5`\n",
        "a percent sign": "sweep: %5\n",
        "an unknown escape": 'report: {title: "\\q"}\n',
        "a short escape": 'report: {title: "\\u12"}\n',
        "a NUL": SWEEP + "report: {title: a\0b}\n",
        "a bell": SWEEP + "report: {title: a\ab}\n",
        "a deleted character": SWEEP + "report: {title: a\x7fb}\n",
        "half a character": SWEEP + "report: {title: a\ud800b}\n",
        "an unknown version": "%YAML 3.0\n---\n" + SWEEP,
        "two versions": "%YAML 1.2\n%YAML 1.2\n---\n" + SWEEP,
        "a bad directive": "%YAML x\n---\n" + SWEEP,
        "a bad tag directive": "%TAG ! \n---\n" + SWEEP,
        "a bad block header": "report:\n  title: |x\n   a\n",
        "JSON with a comment": '{"sweep": {}} // no\n',
        "JSON that ends": '{"sweep": {"thickness_um": [500',
        "JSON with an extra comma of objects": '{"sweep": {}}, {}',
        "JSON of another kind": '[{"sweep": 5}]',
        "JSON with a key twice": '{\n\t"sweep": {"realisations": 1, "realisations": 2}}',
        "a long key": "k" * 2000 + ": 1\n",
        "a long quoted key": SWEEP + '"' + "k" * 900 + '": 1\n',
    }.items()


def _yaml_kinds() -> Iterator[tuple[str, str]]:
    tags = (
        "!!python/object/apply:os.system ['true']",
        "!!python/object:os.path {}",
        "!!python/name:os.system",
        "!!python/tuple [1]",
        "!!binary aGVsbG8=",
        "!!timestamp 2026-01-01",
        "!!set {a, b}",
        "!!omap [a: 1]",
        "!!pairs [a: 1]",
        "!!float abc",
        "!!int 5.5",
        "!!int 0x10",
        "!!bool perhaps",
        "!!null x",
        "!!seq {a: 1}",
        "!!map [1]",
        "!!str {a: 1}",
        "!own 5",
        "!include other.yaml",
        "!<tag:example.org,2026:foil> 5",
        "!undeclared!tag 5",
    )
    for tag in tags:
        yield f"tag {tag}", f"sweep: {tag}\n"
    for value in ("2026-02-30", "=", "0b_", "0x_", "<<", "2026-13-01 10:00:00"):
        yield f"text that YAML 1.1 takes for more: {value}", f"{SWEEP}report: {{title: {value}}}\n"
    for depth in (20, 1000, 10_000, 60_000):
        for name, piece in {"list": "[", "mapping": "{a: ", "dash": "- ", "key": "? "}.items():
            yield f"{name} nested {depth} times", (piece * depth)[:60_000]
    chain = list(zip("abcdefghij", "bcdefghijk", strict=True))
    bomb = "".join(f"{new}: &{new} [{', '.join([f'*{old}'] * 9)}]\n" for old, new in chain)
    yield "a bomb of lists", "a: &a [x, x, x]\n" + bomb
    bomb = "".join(f"{new}: &{new} {{x: *{old}, y: *{old}, z: *{old}}}\n" for old, new in chain)
    yield "a bomb of mappings", "a: &a {x: 1}\n" + bomb * 2
    bomb = "".join(f"{new}: &{new} {{<<: *{old}, {new}: *{old}}}\n" for old, new in chain)
    yield "a bomb of merges", "a: &a {a: 1}\n" + bomb
    for name, text in {
        "an alias of nothing": "sweep: *other\n",
        "an alias of itself": "sweep: &a {b: *a}\n",
        "aliases nested in one another": _nested_aliases(),
        "a list within itself": "sweep: &a [*a]\n",
        "an anchor twice": "sweep: &a 5\nmesh: &a 6\n",
        "a merge of a number": "sweep: {<<: 5}\n",
        "a merge of numbers": "sweep: {<<: [1, 2]}\n",
        "two merges": "sweep: &a {b: 1}\nmesh: {<<: *a, <<: *a}\n",
        "merges that disagree": "sweep: &a {b: 1}\nmesh: &c {b: 2}\nreport: {<<: [*a, *c]}\n",
        "a merge of itself": "sweep: &a {<<: *a}\n",
        "two documents": f"{SWEEP}---\n{SWEEP}",
        "two documents, the first empty": f"---\n---\n{SWEEP}",
        "an end and more": f"{SWEEP}...\n{SWEEP}",
        "a number for a key": SWEEP + "5: 6\n",
        "nothing for a key": SWEEP + "~: 6\n",
        "a truth value for a key": SWEEP + "true: 6\n",
        "a list for a key": SWEEP + "? [a, b]\n: 6\n",
        "a mapping for a key": SWEEP + "? {a: b}\n: 6\n",
        "a number for a key within": "sweep: {thickness_um: [500], 5: 6}\n",
        "a key twice": SWEEP + SWEEP,
        "a key twice in a section": "sweep:\n  realisations: 2\n  thickness_um: [5]\n"
        "  realisations: 3\n",
        "a key twice in braces": "sweep: {realisations: 2, realisations: 2}\n",
        "a quoted key twice": 'sweep: {realisations: 2, "realisations": 2}\n',
        "a key twice two levels down": SWEEP + "mesh: {a: {b: 1, b: 2}}\n",
        "a key twice by an alias": SWEEP + "&k mesh: {}\n*k : {}\n",
        "code of a template language": "__use_yte__: true\n?f'{1/0}': 5\n" + SWEEP,
        "code beside a study": "__definitions__:\n  - import os\n" + SWEEP,
        "20 000 wrong items": f"sweep: {{thickness_um: [{'a,' * 20_000}]}}\n",
        "10 000 wrong items, one a line": "sweep:\n  thickness_um:\n" + "   - a\n" * 8_000,
        "6 000 unknown keys": SWEEP + "".join(f"k{number}: 1\n" for number in range(6_000)),
        "5 000 unknown keys within": "sweep:\n"
        + "".join(f"  k{number}: 1\n" for number in range(5_000)),
        "a key 12 000 times": "k: \n" * 12_000,
        "a large file": f"{SWEEP}report: {{title: {'x' * 100_000}}}\n",
        "a large comment": SWEEP + "#" * 100_000,
        "a long text": f"{SWEEP}report: {{title: {'x' * 50_000}}}\n",
        "a long name": f"{SWEEP}material: {{name: {'x' * 50_000}}}\n",
        "a long number": f"{SWEEP}mesh: {{element_size_mm: {'9' * 50_000}}}\n",
        "a name of several lines": SWEEP + 'material: {name: "a\\nb\\nc"}\n',
        "a key of several lines": SWEEP + '"a\\nb": 5\n',
        "a key with an escape": SWEEP + '"\\e[31mred": 5\n',
    }.items():
        yield name, text


def _structure() -> Iterator[tuple[str, str]]:
    for section in StudyConfig.model_fields:
        content = {name: value for name, value in yaml.safe_load(SWEEP).items() if name != section}
        rest = yaml.safe_dump(content) if content else ""
        for value in ("[]", "5", "word"):
            yield f"{section} is {value}", f"{rest}{section}: {value}\n"
        yield f"{section} has no keys", f"{rest}{section}:\n"
        yield f"{section} in a list", f"{rest}{section}:\n  - {section}: 5\n"
    yield from {
        "no sweep": "study: {name: a}\n",
        "a sweep without thickness": "sweep: {overlength_percent: [30]}\n",
        "a sweep without height": "sweep: {thickness_um: [500]}\n",
        "both heights": "sweep: {thickness_um: [500], reference_height_mm: [170], "
        "overlength_percent: [30]}\n",
        "a height below the gap": "sweep: {thickness_um: [500], reference_height_mm: [100]}\n",
        "a gap that makes the foil too high": "sheet: {gap_height_mm: 9000}\n"
        "sweep: {thickness_um: [500], overlength_percent: [30]}\n",
        "a thickness twice": "sweep: {thickness_um: [500, 500.0], overlength_percent: [30]}\n",
        "too many realisations": f"sweep: {{thickness_um: {list(range(100, 900))}, "
        f"overlength_percent: {list(range(1, 900))}, realisations: 10000}}\n",
        "too many values": f"sweep: {{thickness_um: {list(range(100, 3000))}, "
        "overlength_percent: [30]}\n",
        "a thick foil": "sweep: {thickness_um: [9000], overlength_percent: [30]}\n",
        "a coarse mesh": SWEEP + "mesh: {element_size_mm: 100}\n",
        "a fine mesh": SWEEP + "mesh: {element_size_mm: 0.001}\n",
    }.items()


def _values() -> Iterator[tuple[str, str]]:
    """Wrong values of every key, some of each kind."""
    turn = 0
    for section, model in StudyConfig.sections().items():
        for key, entry in model.model_fields.items():
            unit = entry.json_schema_extra["unit"]
            wrong = _wrong_values(unit, entry.annotation)
            for value in (wrong[turn % len(wrong)], wrong[(turn + 3) % len(wrong)]):
                if section == "sweep":
                    text = f"sweep: {{thickness_um: [500], overlength_percent: [30], x: {value}}}\n"
                    text = text.replace("x: ", f"{key}: ")
                else:
                    text = f"{SWEEP}{section}: {{{key}: {value}}}\n"
                yield f"{section}.{key}: {value[:20]}", text
            turn += 1


def _wrong_values(unit: str, annotation: Any) -> tuple[str, ...]:
    if unit in ("text", "id"):
        return NOT_TEXT
    if unit == "choice":
        return NOT_CHOICES
    if unit.startswith("list"):
        return ("5", "word", "[[1]]", "[~]", "{a: 1}", "[.nan]", "[true]", "['5']")
    numbers = NUMBERS + NOT_NUMBERS
    return tuple(v for v in numbers if v != "~") if type(None) in _union(annotation) else numbers


def _union(annotation: Any) -> tuple[Any, ...]:
    return getattr(annotation, "__args__", ())
