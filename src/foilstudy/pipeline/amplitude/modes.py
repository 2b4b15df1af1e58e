"""The lowest clamped modes of a crumple at finite amplitude."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg import Factorisation, SymmetricBlocks, factorise, lowest_modes
from foilstudy.measure.amplitude.normal_form import NormalForm, normal_form
from foilstudy.model.patch import RING_ROWS
from foilstudy.pipeline.amplitude.sweep import problem_about
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.structures import mass
from foilstudy.solve.problem import Problem

_STEP = 0.2
"""Largest displacement in the steps along a mode, over the thickness."""


class ClampedFoil:
    """A foil between rings that stand still, see `normal_form.Vibrating`.

    Terms with a memory keep their state: vibrations of a plastic foil that do not make it yield.

    Parameters
    ----------
    problem : Problem
    points : ndarray, shape (3, rows, columns)
        Control points in equilibrium, m.
    mass : csr_matrix
        Of the control points between the rings, kg.
    """

    def __init__(self, problem: Problem, points: np.ndarray, mass: sparse.csr_matrix):
        self._problem, self._points, self.mass = problem, points, mass
        self._force = np.empty_like(points)
        self._rest = 0.0
        self._rest = self.force(np.zeros(mass.shape[0]))
        self.stiffness = self.tangent(np.zeros(mass.shape[0]))

    def force(self, displacement: np.ndarray) -> np.ndarray:
        """See `Vibrating`."""
        self._problem.force(self._moved(displacement), self._force)
        between = self._force[:, RING_ROWS:-RING_ROWS].transpose(1, 2, 0).ravel()
        return between - self._rest

    def tangent(self, displacement: np.ndarray) -> sparse.csr_matrix:
        """See `Vibrating`."""
        tangent = self._problem.held_tangent(self._moved(displacement))
        return tangent.full() if isinstance(tangent, SymmetricBlocks) else tangent

    def _moved(self, displacement: np.ndarray) -> np.ndarray:
        points = self._points.copy()
        between = points[:, RING_ROWS:-RING_ROWS]
        between += displacement.reshape(*between.shape[1:], 3).transpose(2, 0, 1)
        return points


@dataclass(frozen=True, eq=False)
class ClampedModes:
    """Modes of a clamped foil with its factored stiffness.

    Attributes
    ----------
    foil : ClampedFoil
    static : Factorisation
    eigenvalues : ndarray, shape (modes,)
        rad2/s2.
    shapes : ndarray, shape (unknowns, modes)
        Mass-normalised.
    thickness : float
        m.
    """

    foil: ClampedFoil
    static: Factorisation
    eigenvalues: np.ndarray
    shapes: np.ndarray
    thickness: float

    def normal_forms(self) -> list[NormalForm]:
        """Of each mode.

        Raises
        ------
        SolveError
            If the foil cannot be factored at twice the frequency of a mode.
        """
        step = _STEP * self.thickness
        return [
            normal_form(self.foil, self.static, float(value), shape, step)
            for value, shape in zip(self.eigenvalues, self.shapes.T, strict=True)
        ]


def clamped_modes(crumpled: Crumpled, count: int = 3, stressed: bool = True) -> ClampedModes:
    """The lowest modes of a crumple with both rings held.

    Parameters
    ----------
    crumpled : Crumpled
    count : int
    stressed : bool
        With the stress left in; else of the same shape free of stress.

    Raises
    ------
    SolveError
        If the stiffness with held rings is singular or the modes do not converge.
    Refusal
        If the removal of the stress leaves some of it.
    """
    problem = problem_about(crumpled, stressed)
    foil = ClampedFoil(problem, crumpled.points, mass(crumpled).interior)
    static = factorise(foil.stiffness)
    modes = lowest_modes(foil.stiffness, foil.mass, static, count)
    return ClampedModes(foil, static, modes.eigenvalues, modes.shapes, crumpled.foil.thickness)
