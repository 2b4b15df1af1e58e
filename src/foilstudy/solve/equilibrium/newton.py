"""Minimum of a potential with many snaps and a sparse Hessian, by quasi-Newton steps.

Each iteration factors H + s M once, with a shift s >= 0 along a fixed metric M that makes it
positive definite, which the factorisation counts (Nocedal and Wright, Numerical Optimization, 2nd
ed., section 3.4), and then takes many steps with it: the limited-memory BFGS formula (ibid.,
algorithm 7.4) corrects its inverse. For a shell a factorisation costs as much as thirty solutions,
and its potential is a curved valley along which Newton steps have to be short whatever their
direction, so that many cheap steps get further than few exact ones. Equilibria that are saddles
are left along the lowest eigenvector: what counts as converged is a minimum.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import scipy.sparse as sparse
from scipy.linalg import eigh
from scipy.sparse.linalg import ArpackError, LinearOperator, eigsh

from foilstudy.linalg import Factorisation, SolveError, SymmetricBlocks, factorise
from foilstudy.solve.equilibrium.quasi_newton import InverseHessian
from foilstudy.solve.residual import relative_residual

Hessian = sparse.csr_matrix | SymmetricBlocks


class Potential(Protocol):
    """A twice differentiable function of n unknowns."""

    def value_and_gradient(self, q: np.ndarray) -> tuple[float, np.ndarray]:
        """Value and gradient (n,); where one is not finite, q is out of bounds."""
        ...

    def hessian(self, q: np.ndarray) -> Hessian:
        """Symmetric (n, n), both triangles stored; or in blocks."""
        ...


@dataclass(frozen=True)
class NewtonOptions:
    """When to stop, and what to measure by.

    Attributes
    ----------
    residual_tolerance : float
        Largest accepted |gradient| / scale.
    scale : float or callable
        Of the gradient; a callable gets q.
    iterations_max : int
        Hessians formed at most.
    steps_per_factorisation : int
        Quasi-Newton steps at most before the Hessian is formed anew; 1 is Newton's method.
    metric : csr_matrix, optional
        Positive definite M of the shift, (n, n), of any size (it is scaled to the Hessian at the
        start). Default: the identity.
    stop_at_saddle : bool
        Whether to end, a step along the lowest eigenvector lower, where the first Hessian is
        indefinite, and leave the way down from there to who is faster on long ways.
    """

    residual_tolerance: float = 1e-8
    scale: float | Callable[[np.ndarray], float] = 1.0
    iterations_max: int = 100
    steps_per_factorisation: int = 40
    metric: sparse.csr_matrix | None = None
    stop_at_saddle: bool = False

    def residual(self, q: np.ndarray, gradient: np.ndarray) -> float:
        """Relative residual."""
        scale = self.scale(q) if callable(self.scale) else self.scale
        return relative_residual(float(np.linalg.norm(gradient)), scale)


@dataclass(frozen=True)
class NewtonResult:
    """Outcome of a minimisation.

    Attributes
    ----------
    status : str
        ``converged`` (residual met, no negative eigenvalue), ``not_converged`` (iterations used
        up), ``stalled`` (no step lowers the potential any more, or no minimum to be seen) or
        ``saddle`` (see `NewtonOptions.stop_at_saddle`).
    message : str
        One sentence on the status.
    q : ndarray, shape (n,)
        Last unknowns; never a point of higher potential than the start.
    residual : float
        Relative residual there.
    iterations, steps : int
        Hessians formed before the last point, and steps made with them.
    negative_eigenvalues : int or None
        Of the Hessian at q; None where it is singular or was not counted.
    """

    status: str
    message: str
    q: np.ndarray
    residual: float
    iterations: int
    steps: int
    negative_eigenvalues: int | None


_SHIFT_MIN, _SHIFT_MAX = 1e-6, 1e4
"""Range of a shift that is not zero, relative to the mean diagonal of the Hessian."""
_GROW = 6.0
_SUFFICIENT = 1e-4
"""Reduction over step times slope of an accepted step (Armijo's rule)."""
_ROUNDING = 1e-9
"""Reduction relative to the potential below which the gradients measure it better."""
_TRIALS = 8
_DENSE = 20
"""Unknowns up to which eigenvectors are sought by dense algebra."""


@dataclass(frozen=True)
class _Point:
    q: np.ndarray
    value: float
    gradient: np.ndarray


class _Stalled(Exception):
    """The search cannot go on; the text says why."""


class _AtSaddle(Exception):
    """The first Hessian is indefinite."""


def minimise(
    potential: Potential, start: np.ndarray, options: NewtonOptions | None = None
) -> NewtonResult:
    """Minimise a potential from any start.

    Parameters
    ----------
    potential : Potential
    start : ndarray, shape (n,)
    options : NewtonOptions, optional

    Raises
    ------
    ValueError
        If the potential is not finite at the start.
    """
    return _Search(potential, start, options or NewtonOptions()).run()


class _Search:
    """State of one minimisation: the current point, the shift and the size of the potential."""

    def __init__(self, potential: Potential, start: np.ndarray, options: NewtonOptions):
        self._potential, self._options = potential, options
        self._shift = 0.0
        self._metric: sparse.csr_matrix | None = None
        self._size = 0.0
        self._steps = 0
        self._point = self._evaluate(np.array(start, dtype=float))
        if not np.isfinite(self._point.value):
            raise ValueError("the potential or its gradient is not finite at the start")

    def run(self) -> NewtonResult:
        iterations = 0
        while True:
            settled = self._residual() <= self._options.residual_tolerance
            last = iterations >= self._options.iterations_max
            if last and not settled:
                return self._result("not_converged", iterations, None)
            hessian = self._hessian()
            count = _negative_eigenvalues(hessian) if settled else None
            if settled and count is None:
                return self._result("stalled", iterations, None, "the Hessian is singular")
            if settled and (count == 0 or last):
                return self._result("not_converged" if count else "converged", iterations, count)
            iterations += 1
            try:
                if settled:
                    self._leave_saddle(hessian)
                else:
                    self._descend(hessian)
            except _AtSaddle:
                return self._result("saddle", iterations, None, "left a saddle")
            except _Stalled as stall:
                count = _negative_eigenvalues(hessian)
                return self._result("stalled", iterations, count, str(stall))

    def _residual(self) -> float:
        return self._options.residual(self._point.q, self._point.gradient)

    def _hessian(self) -> Hessian:
        hessian = self._potential.hessian(self._point.q)
        if self._options.metric is not None:
            hessian = _sparse(hessian)  # blocks are shifted along the identity
        if self._metric is None:
            metric = self._options.metric
            if metric is None:
                metric = sparse.identity(hessian.shape[0], format="csr")
            size = np.abs(hessian.diagonal()).mean() / metric.diagonal().mean()
            self._metric = (metric * size).tocsr()
        return hessian

    def _evaluate(self, q: np.ndarray) -> _Point:
        value, gradient = self._potential.value_and_gradient(q)
        if not np.isfinite(gradient).all():
            value = np.inf  # out of bounds, as where the value itself is none
        if np.isfinite(value):
            self._size = max(self._size, abs(value))
        return _Point(q, float(value), gradient)

    def _definite(self, hessian: Hessian) -> Factorisation:
        """Factor H + s M with the first shift, from the present one upwards, that is enough."""
        while self._shift <= _SHIFT_MAX:
            try:
                factor = factorise(self._shifted(hessian))
                if factor.negative_eigenvalues == 0:
                    return factor
            except SolveError:
                pass  # singular, as at a limit point: shift on
            self._shift = max(_GROW * self._shift, _SHIFT_MIN)
        raise _Stalled("no shift of the Hessian gave a step that lowers the potential")

    def _shifted(self, hessian: Hessian) -> Hessian:
        if self._shift == 0:
            return hessian
        if isinstance(hessian, SymmetricBlocks):
            return hessian.shifted(self._shift * self._metric.diagonal()[0])
        return (hessian + self._shift * self._metric).tocsr()

    def _descend(self, hessian: Hessian) -> None:
        """Quasi-Newton steps with one factored Hessian."""
        while True:
            factor = self._definite(hessian)
            if self._shift and self._options.stop_at_saddle and not self._steps:
                with suppress(_Stalled):  # nothing falls along it: on as ever
                    self._leave_saddle(hessian, factor)
                    raise _AtSaddle
            inverse = InverseHessian(factor)
            lengths = []
            while len(lengths) < self._options.steps_per_factorisation:
                length = self._step(inverse)
                if length == 0:
                    break
                lengths.append(length)
                if self._residual() <= self._options.residual_tolerance:
                    return
            if lengths:
                self._adapt(float(np.mean(lengths)))
                return
            self._shift = max(_GROW**2 * self._shift, _SHIFT_MIN)

    def _adapt(self, length: float) -> None:
        """Full steps show that the next Hessian needs less of a shift, short ones more."""
        self._shift *= 0.1 if length > 0.6 else 0.5 if length > 0.3 else 2.0
        if self._shift < _SHIFT_MIN:
            self._shift = 0.0

    def _step(self, inverse: InverseHessian) -> float:
        """Move along a descent direction by a share of it, which is returned; 0 if none helps."""
        start, length = self._point, 1.0
        direction = -inverse.apply(start.gradient)
        slope = float(start.gradient @ direction)
        if not slope < 0:
            return 0.0
        for _ in range(_TRIALS):
            trial = self._evaluate(start.q + length * direction)
            reduction = self._reduction(trial, length * direction, slope)
            if reduction >= -_SUFFICIENT * length * slope:
                inverse.learn(trial.q - start.q, trial.gradient - start.gradient)
                self._point = trial
                self._steps += 1
                return length
            length *= _shortening(length * slope, reduction)
        return 0.0

    def _reduction(self, trial: _Point, step: np.ndarray, slope: float) -> float:
        """Actual reduction; by the trapezoidal rule on the gradients where values round it off."""
        if not np.isfinite(trial.value):
            return -np.inf
        if -slope < _ROUNDING * self._size:
            return -0.5 * float((self._point.gradient + trial.gradient) @ step)
        return self._point.value - trial.value

    def _leave_saddle(self, hessian: Hessian, factor: Factorisation | None = None) -> None:
        """Follow the lowest eigenvector downhill, in doubling steps, as long as that helps."""
        mode = self._lowest_mode(hessian, factor or self._definite(hessian))
        curvature = mode @ (hessian @ mode)
        if curvature >= 0:
            raise _Stalled("a negative eigenvalue was counted, but its eigenvector not found")
        length = np.sqrt(2 * 10 * _ROUNDING * (self._size or 1.0) / -curvature)
        sides = [self._evaluate(self._point.q + side * length * mode) for side in (1, -1)]
        best = min(sides, key=lambda point: point.value)
        direction = best.q - self._point.q
        if not best.value < self._point.value:
            raise _Stalled("the potential does not fall along the negative eigenvector")
        while True:
            direction *= 2
            trial = self._evaluate(self._point.q + direction)
            if not trial.value < best.value:
                break
            best = trial
        self._point = best

    def _lowest_mode(self, hessian: Hessian, factor: Factorisation) -> np.ndarray:
        """Eigenvector of the lowest eigenvalue of H x = l M x, by shift-invert Lanczos."""
        size = hessian.shape[0]
        hessian = _sparse(hessian)
        if size <= _DENSE:
            dense = hessian.toarray(), self._metric.toarray()
            return eigh(*dense, subset_by_index=(0, 0))[1][:, 0]
        inverse = LinearOperator((size, size), matvec=factor.solve, dtype=float)
        start = np.cos(np.arange(size, dtype=float))  # a fixed one gives the same bits
        try:
            return eigsh(
                hessian, 1, self._metric, sigma=-self._shift, OPinv=inverse, v0=start, tol=1e-4
            )[1][:, 0]
        except ArpackError as error:
            raise _Stalled(f"the negative eigenvector was not found ({error})") from error

    def _result(
        self, status: str, iterations: int, count: int | None, why: str = ""
    ) -> NewtonResult:
        residual = self._residual()
        wanted = f"relative residual {residual:.1e} (wanted {self._options.residual_tolerance:.1e})"
        words = "uncounted" if count is None else str(count)
        work = f"{iterations} Hessians and {self._steps} steps"
        message = f"{wanted}, {words} negative eigenvalues after {work}"
        if why:
            message = f"{why}: {message}"
        return NewtonResult(
            status, message, self._point.q, residual, iterations, self._steps, count
        )


def _negative_eigenvalues(hessian: Hessian) -> int | None:
    if isinstance(hessian, SymmetricBlocks):
        with suppress(SolveError):  # most often there is none
            return factorise(hessian).negative_eigenvalues
    try:
        return factorise(_sparse(hessian)).negative_eigenvalues
    except SolveError:
        return None


def _sparse(hessian: Hessian) -> sparse.csr_matrix:
    return hessian.full() if isinstance(hessian, SymmetricBlocks) else hessian


def _shortening(slope: float, reduction: float) -> float:
    """Factor on the step to the minimum of the parabola through value, slope and trial value."""
    if not np.isfinite(reduction):
        return 0.25
    bend = -reduction - slope
    return float(np.clip(-0.5 * slope / bend, 0.1, 0.5)) if bend > 0 else 0.5
