"""Progress of a study in one line per finished job; Snakemake loads this by its package name.

    [ 17/52] 1:08, about 2:20 left: response t500um h170mm seed 3: axial 8.4, radial 25 N/mm

Snakemake's default is about twenty lines per job, which bury what a user wants to see; they are
still in the log file under ``.snakemake/log``. ``workflow/profiles/default`` selects this logger.
"""

from __future__ import annotations

import asyncio
import errno
import logging
import re
import signal
import sys
import threading
import time
from contextlib import suppress
from io import TextIOWrapper
from logging import WARNING, LogRecord
from pathlib import Path
from textwrap import shorten

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from .caches import place_for_caches

__all__ = ["LogHandler"]

LOG_LINES_SHOWN = 15
JOBS_BEFORE_ESTIMATE = 4
REASON_LENGTH = 80
PATIENCE_S = 0.05
"""After which an interrupt that came in the wrong moment comes again."""
# Messages without an event that a user wants to see all the same.
_WORTH_SHOWING = (
    "Accuracy",
    "Nothing to be done",
    "This was a dry-run",
    "Elapsed time",
    "Report created",
    "Report:",
    "Unlocked",
)
_STOPPED = "Stopped; the same command goes on where it stopped."
# The job's own line and log say more than the shell command that Snakemake quotes with these.
_SAID_BY_THE_JOB = ("CalledProcessError", "RuleException", "SpawnedJobError")
# A file that cannot be read or written is for the user to mend, and no traceback helps with it.
_FAULT_OF_A_FILE = re.compile(r"\[Errno (\d+)\] ([^:)\n]*)(?:: '(.*?)')?")
_REMEDIES = {
    errno.ENOSPC: "make room, then start the same command again",
    errno.EDQUOT: "make room, then start the same command again",
    errno.EEXIST: "remove what stands in its place, such as a link that leads nowhere",
    errno.ENOTDIR: "remove what stands in place of a folder",
}
_REMEDY = "check its path and permissions, then start the same command again"


