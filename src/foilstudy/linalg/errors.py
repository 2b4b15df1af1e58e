"""Failures of the linear algebra."""

import numpy as np


class SolveError(RuntimeError):
    """A factorisation failed or a solution does not satisfy its equations."""


class PerturbedPivot(SolveError):
    """A pivot vanished beside the largest entry of the matrix."""


def refuse_not_finite(values: np.ndarray, what: str) -> None:
    """Refuse numbers that are not finite before they reach native code, which may die of them.

    Parameters
    ----------
    values : ndarray
    what : str
        What they are, as a sentence begins.

    Raises
    ------
    SolveError
    """
    if not np.isfinite(values).all():
        count = np.size(values) - np.count_nonzero(np.isfinite(values))
        raise SolveError(f"{what} holds {count} numbers that are not finite")


def refuse_complex(rhs: np.ndarray, dtype: np.dtype) -> None:
    """Refuse a complex right-hand side of a real matrix, whose imaginary part would be lost.

    Raises
    ------
    TypeError
    """
    if np.iscomplexobj(rhs) and not np.issubdtype(dtype, np.complexfloating):
        raise TypeError("a real factorisation solves for real right-hand sides; give both parts.")
