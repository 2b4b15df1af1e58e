"""Factored tangents, counted against a budget."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg import Factorisation, SolveError, factorise
from foilstudy.solve.continuation.equations import Equations


class StepFailed(Exception):
    """A step leads nowhere and has to be tried shorter; the text says why."""


class SingularTangent(StepFailed):
    """A tangent cannot be factored."""


class BudgetSpent(Exception):
    """No factorisations are left."""


@dataclass(frozen=True, eq=False)
class Tangent:
    """The linearised equations at a point.

    Attributes
    ----------
    matrix : csr_matrix, shape (n, n)
    factor : Factorisation
        Of the matrix.
    velocity : ndarray, shape (n,)
        Derivative of the unknowns by the factor along the path.
    """

    matrix: sparse.csr_matrix
    factor: Factorisation
    velocity: np.ndarray

    @property
    def negative_eigenvalues(self) -> int:
        """Of the matrix."""
        return self.factor.negative_eigenvalues


class Workshop:
    """Factors tangents until the budget is spent.

    Parameters
    ----------
    equations : Equations
    budget : int
        Factorisations at most.

    Attributes
    ----------
    equations : Equations
    spent : int
        Factorisations, tries on singular matrices included.
    """

    def __init__(self, equations: Equations, budget: int):
        self.equations, self._budget, self.spent = equations, budget, 0

    def tangent(self, q: np.ndarray, factor: float) -> Tangent:
        """Linearise and factor.

        Raises
        ------
        BudgetSpent
        SingularTangent
        StepFailed
            If the tangent is not finite.
        """
        if self.spent >= self._budget:
            raise BudgetSpent
        matrix, rate = self.equations.linearised(q, factor)
        if not (np.isfinite(matrix.data).all() and np.isfinite(rate).all()):
            raise StepFailed("the tangent is not finite")
        self.spent += 1
        try:
            factored = factorise(matrix)
            return Tangent(matrix, factored, -factored.solve(rate))
        except SolveError as error:
            raise SingularTangent(f"the tangent is singular ({error})") from error
