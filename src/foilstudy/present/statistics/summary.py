"""Stiffness of every configuration beside its bound and the published fits."""

from __future__ import annotations

import numpy as np

from foilstudy.base.outcome import USABLE
from foilstudy.base.reference import published
from foilstudy.present.statistics.cells import good

_STIFFNESSES = ("static_stiffness", "static_stiffness_free", "static_stiffness_converged")


def stiffness_summary(cube):
    """Return mean, scatter and comparison with the published fits per configuration.

    Returns
    -------
    pandas.DataFrame
        Stiffnesses in N/m. ``n`` realisations enter, of which ``n_not_converged`` stopped at
        the step limit; ``n_failed`` diverged or failed and do not enter. ``mesh_limit_mean`` is
        that of the same shapes at element size zero and ``mesh_error_mean`` its estimated error;
        ``cylinder_bound`` belongs to the uncrumpled cylinder. A ratio is our mean over the
        published fit.
    """
    import pandas as pd

    status = cube["status"].transpose("thickness", "overlength", "seed")
    usable = status.isin(USABLE).to_numpy()
    not_converged = (status == "not_converged").to_numpy()
    rows = []
    for direction in map(str, cube["direction"].values):
        laws = published().power_laws[direction]
        static, free, limit = (
            _by_cell(good(cube, name, direction=direction)) for name in _STIFFNESSES
        )
        mesh_error = _by_cell(cube["static_stiffness_mesh_error"].sel(direction=direction))
        bound = cube["cylinder_stiffness"].sel(direction=direction)
        bound = bound.transpose("thickness", "overlength").to_numpy()
        for i, j in np.ndindex(bound.shape):
            thickness = float(cube["thickness"][i])
            overlength = float(cube["overlength"][j])
            values = _finite(static[i, j])
            mean = _mean(values)
            std = values.std(ddof=1) if values.size > 1 else np.nan
            simulation = laws["simulation"].law.stiffness(overlength, thickness)
            experiment = laws["experiment"].law.stiffness(overlength, thickness)
            rows.append(
                {
                    "thickness_um": thickness,
                    "overlength_percent": overlength,
                    "reference_height_mm": float(cube["reference_height"][j]),
                    "direction": direction,
                    "n": values.size,
                    "n_not_converged": not_converged[i, j].sum(),
                    "n_failed": (~usable[i, j]).sum(),
                    "mean": mean,
                    "std": std,
                    "cv": std / mean,
                    "min": values.min() if values.size else np.nan,
                    "max": values.max() if values.size else np.nan,
                    "free_mean": _mean(free[i, j]),
                    "mesh_limit_mean": _mean(limit[i, j]),
                    "mesh_error_mean": _mean(mesh_error[i, j]),
                    "cylinder_bound": bound[i, j],
                    "published_simulation": simulation,
                    "ratio_simulation": mean / simulation,
                    "published_experiment": experiment,
                    "ratio_experiment": mean / experiment,
                }
            )
    return pd.DataFrame(rows)


def _by_cell(values) -> np.ndarray:
    return values.transpose("thickness", "overlength", "seed").to_numpy()


def _finite(values: np.ndarray) -> np.ndarray:
    return values[np.isfinite(values)]


def _mean(values: np.ndarray) -> float:
    values = _finite(values)
    return float(values.mean()) if values.size else np.nan
