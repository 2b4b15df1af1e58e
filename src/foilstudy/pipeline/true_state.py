"""Stiffness of a foil as it stands: with the stresses that hold it there, and all it remembers.

Of elastic foil without contact it is the pre-stressed stiffness, about an equilibrium that another
mesh would not find again. What has yielded, touches or has rested is in one state, and this is
how that resists small motions: of unloading, where more load would make it flow.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.measure.air.protocols import Air
from foilstudy.measure.air.vacuum import Vacuum
from foilstudy.measure.dynamics import DynamicsOptions
from foilstudy.measure.stiffness import fixed_stiffness, free_stiffness
from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.structures import in_air, prestressed_structure
from foilstudy.pipeline.vibration import Vibration, vibration_of


@dataclass(frozen=True, eq=False, repr=False)
class TrueState:
    """Small motions about the equilibrium in which a foil has settled.

    Attributes
    ----------
    interface : ndarray, shape (12, 12)
        Forces and moments on the rings per ring motion, N/m and their like; with the forces that
        turn with a loaded ring.
    negative_eigenvalues : int
        Of the tangent with both rings held: zero in a stable equilibrium.
    ring_negative_eigenvalues : int
        Of the stiffness of the top ring, the bottom one held: motions in which the top ring would
        run away if it were free.
    vibration : Vibration or None
        None where the equilibrium is not stable with held rings: nothing oscillates about it.
    """

    interface: np.ndarray
    negative_eigenvalues: int
    ring_negative_eigenvalues: int
    vibration: Vibration | None

    @property
    def stiffness(self) -> np.ndarray:
        """Axial and radial, other motions held, shape (2,), N/m."""
        return fixed_stiffness(self.interface)

    @property
    def free_stiffness(self) -> np.ndarray:
        """The same with the other motions free, shape (2,), N/m; NaN where the ring runs away."""
        if self.ring_negative_eigenvalues:
            return np.full(len(DIRECTIONS), np.nan)
        return free_stiffness(self.interface)

    def __repr__(self) -> str:
        axial, radial = self.stiffness
        return (
            f"<TrueState: axial {axial:.4g}, radial {radial:.4g} N/m, "
            f"{self.negative_eigenvalues} negative eigenvalues>"
        )


def true_state(shape: Shape, options: DynamicsOptions, air: Air | None = None) -> TrueState:
    """Static and dynamic stiffness of a shape at its state, stresses and all.

    The air acts in the dynamics alone, as it does about the stress-free shape.

    Raises
    ------
    SolveError
        If the tangent with held rings is singular, or the reduction fails.
    """
    structure = prestressed_structure(shape)
    interface, negative = structure.static.stiffness, structure.static.factor.negative_eigenvalues
    ring = int((np.linalg.eigvalsh(interface[6:, 6:]) < 0).sum())
    vibration = None
    if not negative:
        vibration = vibration_of(in_air(shape, structure, air or Vacuum()), options)
    return TrueState(interface, negative, ring, vibration)
