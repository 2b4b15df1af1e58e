"""Time and memory of the processing of a long recording.

    .venv/bin/python benchmarks/signals.py        the figures of docs/bench.md, half a minute

60 s at 50 kHz, written to disk first: spectra of 12 channels, and the whole way to a stiffness from
all 21 of the virtual rig. Each way in a process of its own, one thread, with reading of the file.
"""

from __future__ import annotations

import multiprocessing
import os
import resource
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

for variable in ("OMP", "MKL", "OPENBLAS"):
    os.environ[f"{variable}_NUM_THREADS"] = "1"

from foilstudy.bench.estimation.best_linear import best_linear, measured_lines  # noqa: E402
from foilstudy.bench.estimation.periods import Periods, period_means  # noqa: E402
from foilstudy.bench.estimation.procedure import Published  # noqa: E402
from foilstudy.bench.estimation.spectra import Blocks, averaged  # noqa: E402
from foilstudy.bench.estimation.static import Static  # noqa: E402
from foilstudy.bench.recording import open_recording, write_recording  # noqa: E402
from foilstudy.bench.rig.measurement import Measurement, measured  # noqa: E402
from foilstudy.bench.rig.rig import Rig  # noqa: E402
from foilstudy.bench.rig.specimens.spring import Spring  # noqa: E402
from foilstudy.bench.signals.multisine import Multisine  # noqa: E402

GAP_M, STIFFNESS = 0.13, 2000.0
FORCE = Multisine(0.0, 150.0, rms=5.0, period_s=8.0)
RATE_HZ, SECONDS, CHANNELS, HIGHEST_HZ = 50e3, 60.0, 12, 500.0
LIMIT_S, LIMIT_GB = 5.0, 1.0


@dataclass(frozen=True)
class Cost:
    """Of one way of processing.

    Attributes
    ----------
    processor_s, wall_s : float
    memory_gb : float
        Largest resident set, Python with its libraries included.
    stiffness : float
        What was read, N/m.
    """

    processor_s: float
    wall_s: float
    memory_gb: float
    stiffness: float

    @property
    def kept(self) -> bool:
        """Whether it is within the limits."""
        return self.processor_s < LIMIT_S and self.memory_gb < LIMIT_GB


def recorded(path: Path, channels: int | None = None) -> None:
    """Write a virtual measurement with all its channels, or with the first of them."""
    link = Spring(axial=STIFFNESS, radial=2000.0, rocking=50.0, torsion=50.0, gap_m=GAP_M)
    made = measured(Rig(link, GAP_M), FORCE.signal(), RATE_HZ, SECONDS)
    kept = slice(channels)
    write_recording(
        Measurement(
            made.channels[kept], RATE_HZ, made.samples, made.period[kept], made.noise[kept], 0
        ),
        path,
    )


def published(path: Path) -> float:
    """Blocks of 2 s, all of the published procedure, N/m."""
    with open_recording(path) as run:
        return Static.of(Published().estimate([run], 2, GAP_M)).value


def by_periods(path: Path) -> float:
    """Whole periods and the best linear approximation, N/m."""
    with open_recording(path) as run:
        lines = measured_lines(run, Periods(FORCE.period_s), 2, GAP_M, HIGHEST_HZ)
        return Static.of(best_linear([lines], FORCE.signal().lines).estimate).value


def spectra(path: Path) -> float:
    """Auto and cross spectra of all channels by blocks, without more; no stiffness."""
    with open_recording(path) as run:
        averaged(run, Blocks(), HIGHEST_HZ)
    return float("nan")


def means(path: Path) -> float:
    """Mean and covariance of the lines of all channels by periods; no stiffness."""
    with open_recording(path) as run:
        period_means(run, Periods(FORCE.period_s), HIGHEST_HZ)
    return float("nan")


def cost(way: Callable[[Path], float], path: Path) -> Cost:
    """Of one way, in a process of its own."""
    context = multiprocessing.get_context("spawn")
    with context.Pool(1) as pool:
        return pool.apply(_measured, (way, path))


def _measured(way: Callable[[Path], float], path: Path) -> Cost:
    start, wall = time.process_time(), time.perf_counter()
    stiffness = way(path)
    used = time.process_time() - start, time.perf_counter() - wall
    unit = 1 if sys.platform == "darwin" else 1024
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit / 1e9
    return Cost(*used, peak, stiffness)


def main() -> int:
    """Print the table; 1 if a limit is not kept."""
    print("| channels | processing | processor | wall | memory | read of 2000 N/m |")
    print("|---|---|---|---|---|---|")
    kept = True
    with tempfile.TemporaryDirectory() as folder:
        for channels, ways in ((CHANNELS, (spectra, means)), (None, (published, by_periods))):
            path = Path(folder, "run.nc")
            recorded(path, channels)
            with open_recording(path) as run:
                count = len(run.channels)
            for way in ways:
                found = cost(way, path)
                kept &= found.kept
                read = f"{found.stiffness:.0f} N/m" if found.stiffness == found.stiffness else ""
                print(
                    f"| {count} | {way.__name__.replace('_', ' ')} | {found.processor_s:.1f} s | "
                    f"{found.wall_s:.1f} s | {found.memory_gb:.2f} GB | {read} |",
                    flush=True,
                )
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main())
