"""What a verdict is founded on: numbers of one realisation, none of them looked at by eye."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Self

import numpy as np

__all__ = ["Evidence"]


@dataclass(frozen=True)
class Evidence:
    """Numbers of one realisation; NaN where one is not known, and then no verdict rests on it.

    Attributes
    ----------
    status : str
        One of `foilstudy.base.outcome.STATUSES`.
    negative_eigenvalues : float
        Of the tangent at the end, rings held.
    membrane_energy, bending_energy : float
        J.
    broad_wave_share, calmer_half, alternation : float
        See `foilstudy.measure.verdicts.shape`.
    self_crossing_share, beyond_yield_share : float
        Of the surface.
    static_stiffness, prestressed_stiffness : tuple of float
        By direction, N/m; NaN where they were sought and the matrix was singular, empty where they
        were not sought.
    least_stiffness : float
        Smallest eigenvalue of the interface stiffness over its largest, in comparable units.
    budget_spent : bool
        Whether the search ended for want of steps or factorisations.
    """

    status: str
    negative_eigenvalues: float = np.nan
    membrane_energy: float = np.nan
    bending_energy: float = np.nan
    broad_wave_share: float = np.nan
    calmer_half: float = np.nan
    alternation: float = np.nan
    self_crossing_share: float = np.nan
    beyond_yield_share: float = np.nan
    static_stiffness: tuple[float, ...] = ()
    prestressed_stiffness: tuple[float, ...] = ()
    least_stiffness: float = np.nan
    budget_spent: bool = False

    @classmethod
    def of(cls, status: str, values: Mapping[str, Any]) -> Self:
        """Of the values of a record, by the names of the study's quantities."""
        known = {f.name: values[f.name] for f in fields(cls) if f.name in values}
        found = {
            name: tuple(map(float, value)) if np.ndim(value) else float(value)
            for name, value in known.items()
        }
        if "interface_stiffness" in values:
            found["least_stiffness"] = least_stiffness(np.asarray(values["interface_stiffness"]))
        # what a search that has not converged lacked is steps, or it would have ended otherwise
        return cls(status, budget_spent=status == "not_converged", **found)


def least_stiffness(interface: np.ndarray) -> float:
    """Smallest eigenvalue of a stiffness over its largest, its rows and columns scaled to one.

    Parameters
    ----------
    interface : ndarray, shape (12, 12)
        Forces and moments on the rings by their motions.

    Returns
    -------
    float
        Zero but for rounding where only rigid motions cost nothing; NaN if it is not finite or a
        ring resists some motion of its own not at all.
    """
    own = np.diag(interface)
    if not (np.isfinite(interface).all() and (own > 0).all()):
        return np.nan if not np.isfinite(interface).all() else -1.0
    scale = 1 / np.sqrt(own)
    eigenvalues = np.linalg.eigvalsh(0.5 * (interface + interface.T) * np.outer(scale, scale))
    return float(eigenvalues[0] / eigenvalues[-1])
