"""Symmetric factorisation through SciPy's SuperLU."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

from foilstudy.linalg.blocks import DefiniteBlocks
from foilstudy.linalg.errors import SolveError, refuse_complex, refuse_not_finite


class SuperLUFactorisation:
    """L U factors in symmetric mode; the signs of U's diagonal give the inertia.

    Of a real or a complex symmetric matrix; the latter has no inertia.
    """

    def __init__(self, matrix: sparse.csr_matrix | DefiniteBlocks):
        definite = isinstance(matrix, DefiniteBlocks)
        matrix = matrix.full() if definite else matrix
        refuse_not_finite(matrix.data, "the matrix")
        try:
            self._factor = splu(
                matrix.tocsc(),
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError as error:
            raise SolveError(f"the matrix cannot be factored: {error}") from error
        self._dtype = matrix.dtype
        self.negative_eigenvalues = None
        if not np.iscomplexobj(matrix):
            self.negative_eigenvalues = int(np.sum(self._factor.U.diagonal() < 0))
        if definite and self.negative_eigenvalues:
            raise SolveError(
                f"the matrix is not positive definite: {self.negative_eigenvalues} pivots are not"
            )

    def solve(self, rhs: np.ndarray) -> np.ndarray:
        """Solve for one or several right-hand sides."""
        refuse_complex(rhs, self._dtype)
        refuse_not_finite(rhs, "the right-hand side")
        return self._factor.solve(np.ascontiguousarray(rhs, dtype=self._dtype))
