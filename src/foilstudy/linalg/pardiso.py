"""Symmetric indefinite factorisation through MKL Pardiso, called by its C interface.

One thread and a fixed code path, so that a result has the same bits in every run.
"""

from __future__ import annotations

import ctypes
import weakref
from dataclasses import dataclass
from functools import lru_cache
from importlib import metadata

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg.blocks import SymmetricBlocks
from foilstudy.linalg.errors import PerturbedPivot, SolveError, refuse_complex, refuse_not_finite

_SYMMETRIC_DEFINITE, _SYMMETRIC_INDEFINITE, _COMPLEX_SYMMETRIC = 2, -2, 6
_ANALYSE_AND_FACTOR, _FACTOR, _SOLVE, _RELEASE_FACTORS, _RELEASE = 12, 22, 33, 0, -1
_CBWR_AUTO = 2
"""Conditional numerical reproducibility: the fastest code of this machine, the same in every run.
Named instruction sets are refused on other processors than Intel's."""

_LAYER_LP64, _LAYER_INTEL = 0, 0
"""Integers of 32 bits, as the arrays below have; the threads that the `mkl` package brings."""


@lru_cache(maxsize=1)
def library():
    """The MKL runtime of the installed ``mkl`` package, or None."""
    try:
        files = metadata.files("mkl") or []
    except metadata.PackageNotFoundError:
        return None
    for file in files:
        if "mkl_rt" in file.name and not file.name.endswith(".lib"):
            try:
                library = ctypes.CDLL(str(file.locate()))
            except OSError:
                return None
            # before anything the user's shell asks for: a layer not installed ends the process
            library.MKL_Set_Interface_Layer(ctypes.c_int(_LAYER_LP64))
            library.MKL_Set_Threading_Layer(ctypes.c_int(_LAYER_INTEL))
            library.MKL_CBWR_Set(ctypes.c_int(_CBWR_AUTO))
            library.MKL_Set_Num_Threads(ctypes.c_int(1))
            library.pardiso.restype = None
            return library
    return None


def available() -> bool:
    """Whether an MKL runtime can be loaded."""
    return library() is not None


_NOT_DEFINITE = (-4, -13)
"""Codes of a pivot that is not positive."""
_POINTER = ctypes.c_void_p
_DTYPES = {
    _SYMMETRIC_DEFINITE: np.float64,
    _SYMMETRIC_INDEFINITE: np.float64,
    _COMPLEX_SYMMETRIC: np.complex128,
}


@dataclass(frozen=True, eq=False)
class _Pattern:
    """What the analysis of a matrix depends on: where its upper triangle has numbers, or blocks."""

    kind: int
    starts: np.ndarray
    columns: np.ndarray
    width: int = 1
    order: np.ndarray | None = None

    @property
    def rows(self) -> int:
        """Rows, or rows of blocks."""
        return len(self.starts) - 1

    def is_that_of(self, other: _Pattern) -> bool:
        """Whether an analysis of the other one serves this one."""
        return (
            (self.kind, self.width, self.rows) == (other.kind, other.width, other.rows)
            and np.array_equal(self.starts, other.starts)
            and np.array_equal(self.columns, other.columns)
            and np.array_equal(self.order, other.order)
        )


def _indexed(matrix: sparse.csr_matrix | SymmetricBlocks) -> tuple[_Pattern, np.ndarray]:
    """Pattern and values of the upper triangle, as Pardiso wants them."""
    if isinstance(matrix, SymmetricBlocks):
        where = matrix.pattern
        pattern = _Pattern(
            _SYMMETRIC_DEFINITE, where.starts, where.columns, matrix.width, where.order
        )
        return pattern, np.ascontiguousarray(matrix.values)
    upper = sparse.triu(matrix, format="csr")
    upper.sort_indices()
    kind = _COMPLEX_SYMMETRIC if np.iscomplexobj(upper) else _SYMMETRIC_INDEFINITE
    pattern = _Pattern(kind, upper.indptr.astype(np.int32), upper.indices.astype(np.int32))
    return pattern, np.ascontiguousarray(upper.data, dtype=_DTYPES[kind])


