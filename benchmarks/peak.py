"""What this machine can do at most: operations, and bytes to and from every level of its memory."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from measuring import timed
from numba import njit

_CACHES = Path("/sys/devices/system/cpu/cpu0/cache")
_ROUNDS = 200
_MOVED = 1_000_000
"""Numbers that are moved at once at least, beside which the call costs nothing."""
_CHAIN = 16
"""Multiply-adds that depend on each other, as many as stand in `_multiply_adds`."""
_VALUES = 512
"""In its chains side by side: they lie in the first cache, and no unit waits for a result."""
_MATRIX = 768
_BEYOND = 4
"""Size of what is moved in memory over that of the last cache."""
MEMORY = "memory"


@njit(fastmath={"contract"})
def _multiply_adds(values, x, y, rounds):
    for _ in range(rounds):
        for k in range(values.size):
            a = values[k]
            a = a * x + y
            a = a * x + y
            a = a * x + y
            a = a * x + y
            a = a * x + y
            a = a * x + y
            a = a * x + y
            a = a * x + y
            a = a * x + y
            a = a * x + y
            a = a * x + y
            a = a * x + y
            a = a * x + y
            a = a * x + y
            a = a * x + y
            a = a * x + y
            values[k] = a


@njit(fastmath={"contract"})
def _triad(a, b, c, factor, rounds):
    for _ in range(rounds):
        for k in range(a.size):
            a[k] = b[k] + factor * c[k]


@dataclass(frozen=True)
class Limit:
    """Something that a machine does as fast as it can.

    Attributes
    ----------
    call : callable
    amount : float
        Operations or bytes of one call.
    """

    call: Callable[[], object]
    amount: float

    def speed(self, seconds: float) -> float:
        """Operations or bytes in a second, if a call takes so many seconds."""
        return self.amount / seconds


def multiply_adds() -> Limit:
    """Operations of a compiled loop of multiply-adds, two each."""
    values = np.ones(_VALUES)
    _multiply_adds(values, 0.999, 0.001, 1)
    return Limit(
        lambda: _multiply_adds(values, 0.999, 0.001, _ROUNDS), _ROUNDS * _VALUES * 2 * _CHAIN
    )


def matrix_product() -> Limit:
    """Operations of a matrix product by the library of numpy, which may use wider vectors."""
    matrix = np.random.default_rng(0).standard_normal((_MATRIX, _MATRIX))
    return Limit(lambda: matrix @ matrix, 2 * _MATRIX**3)


def triad(span: float) -> Limit:
    """Bytes of a = b + s c, 24 a number, with arrays that together take so many bytes."""
    a, b, c = (np.full(int(span / 24), value) for value in (0.0, 1.0, 2.0))
    rounds = 1 + _MOVED // a.size
    return Limit(lambda: _triad(a, b, c, 0.5, rounds), 24 * rounds * a.size)


@dataclass(frozen=True)
class Machine:
    """Measured limits, one core, double precision.

    Attributes
    ----------
    flops : float
        By `multiply_adds`, 1/s.
    vector_bits : int
        Width of the vectors which numba gives that loop, and so the kernels.
    product_flops : float
        By `matrix_product`, 1/s.
    sizes : dict of str to float
        Bytes of every cache, smallest first.
    bandwidths : dict of str to float
        By cache and memory, B/s.
    """

    flops: float
    vector_bits: int
    product_flops: float
    sizes: dict[str, float]
    bandwidths: dict[str, float]

    @property
    def peak(self) -> float:
        """The most operations that were reached, 1/s."""
        return max(self.flops, self.product_flops)

    def level_of(self, size: float) -> str:
        """The smallest cache that holds so many bytes, or memory."""
        return next((name for name, cache in self.sizes.items() if size <= cache), MEMORY)


def measured_machine(budget: float) -> Machine:
    """Measure this machine, so many seconds for each limit; the best of many tries counts."""
    sizes = cache_sizes(_CACHES)
    flops, product, *bandwidths = (
        limit.speed(timed(limit.call, budget).least)
        for limit in (
            multiply_adds(),
            matrix_product(),
            *(triad(span) for span in spans(sizes).values()),
        )
    )
    names = [*sizes, MEMORY]
    return Machine(flops, vector_bits(), product, sizes, dict(zip(names, bandwidths, strict=True)))


def spans(sizes: dict[str, float]) -> dict[str, float]:
    """Bytes by which every level is measured: well inside it, and well outside the one before."""
    edges = [*sizes.values(), _BEYOND**2 * max(sizes.values())]
    between = [float(np.sqrt(a * b)) for a, b in zip(edges, edges[1:])]
    return dict(zip([*sizes, MEMORY], [edges[0] / 2, *between], strict=True))


def vector_bits() -> int:
    """Width of the vectors in the compiled loop of multiply-adds; 64 where it is not vectorised."""
    _multiply_adds(np.ones(1), 1.0, 1.0, 1)
    (code,) = _multiply_adds.inspect_asm().values()
    widths = {"zmm": 512, "ymm": 256, "xmm": 128}
    for register, bits in widths.items():
        if re.search(rf"vfm\w+pd.*{register}", code):
            return bits
    return 128 if re.search(r"fmla\s+v\d+\.2d", code) else 64


def cache_sizes(folder: Path) -> dict[str, float]:
    """Bytes of the caches for data by name, as Linux tells them for one core.

    Raises
    ------
    SystemExit
        If it tells none.
    """
    found = {}
    for index in sorted(folder.glob("index*")):
        kind, level, size = ((index / name).read_text().strip() for name in
                             ("type", "level", "size"))  # fmt: skip
        if kind != "Instruction":
            found[f"L{level}"] = float(size[:-1]) * {"K": 2**10, "M": 2**20}[size[-1]]
    if not found:
        raise SystemExit(f"{folder}: does not tell the caches; measure on a Linux machine.")
    return found
