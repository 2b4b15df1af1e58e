"""What `benchmarks/kernel.py` counts and writes, without its times."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from numba import njit
from synthetic import make_cube, write_cube

from foilstudy.model.patch import Patch
from foilstudy.model.shell.elements import corner_kernel

sys.path.append(str(Path(__file__).parents[1] / "benchmarks"))

import kernel  # noqa: E402
import measuring  # noqa: E402
import operations  # noqa: E402
import peak  # noqa: E402
import picture  # noqa: E402

# --- operations ----------------------------------------------------------------------------------


@njit
def _dot(x, y):
    total = 0.0
    for k in range(x.size):
        total += x[k] * y[k]
    return total


@njit
def _toy(x, out, blocks):
    """Two sums of a row, an inverse and what is written twice."""
    scale = 1.0 / blocks
    for j in range(x.shape[0]):
        row = x[j]
        last = x.shape[1] - 2 * blocks
        for k in range(last):
            a = row[k] + row[k + 1]
            out[j, k] = scale * (row[k] + row[k + 1]) - a * (row[k + 1] + row[k])
            out[j, k] += -a
        out[j, 0] = _dot(row, row)


def test_operations_are_those_that_run():
    rows, columns, blocks = 3, 12, 2
    x = np.ones((rows, columns))
    counts = operations.operations(_toy, x, x.copy(), blocks)
    inner = rows * (columns - 2 * blocks)
    # a, the difference of two products, the sum with -a; both products; the inverse once
    assert counts["_toy"] == operations.Operations(3 * inner, 2 * inner, 1)
    assert counts["_dot"] == operations.Operations(rows * columns, rows * columns, 0)


def test_what_has_been_assigned_anew_is_another_value():
    @njit
    def twice(x, y):
        for k in range(x.size):
            a = x[k]
            first = a * a
            a = y[k]
            x[k] = first + a * a

    counts = operations.operations(twice, np.ones(5), np.ones(5))
    assert counts["twice"] == operations.Operations(5, 10, 0)


@njit
def _doubtful(x):
    if x[0] > 0:
        x[0] *= 2.0


@njit
def _endless(x, bound):
    for k in range(int(bound)):
        x[k] *= 2.0


@njit
def _power(x):
    x[0] = x[1] ** 3


@pytest.mark.parametrize(
    ("function", "arguments", "words"),
    [
        (_doubtful, (), "cannot count 'if x"),
        (_endless, (2.5,), "a loop over k of unknown length"),
        (_power, (), r"cannot count 'x\[1\] \*\* 3'"),
    ],
)
def test_what_cannot_be_counted_is_refused(function, arguments, words):
    with pytest.raises(NotImplementedError, match=words):
        operations.operations(function, np.ones(2), *arguments)


def test_the_force_kernel_on_full_chunks():
    """A place of the bending stage has 238 operations; compiled loops have as many."""
    lanes, steps = corner_kernel.LANES, corner_kernel.STEPS
    along = 40
    patch = Patch(2 * lanes * steps, along, 1e-3, 1e-3)
    counts = kernel.counted(patch)
    bend = counts["bend"]
    assert bend.total == pytest.approx(238, abs=0.1)
    assert bend.divisions == pytest.approx(1)
    # vertices of the last row and of the end of every chunk are swept beyond the elements
    vertices = counts["vertices"].total / (1 + 1 / along) / (1 + 1 / steps)
    assert vertices == pytest.approx(82, abs=0.1)
    assert kernel.counted_total(patch) == pytest.approx(560, rel=0.03)


# --- bytes ---------------------------------------------------------------------------------------


def test_bytes_as_laid_out_are_those_of_the_packed_data():
    lanes, steps = corner_kernel.LANES, corner_kernel.STEPS
    patch = Patch(2 * lanes * steps, 40, 1e-3, 1e-3)
    packed = 2 * (patch.elements_along + 1) * corner_kernel.VALUES * (steps + 1) * lanes
    points = 12 * patch.rows * patch.columns
    elements = patch.elements_around * patch.elements_along
    assert kernel.touched_bytes(patch) == pytest.approx(8 * (packed + points) / elements)
    assert kernel.needed_bytes() == 8 * 29 < kernel.touched_bytes(patch)


def test_caches_are_read_and_measured_well_inside(tmp_path):
    sizes = (("Data", 1, "48K"), ("Instruction", 1, "32K"), ("Unified", 2, "2048K"),
             ("Unified", 3, "30M"))  # fmt: skip
    for index, (kind, level, size) in enumerate(sizes):
        folder = tmp_path / f"index{index}"
        folder.mkdir()
        for name, word in (("type", kind), ("level", level), ("size", size)):
            (folder / name).write_text(f"{word}\n")
    found = peak.cache_sizes(tmp_path)
    assert found == {"L1": 48 * 2**10, "L2": 2**21, "L3": 30 * 2**20}
    machine = peak.Machine(2.0, 256, 1.0, found, {})
    spans = peak.spans(found)
    assert [machine.level_of(span) for span in spans.values()] == list(spans)
    assert list(spans) == ["L1", "L2", "L3", "memory"]
    assert machine.peak == 2.0
    with pytest.raises(SystemExit, match="does not tell the caches"):
        peak.cache_sizes(tmp_path / "none")


# --- physics -------------------------------------------------------------------------------------


def test_the_share_of_physics_is_of_the_jobs_of_the_study(tmp_path):
    cube = make_cube()
    write_cube(cube, tmp_path / "cube.nc")
    with pytest.raises(SystemExit, match="has no tables of jobs"):
        measuring.physics_share(tmp_path)
    physics = sum(
        float(cube[f"seconds_{stage}"].sum()) for stage in ("crumple", "static", "dynamic")
    )
    (tmp_path / "benchmarks").mkdir()
    table = f"s\th:m:s\tmax_rss\tcpu_time\n{2 * physics}\t0:00:00\t-\t-\n"
    (tmp_path / "benchmarks" / "cube.tsv").write_text(table)
    share = measuring.physics_share(tmp_path)
    assert share.physics == pytest.approx(physics)
    assert str(share).startswith("50% (")


# --- page ----------------------------------------------------------------------------------------


def test_a_section_replaces_its_own_and_no_other():
    page = "# Measured\n\n## One\n\nfirst\n\n### Part\n\n## Two\n\nsecond\n"
    assert measuring.with_section(page, "One", "new\n") == (
        "# Measured\n\n## One\n\nnew\n\n## Two\n\nsecond\n"
    )
    assert measuring.with_section(page, "Three", "new").endswith("second\n\n## Three\n\nnew\n")
    assert measuring.with_section("# Measured\n", "One", "new") == "# Measured\n\n## One\n\nnew\n"


def test_times_are_median_and_least_of_calls_in_turns():
    called = []
    times = measuring.timed_in_turns(
        {name: lambda name=name: called.append(name) or sum(range(100_000)) for name in "ab"}, 0.0
    )
    assert times.keys() == {"a", "b"}
    assert all(0 < each.least <= each.median for each in times.values())
    assert called.count("a") >= measuring.REPEATS
    halved = measuring.Timed(4.0, 2.0).per(2)
    assert (halved.median, halved.least) == (2.0, 1.0)


def test_tables_say_times_ratios_and_shares():
    patch = Patch(126, 34, 5e-3, 5e-3)

    class Case:
        def __str__(self):
            return "5 mm"

    times = {
        kernel.FORCE: measuring.Timed(50e-9, 40e-9),
        kernel.DOUBLE: measuring.Timed(20e-9, 19e-9),
        kernel.SINGLE: measuring.Timed(10e-9, 9e-9),
        kernel.STEP: measuring.Timed(100e-9, 80e-9),
    }
    tangent = dict.fromkeys(
        (kernel.ASSEMBLED, kernel.FACTORISED, kernel.SOLVED), measuring.Timed(3e-6, 2.5e-6)
    )
    point = picture.Point("5 mm", "L2", 580.0, 232.0, 11.6e9, 14.5e9)
    shares = kernel.Shares(0.2, 0.3, 0.05)
    mesh = kernel.Measured(Case(), times, shares, 12096, tangent, point)
    steps, unknowns = kernel.time_tables([mesh])
    assert "| force kernel | 50 (40) |" in steps
    assert "| step less force and mass solve | 30 |" in steps
    assert "| force kernel of the step | 50% |" in steps
    assert "| mass solve, single of double | 50% |" in steps
    assert "| factorised | 3 (2.5) |" in unknowns
    table = kernel.share_table([mesh])
    assert "| operations per byte | 2.50 |" in table
    assert "| GB/s | 4.6 |" in table
    assert "| share of the machine's peak | 20% |" in table
    counts = kernel.count_table(patch)
    rows = [line.split("|")[1:-1] for line in counts.splitlines()[2:]]
    totals = {name.strip(): float(total) for name, *_, total in rows}
    assert totals.pop("all") == pytest.approx(sum(totals.values()), abs=1)


def test_the_picture_is_drawn(tmp_path):
    limits = peak.Machine(35e9, 256, 60e9, {"L2": 2**21}, {"L2": 78e9, "memory": 11e9})
    point = picture.Point("5 mm", "L2", 580.0, 232.0, 11.6e9, 14.5e9)
    picture.draw([point], limits, tmp_path / "roofline.png")
    assert (tmp_path / "roofline.png").stat().st_size > 10_000
