"""A specimen with a nonlinear static axial force."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.bench.rig.specimens import Specimen

__all__ = ["NonlinearAxial"]


@dataclass(frozen=True, eq=False)
class NonlinearAxial:
    """What a static axial force has beyond its tangent at rest, added to a linear specimen.

    Attributes
    ----------
    linear : Specimen
        With that tangent.
    motions : ndarray, shape (n,)
        m, rising, zero among them: lower ring against upper ring along the axis.
    forces : ndarray, shape (n,)
        N on the upper ring, zero at rest; straight lines between, as sampled quasi-statically.
    """

    kind = "nonlinear"
    linear: Specimen
    motions: np.ndarray
    forces: np.ndarray

    def __post_init__(self) -> None:
        motions, forces = np.asarray(self.motions, float), np.asarray(self.forces, float)
        good = motions.ndim == 1 and motions.shape == forces.shape and motions.size >= 3
        if not good or not (np.diff(motions) > 0).all() or not np.isfinite(forces).all():
            raise Refusal(
                "a sampled force needs three or more rising motions, each with a finite force."
            )
        if not ((motions == 0) & (forces == 0)).any():
            raise Refusal("a sampled force has no sample of zero force at rest; add it.")

    def dynamic_stiffness(self, frequencies: np.ndarray) -> np.ndarray:
        """Of the linear part, see `Specimen`."""
        return self.linear.dynamic_stiffness(frequencies)

    def excess(self, motion: np.ndarray, tangent: float) -> np.ndarray:
        """Force on the upper ring beyond that of the tangent (N/m), N.

        Raises
        ------
        Refusal
            If the motion leaves the range that was sampled.
        """
        low, high = self.motions[0], self.motions[-1]
        if motion.min() < low or motion.max() > high:
            raise Refusal(
                f"the rings move by {motion.min():.3g} to {motion.max():.3g} m against each other, "
                f"and the axial force is sampled from {low:.3g} to {high:.3g} m; excite less or "
                "sample further."
            )
        return np.interp(motion, self.motions, self.forces) - tangent * motion
