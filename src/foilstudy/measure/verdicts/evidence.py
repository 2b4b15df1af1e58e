"""What a verdict is founded on: numbers of one realisation, none of them looked at by eye."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Self

import numpy as np

__all__ = ["Evidence", "Way", "work_over_energy"]


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
    broad_wave_share, calmer_half, alternation, hidden_energy : float
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
    work_over_energy : float
        See `work_over_energy`.
    """

    status: str
    negative_eigenvalues: float = np.nan
    membrane_energy: float = np.nan
    bending_energy: float = np.nan
    broad_wave_share: float = np.nan
    calmer_half: float = np.nan
    alternation: float = np.nan
    hidden_energy: float = np.nan
    self_crossing_share: float = np.nan
    beyond_yield_share: float = np.nan
    static_stiffness: tuple[float, ...] = ()
    prestressed_stiffness: tuple[float, ...] = ()
    least_stiffness: float = np.nan
    budget_spent: bool = False
    work_over_energy: float = np.nan

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
        if "history_height" in values:
            found["work_over_energy"] = _work_of_record(values)
        # what a search that has not converged lacked is steps, or it would have ended otherwise
        return cls(status, budget_spent=status == "not_converged", **found)


@dataclass(frozen=True, eq=False)
class Way:
    """How the top ring came down, an entry for each time it was looked at.

    Attributes
    ----------
    step : ndarray
        Of the motion.
    height, force : ndarray
        Of the ring, m, and the force that pushes it up, N.
    kinetic : ndarray
        Kinetic energy of the foil, J; zero all along where nothing moves by inertia.
    """

    step: np.ndarray
    height: np.ndarray
    force: np.ndarray
    kinetic: np.ndarray


_LEAST_ENTRIES = 6
"""In which a work can be seen."""
_LEAST_STEPS = 100
"""In which a foil can follow the ring: in fewer it has not, whatever work is seen."""


def work_over_energy(way: Way, energy: float) -> float:
    """Work of the top ring over the energy at rest: one where nothing is lost on the way.

    Snaps lose some of it at any rate; a ramp in which the foil cannot follow the ring, nearly all.

    Parameters
    ----------
    way : Way
    energy : float
        Stored at the end, with what the way has spent beside, by plastic flow or friction, J.

    Returns
    -------
    float
        NaN where nothing is stored, or the way was looked at too seldom to tell; infinite where a
        motion took so few steps that no foil can follow.
    """
    moves = np.flatnonzero(np.diff(way.height) != 0)
    if not (energy > 0 and moves.size):
        return np.nan
    if np.any(way.kinetic > 0) and moves.size < _LEAST_ENTRIES:
        steps = way.step[moves[-1] + 1] - way.step[moves[0]]
        return np.inf if steps <= _LEAST_STEPS else np.nan
    return float(np.trapezoid(way.force, -way.height) / energy)


def _work_of_record(values: Mapping[str, Any]) -> float:
    """The same of the history in a record, whose last entry is the equilibrium."""
    stored = sum(
        float(value[-1])
        for name, value in values.items()
        if name.startswith("history_") and name.endswith("_energy") and len(value)
    )
    # what waiting has taken off the energy, the way has put in
    stored /= float(values.get("stress_kept", 1.0))
    # records of earlier releases tell of plastic flow alone
    spent = float(values.get("work_spent", values.get("dissipated_work", 0.0)))
    names = ("step", "height", "reaction_force", "kinetic_energy")
    way = Way(*(np.asarray(values[f"history_{name}"]) for name in names))
    return work_over_energy(way, stored + spent)


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