class LogHandler(LogHandlerBase):
    """Writes what a study is doing to the terminal."""

    def __post_init__(self) -> None:
        # here, as every Snakemake of the environment imports this package to find its loggers
        from .configuration import refuse_unreadable_config

        refuse_unreadable_config()
        self._caches = place_for_caches()
        logging.raiseExceptions = False  # those of Snakemake's log file, on a full disk
        self._stream = sys.stdout if self.common_settings.stdout else sys.stderr
        if isinstance(self._stream, TextIOWrapper):
            # a terminal that lacks a character of a name shows its number
            self._stream.reconfigure(errors="backslashreplace")
        self._jobs: dict[int, tuple[str, list[str]]] = {}
        self._finished: list[int] = []
        self._started = time.monotonic()
        self._planned = False
        self._first_end: float | None = None
        self._stopping = False
        if threading.current_thread() is threading.main_thread():
            self._expect_ctrl_c()

    writes_to_stream = True
    writes_to_file = False
    # Only what emit() chooses is shown, so Snakemake's --quiet has nothing left to hide.
    has_filter = True
    has_formatter = True
    needs_rulegraph = False

    def emit(self, record: LogRecord) -> None:
        """Write the record, if it is one that a user follows."""
        if self._stopping:  # all that comes now is a consequence
            return
        event = getattr(record, "event", None)
        if event == LogEvent.RUN_INFO:
            self._write_plan(record.stats)
        elif event == LogEvent.JOB_INFO:
            self._note_job(record)
        elif event == LogEvent.JOB_FINISHED:
            self._finished.append(record.job_id)
        elif event == LogEvent.PROGRESS:
            self._write_finished(record.done, record.total)
        elif event == LogEvent.JOB_ERROR:
            self._write_failure(record)
        elif event == LogEvent.SHELLCMD and self.common_settings.printshellcmds:
            self._write(getattr(record, "shellcmd", None) or "")
        elif event == LogEvent.ERROR and record.exception in _SAID_BY_THE_JOB:
            return
        elif event == LogEvent.ERROR and (fault := _FAULT_OF_A_FILE.search(record.getMessage())):
            number, what, path = fault.groups()
            remedy = _REMEDIES.get(int(number), _REMEDY)
            self._write(f"{path or Path.cwd()}: {what.strip()}; {remedy}.")
        elif record.levelno >= WARNING or self.common_settings.verbose:
            self._write(record.getMessage())
        elif event is None and str(record.msg).startswith(_WORTH_SHOWING):
            self._write(record.getMessage())

    def _expect_ctrl_c(self) -> None:
        """Answer an interrupt with one line, whether Snakemake expects it at that moment or not."""
        interrupt, show = signal.getsignal(signal.SIGINT), sys.excepthook

        def stop(number, frame):
            if not self._stopping:
                self._write(_STOPPED)
                # it would print the tracebacks of what Snakemake was awaiting
                logging.getLogger("asyncio").setLevel(logging.CRITICAL + 1)
            self._stopping = True
            if _awaits_something():
                # there, an exception would leave Snakemake waiting for good
                main = threading.main_thread().ident
                timer = threading.Timer(PATIENCE_S, signal.pthread_kill, (main, number))
                timer.daemon = True
                timer.start()
                return None
            return interrupt(number, frame)

        def show_others(kind, error, traceback):
            if not (self._stopping and issubclass(kind, KeyboardInterrupt)):
                show(kind, error, traceback)

        if callable(interrupt):  # else a shell has this run ignore it
            signal.signal(signal.SIGINT, stop)
            sys.excepthook = show_others

    def _write(self, line: str) -> None:
        # The reader of a pipe may have seen enough; the study goes on.
        with suppress(BrokenPipeError):
            self._stream.write(line.rstrip() + "\n")
            self._stream.flush()

    def _write_plan(self, jobs_per_rule: dict[str, int]) -> None:
        # A dry-run sends the same plan before and after its jobs.
        if self._planned:
            return
        self._planned = True
        self._started = time.monotonic()
        counts = ", ".join(
            f"{count} {rule}" for rule, count in jobs_per_rule.items() if rule != "total"
        )
        self._write(f"{jobs_per_rule['total']} jobs: {counts}")

    def _note_job(self, record: LogRecord) -> None:
        name = record.rule_msg or record.rule_name
        self._jobs[record.jobid] = (name, record.log)
        if self.common_settings.dryrun:
            reason = shorten(record.reason, REASON_LENGTH, placeholder=" ...")
            self._write(f"would run {name}: {reason}")

    def _write_finished(self, done: int, total: int) -> None:
        elapsed = time.monotonic() - self._started
        # From the first job's end: compiling, before it, takes longer than most jobs together.
        if self._first_end is None:
            self._first_end, self._first_done = elapsed, done
        known = JOBS_BEFORE_ESTIMATE <= done < total and done > self._first_done
        per_job = (elapsed - self._first_end) / (done - self._first_done) if known else 0.0
        left = f", about {_clock(per_job * (total - done))} left" if known else ""
        for jobid in self._finished:
            name, logs = self._jobs.get(jobid, ("job", []))
            lines = _last_lines(logs, 1)
            outcome = f": {lines[0]}" if lines else ""
            count = f"[{done:{len(str(total))}d}/{total}]"
            self._write(f"{count} {_clock(elapsed)}{left}: {name}{outcome}")
        self._finished.clear()

    def _write_failure(self, record: LogRecord) -> None:
        name, logs = self._jobs.get(record.jobid, (record.rule_name, record.log))
        lines = _last_lines(logs, LOG_LINES_SHOWN)
        ends = "ends with:" if lines else "is empty, as it is where the disk is full."
        self._write(f"FAILED {name}; its log {', '.join(logs)} {ends}")
        for line in lines:
            self._write(f"    {line}")


def _awaits_something() -> bool:
    """Whether an event loop runs in this thread."""
    try:
        asyncio.get_running_loop()
    except RuntimeError:
        return False
    return True


def _clock(seconds: float) -> str:
    """Duration as m:ss or h:mm:ss."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{rest:02d}" if hours else f"{minutes}:{rest:02d}"


def _last_lines(logs: list[str], count: int) -> list[str]:
    """Last lines of a job's logs; nothing where a log was not written."""
    lines: list[str] = []
    for log in logs:
        try:
            lines += Path(log).read_text(encoding="utf-8", errors="replace").splitlines()
        except OSError:
            continue
    return lines[-count:]
