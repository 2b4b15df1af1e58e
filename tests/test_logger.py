"""What the terminal shows of a running study, and what stands before its first job."""

import os
import signal
from pathlib import Path
from types import SimpleNamespace

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

import snakemake_logger_plugin_foilstudy as plugin
from snakemake_logger_plugin_foilstudy.caches import place_for_caches


@pytest.fixture
def clock(monkeypatch):
    now = SimpleNamespace(seconds=0.0)
    monkeypatch.setattr(plugin.time, "monotonic", lambda: now.seconds)
    return now


@pytest.fixture
def start(monkeypatch):
    """Makes a handler that writes to the standard output of the moment."""
    before = signal.getsignal(signal.SIGINT)
    monkeypatch.setattr(plugin.sys, "excepthook", plugin.sys.excepthook)
    monkeypatch.setattr(plugin.logging, "raiseExceptions", True)
    settings = SimpleNamespace(stdout=True, dryrun=False, printshellcmds=False, verbose=False)
    yield lambda: plugin.LogHandler(common_settings=settings, settings=None)
    signal.signal(signal.SIGINT, before)


def error(message, exception="WorkflowError"):
    return SimpleNamespace(
        event=LogEvent.ERROR, exception=exception, levelno=40, getMessage=lambda: message
    )


def test_time_left_does_not_count_what_came_before_the_first_job(clock, start, capsys):
    """A first run compiles for minutes; the jobs after that take ten seconds each."""
    handler = start()
    handler.emit(SimpleNamespace(event=LogEvent.RUN_INFO, stats={"total": 20, "crumple": 20}))
    for done in range(1, 11):
        clock.seconds = 100.0 + 10.0 * done
        handler.emit(SimpleNamespace(event=LogEvent.JOB_FINISHED, job_id=done))
        handler.emit(SimpleNamespace(event=LogEvent.PROGRESS, done=done, total=20))
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1] == "[10/20] 3:20, about 1:40 left: job"
    assert not any("left" in line for line in lines[1:4])


def test_an_interrupt_is_one_line_and_hides_its_consequences(start, capsys):
    # a shell's background job, which this test may be, ignores interrupts
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    handler = start()
    with pytest.raises(KeyboardInterrupt):
        os.kill(os.getpid(), signal.SIGINT)
    signal.signal(signal.SIGINT, before)
    handler.emit(error("At least one job did not complete successfully."))
    handler.emit(SimpleNamespace(event=LogEvent.JOB_ERROR, jobid=1, rule_name="a", log=["b"]))
    plugin.sys.excepthook(KeyboardInterrupt, KeyboardInterrupt(), None)
    said = capsys.readouterr()
    assert said.out == "Stopped; the same command goes on where it stopped.\n"
    assert not said.err


@pytest.mark.parametrize(
    ("message", "said"),
    [
        (
            "Error recording metadata ([Errno 28] No space left on device). Please ensure",
            f"{Path.cwd()}: No space left on device; make room, then start the same command again.",
        ),
        (
            "Traceback:\n  File a\nNotADirectoryError: [Errno 20] Not a directory: 'a/b.nc'",
            "a/b.nc: Not a directory; remove what stands in place of a folder.",
        ),
        (
            "[Errno 13] Permission denied: 'a/b'",
            "a/b: Permission denied; check its path and permissions, then start the same command "
            "again.",
        ),
        ("Some rule is missing", "Some rule is missing"),
    ],
)
def test_a_fault_of_a_file_is_one_sentence(start, capsys, message, said):
    start().emit(error(message))
    assert capsys.readouterr().out == f"{said}\n"


def test_a_failed_job_without_a_word_says_why_that_may_be(start, capsys, tmp_path):
    (tmp_path / "log").touch()
    log = [str(tmp_path / "log")]
    start().emit(SimpleNamespace(event=LogEvent.JOB_ERROR, jobid=1, rule_name="cube", log=log))
    assert capsys.readouterr().out == (
        f"FAILED cube; its log {log[0]} is empty, as it is where the disk is full.\n"
    )


def test_caches_have_a_place_where_the_home_has_none(tmp_path, monkeypatch):
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setenv("MPLCONFIGDIR", "as it was")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert place_for_caches() is None
    monkeypatch.setenv("HOME", "/dev/null")
    folder = place_for_caches()
    for variable in ("XDG_CACHE_HOME", "MPLCONFIGDIR"):
        assert Path(os.environ[variable]) == Path(folder.name)
    assert Path(folder.name).is_dir()
    folder.cleanup()
    monkeypatch.delenv("XDG_CACHE_HOME")
