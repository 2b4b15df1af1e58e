"""A quarter of the cylinder between planes of symmetry: a path has a quarter of the unknowns, and
of the limit points only those of patterns that are mirrored at both planes.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.model.foil import Foil
from foilstudy.model.patch import Patch, fitted_control_points
from foilstudy.model.shell.shell import Shell
from foilstudy.model.supports.edges import RIGID_LINES, Constraints, constraints, symmetric
from foilstudy.model.supports.interpolation import as_field, as_vector
from foilstudy.solve.choices import PATHS
from foilstudy.solve.continuation import Correction, March, Trace, follow
from foilstudy.solve.continuation.pushed_sheet import PushedSheet
from foilstudy.solve.problem import Problem
from foilstudy.study.limits.bounds import Quarter
from foilstudy.study.published import foil

WAVES = 8
"""Of the imperfection, along and around the quarter, at most."""
TOLERANCE = 1e-8
_TURN = 1e-9


class PushedQuarter(PushedSheet):
    """The same of a quarter; what its planes of symmetry hold is no unknown.

    Parameters
    ----------
    sheet : Shell
    held : Constraints
    shortening : float
        m.
    """

    def __init__(self, sheet: Shell, held: Constraints, shortening: float):
        super().__init__(Problem(sheet), shortening, TOLERANCE)
        self._held = held
        self.size = held.free

    def points(self, q: np.ndarray, factor: float) -> np.ndarray:
        """Control points, shape (3, rows, columns), m."""
        return self._problem.reference + factor * self.motion + self._held.displacement(q)

    def residual(self, q: np.ndarray, factor: float) -> np.ndarray:
        """See `Equations`."""
        return self._held.reduced(self._all_forces(q, factor))

    def linearised(self, q: np.ndarray, factor: float) -> tuple[sparse.csr_matrix, np.ndarray]:
        """See `Equations`."""
        tangent = self._problem.tangent(self.points(q, factor))
        pushed = as_field(tangent @ as_vector(self.motion), self._held.patch)
        return self._held.reduced_matrix(tangent), self._held.reduced(pushed)


def quarter_of(sheet: Foil, size: float, amplitude: float, seed: int) -> PushedQuarter:
    """A quarter arc of a foil over its whole height.

    Parameters
    ----------
    sheet : Foil
    size : float
        Of the elements, m.
    amplitude : float
        Root mean square of the imperfection, of random smooth waves that both planes mirror, m.
    seed : int
    """
    radius, height = sheet.diameter / 2, sheet.reference_height
    around, along = round(0.5 * np.pi * radius / size), round(height / size)
    patch = Patch(around, along, 0.5 * np.pi * radius / around, height / along, periodic=False)
    waves = np.random.default_rng([seed, 4]).standard_normal((WAVES, WAVES))
    # the mean square of each product of a cosine and a sine is a quarter
    waves *= 2 * amplitude / np.linalg.norm(waves)

    def surface(s: np.ndarray, z: np.ndarray) -> np.ndarray:
        angle = s / radius
        deviation = sum(
            waves[m - 1, n - 1] * np.cos(2 * m * angle) * np.sin(n * np.pi * z / height)
            for m in range(1, WAVES + 1)
            for n in range(1, WAVES + 1)
        )
        r = radius + deviation
        return np.stack([r * np.cos(angle), r * np.sin(angle), z])

    points = fitted_control_points(patch, surface)
    edges = {
        "bottom": RIGID_LINES,
        "top": RIGID_LINES,
        "left": symmetric(1),
        "right": symmetric(0),
    }
    shell = Shell.elastic(patch, points, sheet.material, sheet.thickness)
    return PushedQuarter(shell, constraints(patch, edges), sheet.shortening)


def measure(case: Quarter) -> dict:
    """Follow a path as far as its budget goes.

    Returns
    -------
    dict
        ``status``, ``reason``; ``reached`` (share of the shortening) with all factorisations and
        ``reached_within`` a fifth of them; ``factorisations``, ``turns`` of the factor,
        ``negative_eigenvalues`` at the last point and ``most_negative`` on the way, ``unknowns``.
    """
    sheet = foil(case.thickness_um, case.height_mm)
    quarter = quarter_of(sheet, case.size_mm * 1e-3, case.amplitude_um * 1e-6, case.seed)
    kind = PATHS[case.path]
    path = kind(budget=case.budget, **({"surface": case.surface} if case.surface else {}))
    march = March(
        first=path.first_step,
        longest=path.longest_step,
        budget=path.budget,
        correction=Correction(TOLERANCE),
    )
    trace = follow(quarter, np.zeros(quarter.size), path.rule(), march)
    counts = [point.negative_eigenvalues for point in trace.points]
    return {
        "status": trace.status,
        "reason": trace.reason,
        "reached": trace.farthest,
        "reached_within": trace.within(case.budget // 5),
        "factorisations": trace.factorisations,
        "turns": turns_of(trace),
        "negative_eigenvalues": counts[-1] if counts else None,
        "most_negative": max(counts, default=None),
        "unknowns": quarter.size,
    }


def turns_of(trace: Trace) -> int:
    """How often the factor has turned back or forth."""
    steps = np.diff([point.factor for point in trace.points])
    steps = steps[np.abs(steps) > _TURN]
    return int((np.sign(steps[1:]) != np.sign(steps[:-1])).sum())
