"""Every malformed configuration is one sentence for each problem, soon, and by every way in."""

import os
import subprocess
import sys
import time
from functools import cache
from pathlib import Path

import pytest
from malformed import malformed

from foilstudy.command import main
from foilstudy.config import ConfigError, load_merged
from snakemake_logger_plugin_foilstudy import configuration

ROOT = Path(__file__).parents[1]
CASES = malformed()
SECONDS_MAX, CHARACTERS_MAX, PROBLEMS_MAX = 2.0, 2000, 11


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The cases as files, and what is no file at all."""
    place = tmp_path_factory.mktemp("cases")
    for number, content in enumerate(CASES.values()):
        (place / f"{number}.yaml").write_bytes(content)
    (place / "folder").mkdir()
    (place / "link").symlink_to(place / "nothing")
    os.mkfifo(place / "pipe")
    return place


def said_of(call):
    """Sentences a call ends in, which are complete, in single lines, few and soon there."""
    begin = time.process_time()
    with pytest.raises((ConfigError, SystemExit)) as ended:
        call()
    seconds = time.process_time() - begin
    text = str(ended.value)
    assert seconds < SECONDS_MAX, text
    assert 0 < len(text) < CHARACTERS_MAX
    lines = text.split("\n")
    assert len(lines) <= PROBLEMS_MAX
    assert all(line.endswith((".", "?", '".')) and line.isprintable() for line in lines), text
    return lines


@cache
def sentences(path):
    """What reading a file ends in."""
    return said_of(lambda: load_merged([path]))


def test_there_are_enough_cases():
    assert len(CASES) >= 250
    assert len(set(CASES.values())) == len(CASES)


@pytest.mark.parametrize("number", range(len(CASES)), ids=list(CASES))
def test_a_malformed_file_is_refused_in_sentences(folder, number):
    path = folder / f"{number}.yaml"
    lines = sentences(path)
    assert all(line.startswith(f"{path}: ") for line in lines)
    # and by the command in the same ones
    assert said_of(lambda: main(["check", str(path)])) == lines


@pytest.mark.parametrize(
    "name", ["folder", "link", "pipe", "nothing", "folder/a", "link/a", "a\nb"]
)
def test_what_is_no_file_is_refused_in_a_sentence(folder, name):
    (line,) = said_of(lambda: load_merged([folder / name]))
    assert str(folder) in line


@pytest.mark.parametrize("number", range(0, len(CASES), 9))
def test_snakemake_refuses_it_before_it_reads(folder, number, monkeypatch):
    path = folder / f"{number}.yaml"
    monkeypatch.setattr(sys, "argv", ["bin/snakemake", "-j1", "--configfile", str(path)])
    assert said_of(configuration.refuse_unreadable_config) == sentences(path)


@pytest.mark.parametrize("second", ["empty", "a NUL", "a bomb of lists", "sweep is 5"])
def test_the_second_of_two_files_is_looked_at_as_closely(folder, second):
    path = folder / f"{list(CASES).index(second)}.yaml"
    lines = said_of(lambda: load_merged([ROOT / "config/tiny.yaml", path]))
    assert all(str(path) in line for line in lines)


@pytest.mark.parametrize(
    ("words", "essence"),
    [
        (["sweep"], "this is not SECTION={KEY: VALUE}"),
        (["sweep=5"], "sweep is 5, not a section"),
        (["sweep="], "sweep is empty, not a section"),
        (["sweep=#"], "sweep is empty, not a section"),
        (["sweep.realisations=3"], '--config "sweep={realisations: 3}"'),
        (["colour=red"], "this is not SECTION={KEY: VALUE}"),
        (["sweep={realisations: 2, realisations: 3}"], "key realisations is given twice"),
        (["sweep={realisations: [}"], "this is not valid YAML"),
        (["sweep={realisations: three}"], "sweep.realisations is the text 'three'"),
        (["mesh=!!python/object:os {}"], "the tag"),
        (["=5"], "this is not SECTION={KEY: VALUE}"),
    ],
)
def test_words_of_the_command_line_are_looked_at_as_closely(words, essence):
    (line,) = said_of(lambda: load_merged([ROOT / "config/tiny.yaml"], words))
    assert "--config" in line and essence in line


@pytest.mark.parametrize(
    "case", ["a bomb of merges", "list nested 60000 times", "20 000 wrong items", "a NUL"]
)
def test_snakemake_itself_ends_in_sentences(folder, tmp_path, case):
    path = folder / f"{list(CASES).index(case)}.yaml"
    run = subprocess.run(
        [Path(sys.executable).with_name("snakemake"), "-j1", "--configfile", path],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 1 and not run.stdout
    assert run.stderr.splitlines()[1:] == sentences(path)
