"""What is exported of one realisation, and the fields that several formats share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.measure.dynamics import (
    Damping,
    DynamicsOptions,
    ReducedModel,
    interface_dynamic_stiffness,
)
from foilstudy.model.patch import RING_ROWS, knot_points, refine
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.structures import stress_free_structure

POINTS_PER_ELEMENT = 2
"""Cells of the exported grid per element and direction: a biquadratic element is exactly the
polynomial through its corners, edge middles and middle."""


@dataclass(frozen=True)
class Contents:
    """One realisation, ready for any format.

    Attributes
    ----------
    crumple : Shape
    model : ReducedModel
        Of its stress-free structure.
    damping : Damping
    frequencies : ndarray
        Hz, within the validity of the model.
    provenance : mapping of str to str
        Goes into every file.
    modes : int
        Mode shapes, rings clamped, that are written as fields.
    """

    crumple: Shape
    model: ReducedModel
    damping: Damping
    frequencies: np.ndarray
    provenance: Mapping[str, str] = field(default_factory=dict)
    modes: int = 6

    @classmethod
    def of(
        cls,
        crumple: Shape,
        options: DynamicsOptions | None = None,
        provenance: Mapping[str, str] | None = None,
    ) -> Contents:
        """Shape, reduced model and band of a crumple.

        Raises
        ------
        Refusal
            If the reduced model is valid nowhere in the band.
        SolveError
            If a factorisation or the reduction fails.
        """
        options = options or DynamicsOptions()
        model, grid = options.reduced(stress_free_structure(crumple)), options.grid
        grid = grid[
            ~(grid > model.valid_to_hz)
        ]  # a model without an estimate is valid as it stands
        if grid.size < 2:
            raise Refusal(
                f"the {model.method} model is wrong by about {model.error_estimate:.2g} already at "
                f"{options.lowest_hz:g} Hz; set dynamics.reduction: rational_krylov, or raise "
                "dynamics.tolerance."
            )
        return cls(crumple, model, options.damping, grid, provenance or {}, options.mode_shapes)

    @cached_property
    def dynamic_stiffness(self) -> np.ndarray:
        """Of the twelve ring motions, shape (frequencies, 12, 12), complex."""
        return interface_dynamic_stiffness(self.model, self.frequencies, self.damping)

    @cached_property
    def eigenfrequencies(self) -> np.ndarray:
        """All with both rings clamped up to where the model is valid, Hz."""
        every = self.model.clamped_eigenfrequencies()
        return every[~(every > self.model.valid_to_hz)]

    @cached_property
    def clamped_modes(self) -> tuple[np.ndarray, np.ndarray]:
        """Eigenfrequencies (modes,), Hz, and control point displacements (modes, 3, rows, columns).

        Mass-normalised, m/sqrt(kg m2); the rings are at rest.
        """
        frequencies, shapes = self.model.clamped_modes(self.modes)
        patch = self.crumple.patch
        control = np.zeros((len(frequencies), *patch.shape))
        inner = shapes.T.reshape(len(frequencies), patch.rows - 2 * RING_ROWS, patch.columns, 3)
        control[:, :, RING_ROWS:-RING_ROWS] = np.moveaxis(inner, 3, 1)
        return frequencies, control

    @property
    def ring_heights(self) -> tuple[float, float]:
        """Heights of the ring centres, the points that the motions are about, m."""
        z = self.crumple.points[2]
        return float(z[:RING_ROWS].mean()), float(z[-RING_ROWS:].mean())


def surface_grid(control_points: np.ndarray) -> np.ndarray:
    """Knots, edge middles and element middles, shape (2 along + 1, 2 around, 3).

    Parameters
    ----------
    control_points : ndarray, shape (3, rows, columns)
        Or displacements of control points.
    """
    return np.moveaxis(knot_points(refine(control_points)), 0, 2)
