"""What is exported of one realisation, and the fields that several formats share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.measure.air.protocols import Air
from foilstudy.measure.air.vacuum import Vacuum
from foilstudy.measure.dynamics import (
    CONDITIONS,
    Damping,
    DynamicsOptions,
    EvenGrid,
    ReducedModel,
    accelerance,
    interface_dynamic_stiffness,
    receptance,
)
from foilstudy.model.patch import RING_ROWS, knot_points, refine
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.structures import in_air, stress_free_structure

POINTS_PER_ELEMENT = 2
"""Cells of the exported grid per element and direction: a biquadratic element is exactly the
polynomial through its corners, edge middles and middle."""


@dataclass(frozen=True)
class Contents:
    """One realisation, ready for any format; what a format does not need is never computed.

    Attributes
    ----------
    crumple : Shape
    options : DynamicsOptions
        Reduction, band, damping, and how many mode shapes are written as fields.
    provenance : mapping of str to str
        Goes into every file.
    air : Air
        What surrounds the foil.
    """

    crumple: Shape
    options: DynamicsOptions
    provenance: Mapping[str, str] = field(default_factory=dict)
    air: Air = field(default_factory=Vacuum)

    def __repr__(self) -> str:
        return f"<Contents: {self.crumple.foil}; {self.options}>"

    @classmethod
    def of(
        cls,
        crumple: Shape,
        options: DynamicsOptions | None = None,
        provenance: Mapping[str, str] | None = None,
        air: Air | None = None,
    ) -> Contents:
        """Of a crumple, with the dynamics that a study has by default."""
        return cls(crumple, options or DynamicsOptions(), provenance or {}, air or Vacuum())

    @property
    def model(self) -> ReducedModel:
        """Of the stress-free structure.

        Raises
        ------
        Refusal
            If the reduced model is valid nowhere in the band.
        SolveError
            If a factorisation or the reduction fails.
        """
        if isinstance(self._reduced, Exception):
            raise self._reduced
        return self._reduced

    @cached_property
    def _reduced(self) -> ReducedModel | Exception:
        """The model, or what kept it from being made: no format after the first tries again."""
        try:
            structure = in_air(self.crumple, stress_free_structure(self.crumple), self.air)
            model = self.options.reduced(structure)
        except Exception as problem:
            return problem
        # a model without an estimate is valid as it stands
        if (~(self.options.grid > model.valid_to_hz)).sum() >= 2:
            return model
        return Refusal(
            f"the {model.method} model is wrong by about {model.error_estimate:.2g} already at "
            f"{self.options.lowest_hz:g} Hz; set dynamics.reduction: rational_krylov, or raise "
            "dynamics.tolerance."
        )

    @property
    def damping(self) -> Damping:
        """Of the frequency responses."""
        return self.options.damping

    @cached_property
    def frequencies(self) -> np.ndarray:
        """Of the dynamic stiffness: the band as far as the model is valid, Hz."""
        grid = self.options.grid
        return grid[~(grid > self.model.valid_to_hz)]

    @cached_property
    def even_grid(self) -> EvenGrid:
        """Evenly spaced frequencies in the same band, of receptance and accelerance."""
        return EvenGrid.of(self.model, self.damping, *self.frequencies[[0, -1]])

    @cached_property
    def receptances(self) -> dict[str, np.ndarray]:
        """Under each of `CONDITIONS` on the even grid, shape (frequencies, motions, motions)."""
        arguments = self.model, self.even_grid.frequencies, self.damping
        return {condition: receptance(*arguments, condition) for condition in CONDITIONS}

    def motion_per_force(self, quantity: str, condition: str) -> np.ndarray:
        """``receptance`` or ``accelerance`` on the even grid."""
        values = self.receptances[condition]
        if quantity == "receptance":
            return values
        return accelerance(values, self.even_grid.frequencies)

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
        frequencies, shapes = self.model.clamped_modes(self.options.mode_shapes)
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
