"""What a computation costs: time on the clock, time of the processor, memory."""

from __future__ import annotations

import resource
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path


@dataclass
class Cost:
    """Cost of a block of code, complete when `measured` has left it.

    Attributes
    ----------
    seconds : float
        On the clock.
    cpu_seconds : float
        Of the processor, which a full machine does not lengthen: user and system, all threads.
    peak_memory_mb : float
        Largest memory of the process meanwhile, what it held before included.
    """

    seconds: float = 0.0
    cpu_seconds: float = 0.0
    peak_memory_mb: float = 0.0

    def __add__(self, other: Cost) -> Cost:
        """Of one block after the other."""
        return Cost(
            self.seconds + other.seconds,
            self.cpu_seconds + other.cpu_seconds,
            max(self.peak_memory_mb, other.peak_memory_mb),
        )


_open: list[Cost] = []
"""Blocks being measured, outermost first."""


@contextmanager
def measured() -> Iterator[Cost]:
    """Measure the block; blocks may be nested.

    On Linux the memory is that of the block, also in a process that has done greater things
    before; elsewhere the system only tells the peak since the process started.
    """
    cost = Cost()
    _note_peak()
    _open.append(cost)
    with suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5")  # forget the peak
    clock, processor = time.perf_counter(), time.process_time()
    try:
        yield cost
    finally:
        cost.seconds = time.perf_counter() - clock
        cost.cpu_seconds = time.process_time() - processor
        _note_peak()
        _open.pop()


def _note_peak() -> None:
    """Take the peak so far into every open block, before it is forgotten."""
    peak = _remembered_mb()
    for cost in _open:
        cost.peak_memory_mb = max(cost.peak_memory_mb, peak)


def _remembered_mb() -> float:
    """Largest memory that the system remembers of this process, MB."""
    with suppress(OSError):
        for line in Path("/proc/self/status").read_text().splitlines():
            if line.startswith("VmHWM:"):
                return float(line.split()[1]) / 1024
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / 1024 if sys.platform != "darwin" else peak / 1024**2
