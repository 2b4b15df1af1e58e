"""Real Fourier transforms along the rows of arrays of one shape, by MKL or SciPy."""

from __future__ import annotations

import ctypes
import weakref
from typing import Protocol

import numpy as np
import scipy.fft

from foilstudy.linalg.pardiso import library

__all__ = ["RowTransform", "row_transform"]

_ALIGNMENT = 64  # bytes, for the same bits in every run

# Constants of MKL's mkl_dfti.h.
_REAL_DOMAIN = 33
_NUMBER_OF_TRANSFORMS, _CONJUGATE_EVEN_STORAGE, _PLACEMENT = 7, 10, 11
_INPUT_DISTANCE, _OUTPUT_DISTANCE = 14, 15
_COMPLEX_STORAGE, _NOT_IN_PLACE = 39, 44


class RowTransform(Protocol):
    """A transform with its own arrays, one of them to be filled by the caller.

    Attributes
    ----------
    real : ndarray, shape (..., n)
    spectrum : ndarray, shape (..., n // 2 + 1), complex
    """

    real: np.ndarray
    spectrum: np.ndarray

    def forward(self) -> None:
        """From `real` to `spectrum`."""
        ...

    def backward(self) -> None:
        """From `spectrum`, which it may spoil, to `real`: n times the inverse of `forward`."""
        ...


def row_transform(shape: tuple[int, ...], single: bool) -> RowTransform:
    """The fastest at hand for arrays of a shape, in single or double precision."""
    return (_Scipy if library() is None else _Mkl)(shape, single)


class _Scipy:
    def __init__(self, shape: tuple[int, ...], single: bool):
        waves = (*shape[:-1], shape[-1] // 2 + 1)
        self.real = _aligned(shape, np.float32 if single else np.float64)
        self.spectrum = _aligned(waves, np.complex64 if single else np.complex128)

    def forward(self) -> None:
        self.spectrum[:] = scipy.fft.rfft(self.real, axis=-1)

    def backward(self) -> None:
        n = self.real.shape[-1]
        self.real[:] = scipy.fft.irfft(self.spectrum, n, axis=-1, norm="forward")


class _Mkl(_Scipy):
    """Twice to five times as fast."""

    def __init__(self, shape: tuple[int, ...], single: bool):
        super().__init__(shape, single)
        library_, n, waves = library(), shape[-1], shape[-1] // 2 + 1
        create = (
            library_.DftiCreateDescriptor_s_1d if single else library_.DftiCreateDescriptor_d_1d
        )
        count = self.real.size // n
        self._handles = []
        for distances in ((n, waves), (waves, n)):
            handle = ctypes.c_void_p()
            _done(create(ctypes.byref(handle), ctypes.c_int(_REAL_DOMAIN), ctypes.c_long(n)))
            weakref.finalize(self, _free, handle)
            for name, value in (
                (_PLACEMENT, ctypes.c_int(_NOT_IN_PLACE)),
                (_CONJUGATE_EVEN_STORAGE, ctypes.c_int(_COMPLEX_STORAGE)),
                (_NUMBER_OF_TRANSFORMS, ctypes.c_long(count)),
                (_INPUT_DISTANCE, ctypes.c_long(distances[0])),
                (_OUTPUT_DISTANCE, ctypes.c_long(distances[1])),
            ):
                _done(library_.DftiSetValue(handle, ctypes.c_int(name), value))
            _done(library_.DftiCommitDescriptor(handle))
            self._handles.append(handle)
        arrays = (self.real, self.spectrum)
        self._real, self._spectrum = (ctypes.c_void_p(a.ctypes.data) for a in arrays)
        self._compute_forward = library_.DftiComputeForward
        self._compute_backward = library_.DftiComputeBackward

    def forward(self) -> None:
        _done(self._compute_forward(self._handles[0], self._real, self._spectrum))

    def backward(self) -> None:
        _done(self._compute_backward(self._handles[1], self._spectrum, self._real))


def _done(status: int) -> None:
    if status:
        raise RuntimeError(f"the Fourier transform of MKL failed with status {status}")


def _free(handle: ctypes.c_void_p) -> None:
    library().DftiFreeDescriptor(ctypes.byref(handle))


def _aligned(shape: tuple[int, ...], dtype: type) -> np.ndarray:
    size = int(np.prod(shape)) * np.dtype(dtype).itemsize
    raw = np.zeros(size + _ALIGNMENT, np.uint8)
    start = -raw.ctypes.data % _ALIGNMENT
    return raw[start : start + size].view(dtype).reshape(shape)