class _Job:
    """One Pardiso handle with the upper triangle it works on."""

    def __init__(self, pattern: _Pattern, values: np.ndarray):
        self.pattern, self.values = pattern, values
        self.size = pattern.rows * pattern.width
        self.failed = False
        self.handle = np.zeros(64, dtype=np.int64)
        self.settings = np.zeros(64, dtype=np.int32)
        # own settings; METIS ordering unless one is given; tiny pivots perturbed at 1e-8 of the
        # norm; 1x1 and 2x2 pivots; zero-based indices. Scaling and matching stay off: they cost
        # time and an elastic stiffness does not need them.
        self.settings[[0, 1, 9, 20, 34]] = 1, 2, 8, 1, 1
        if pattern.order is not None:
            self.settings[4] = 1
        if pattern.width > 1:
            self.settings[36] = pattern.width

    def run(self, phase: int, rhs: np.ndarray, solution: np.ndarray) -> int:
        """Run one phase and return Pardiso's error code."""
        pattern = self.pattern
        arrays = (self.handle, self.values, pattern.starts, pattern.columns, self.settings)
        handle, values, starts, columns, settings = (a.ctypes.data_as(_POINTER) for a in arrays)
        order = None if pattern.order is None else pattern.order.ctypes.data_as(_POINTER)
        count = 1 if rhs.ndim == 1 else rhs.shape[1]
        numbers = (1, 1, pattern.kind, phase, pattern.rows, count, 0)
        maxfct, mnum, mtype, stage, size, nrhs, quiet = (
            ctypes.byref(ctypes.c_int32(number)) for number in numbers
        )
        error = ctypes.c_int32(0)
        library().pardiso(
            handle, maxfct, mnum, mtype, stage, size, values, starts, columns, order, nrhs,
            settings, quiet, rhs.ctypes.data_as(_POINTER), solution.ctypes.data_as(_POINTER),
            ctypes.byref(error),
        )  # fmt: skip
        self.failed = self.failed or error.value != 0
        return error.value


_analysed: list[_Job] = []
"""Jobs whose factors are gone and whose analysis serves the next matrix of the same pattern."""
_KEPT = 4


def _job_for(matrix: sparse.csr_matrix | SymmetricBlocks) -> tuple[_Job, int]:
    """A job for a matrix, and the phase that factors it.

    The analysis (ordering, structure of the factors) costs as much as the factors of a small mesh
    and half of those of a large one. It depends on the pattern alone, and so do its bits.
    """
    pattern, values = _indexed(matrix)
    for old in tuple(_analysed):
        if old.pattern.is_that_of(pattern) and old in _analysed:
            _analysed.remove(old)
            old.values = values
            return old, _FACTOR
    return _Job(pattern, values), _ANALYSE_AND_FACTOR


def _give_back(job: _Job) -> None:
    """Keep the analysis of a job, without its factors, unless others have come since."""
    empty = np.zeros(1)
    if job.failed:
        job.run(_RELEASE, empty, empty)
        return
    job.run(_RELEASE_FACTORS, empty, empty)
    job.values = empty
    _analysed.append(job)
    if len(_analysed) > _KEPT:
        _analysed.pop(0).run(_RELEASE, empty, empty)


class PardisoFactorisation:
    """L D L^T factors with Bunch-Kaufman pivots; the signs of D give the inertia.

    Of a real or a complex symmetric matrix; the latter has no inertia. Blocks that are known to be
    positive definite get L L^T factors, without pivots, in the order that comes with them.
    """

    def __init__(self, matrix: sparse.csr_matrix | SymmetricBlocks):
        definite = isinstance(matrix, SymmetricBlocks)
        refuse_not_finite(matrix.values if definite else matrix.data, "the matrix")
        self._job, phase = _job_for(matrix)
        weakref.finalize(self, _give_back, self._job)
        self._run(phase, np.zeros(self._job.size, dtype=self._job.values.dtype))
        if self._job.settings[13] > 0:
            raise PerturbedPivot("the matrix is singular: Pardiso had to perturb a pivot")
        self.negative_eigenvalues = self._negative_eigenvalues()

    def _negative_eigenvalues(self) -> int | None:
        kind = self._job.pattern.kind
        if kind == _SYMMETRIC_DEFINITE:
            return 0
        return int(self._job.settings[22]) if kind == _SYMMETRIC_INDEFINITE else None

    def solve(self, rhs: np.ndarray) -> np.ndarray:
        """Solve for one or several right-hand sides, shape (n,) or (n, k)."""
        refuse_complex(rhs, self._job.values.dtype)
        refuse_not_finite(rhs, "the right-hand side")
        return self._run(_SOLVE, np.asfortranarray(rhs, dtype=self._job.values.dtype))

    def _run(self, phase: int, rhs: np.ndarray) -> np.ndarray:
        solution = np.empty_like(rhs)
        error = self._job.run(phase, rhs, solution)
        if error in _NOT_DEFINITE and self._job.pattern.kind == _SYMMETRIC_DEFINITE:
            raise SolveError("the matrix is not positive definite")  # either code, by chance
        if error != 0:
            raise SolveError(f"Pardiso ended phase {phase} with error {error}")
        return solution
