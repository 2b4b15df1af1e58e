"""What the scripts of this folder share: one thread, times, shares of physics, their page.

Imported before anything that starts threads.
"""

from __future__ import annotations

import os

for variable in ("OMP", "MKL", "OPENBLAS", "NUMBA"):
    os.environ[f"{variable}_NUM_THREADS"] = "1"

import re  # noqa: E402
import statistics  # noqa: E402
import time  # noqa: E402
from collections.abc import Callable, Mapping  # noqa: E402
from dataclasses import dataclass  # noqa: E402
from pathlib import Path  # noqa: E402

from foilstudy.present.files import StudyFiles  # noqa: E402
from foilstudy.present.report.health import assess  # noqa: E402

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "benchmarks" / "results.md"
REPEATS = 7
"""Fewest of a time."""
_REPEATS_MOST = 200
_BATCH = 2e-3
"""Least time that is measured at once, s; shorter calls are repeated."""


@dataclass(frozen=True)
class Timed:
    """Processor time of one call, s: the median of many, and the least, which nothing disturbed."""

    median: float
    least: float

    def per(self, number: float) -> Timed:
        """Both over a number, of elements for example."""
        return Timed(self.median / number, self.least / number)


def timed(call: Callable[[], object], budget: float = 0.0) -> Timed:
    """Processor time of a call, repeated for so many seconds, but `REPEATS` times at least."""
    (found,) = timed_in_turns({"": call}, budget).values()
    return found


def timed_in_turns(calls: Mapping[str, Callable[[], object]], budget: float) -> dict[str, Timed]:
    """The same of several calls, one after the other in every turn.

    The pace of a machine drifts by half with what else runs on it: what is compared has to be
    measured in the same seconds. The budget is for each call.
    """
    inner, turn = {}, 0.0
    for name, call in calls.items():
        _seconds(call, 1)  # loads and compiles, and is not counted
        once = _seconds(call, 1)
        inner[name] = 1 + int(_BATCH / max(once, 1e-7)) if once < _BATCH else 1
        turn += once * inner[name]
    turns = int(min(max(budget * len(calls) / turn, REPEATS), _REPEATS_MOST))
    times = {name: [] for name in calls}
    for _ in range(turns):
        for name, call in calls.items():
            times[name].append(_seconds(call, inner[name]))
    return {name: Timed(statistics.median(each), min(each)) for name, each in times.items()}


def _seconds(call: Callable[[], object], inner: int) -> float:
    start = time.process_time()
    for _ in range(inner):
        call()
    return (time.process_time() - start) / inner


@dataclass(frozen=True)
class PhysicsShare:
    """How much of the time of its jobs a study has spent on physics, both in s on the clock."""

    physics: float
    jobs: float

    def __str__(self) -> str:
        return f"{self.physics / self.jobs:.0%} ({self.physics:.0f} of {self.jobs:.0f} s)"


def physics_share(folder: Path) -> PhysicsShare:
    """Of a finished study, by the stages in its cube and the workflow's tables of its jobs.

    A job runs on one core; what Snakemake itself takes is in no table.

    Raises
    ------
    SystemExit
        If the folder has no such tables.
    """
    files = StudyFiles(folder / "cube.nc")
    health = assess(files.cube, files.benchmarks)
    if not health.jobs:
        raise SystemExit(f"{files.benchmarks}: has no tables of jobs; run the study here.")
    return PhysicsShare(
        sum(cost.total_s for cost in health.costs), sum(job["wall_s"] for job in health.jobs)
    )


def write_section(title: str, body: str) -> None:
    """Put a section on the page of measured results, in place of an earlier one; print it."""
    page = PAGE.read_text("utf-8") if PAGE.exists() else "# Measured\n"
    PAGE.write_text(with_section(page, title, body), encoding="utf-8")
    print(body)


def with_section(page: str, title: str, body: str) -> str:
    """A page whose section of a title, to the next of its rank, has a body; added at the end."""
    first, *sections = re.split(r"^## ", page, flags=re.MULTILINE)
    new = f"{title}\n\n{body.strip()}\n"
    titles = [section.partition("\n")[0] for section in sections]
    if title in titles:
        sections[titles.index(title)] = new
    else:
        sections.append(new)
    return "\n\n## ".join(part.strip() for part in (first, *sections)) + "\n"
