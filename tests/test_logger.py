"""What the terminal shows of a running study."""

from types import SimpleNamespace

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

import snakemake_logger_plugin_foilstudy as plugin


@pytest.fixture
def clock(monkeypatch):
    now = SimpleNamespace(seconds=0.0)
    monkeypatch.setattr(plugin.time, "monotonic", lambda: now.seconds)
    return now


def test_time_left_does_not_count_what_came_before_the_first_job(clock, capsys):
    """A first run compiles for minutes; the jobs after that take ten seconds each."""
    settings = SimpleNamespace(stdout=True, dryrun=False, printshellcmds=False, verbose=False)
    handler = plugin.LogHandler(common_settings=settings, settings=None)
    handler.emit(SimpleNamespace(event=LogEvent.RUN_INFO, stats={"total": 20, "crumple": 20}))
    for done in range(1, 11):
        clock.seconds = 100.0 + 10.0 * done
        handler.emit(SimpleNamespace(event=LogEvent.JOB_FINISHED, job_id=done))
        handler.emit(SimpleNamespace(event=LogEvent.PROGRESS, done=done, total=20))
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1] == "[10/20] 3:20, about 1:40 left: job"
    assert not any("left" in line for line in lines[1:4])
