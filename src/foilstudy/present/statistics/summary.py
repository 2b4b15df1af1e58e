"""Stiffness of every configuration, whether it can be trusted, its bound and the published fits."""

from __future__ import annotations

import numpy as np

from foilstudy.base.confidence import MeanInterval
from foilstudy.present.comparison import comparable
from foilstudy.present.configuration import configuration
from foilstudy.present.statistics.cells import good, realised, sound
from foilstudy.present.statistics.trust import assess_trust
from foilstudy.study.sweep.rounds import answering_values

_STIFFNESSES = ("static_stiffness", "static_stiffness_free", "static_stiffness_converged")


def stiffness_summary(cube):
    """Return mean, scatter and comparison with the published fits per configuration.

    Returns
    -------
    pandas.DataFrame
        Stiffnesses in N/m. ``n`` realisations enter, of which ``n_not_converged`` stopped at
        the step limit; ``n_failed`` diverged or failed and do not enter. ``mesh_limit_mean`` is
        that of the same shapes at element size zero, ``mesh_limit_std`` its standard deviation
        over them, ``mesh_error_mean`` its estimated error and ``mesh_error_share_max`` the
        largest of a realisation, over its value; ``element_over_sqrt_rt`` tells how well the
        crumple is resolved. ``trusted``: see `foilstudy.present.statistics.trust`.
        ``best_low`` to ``best_high`` is the 95 % interval (`foilstudy.base.confidence`) of the mean
        of the ``best_n`` values that answer: in the mesh limit, or on the crumpled mesh where no
        mesh error is stated; ``best_half_width`` half of it over that mean,
        ``wished_half_width`` what the study wished, and ``wish_takes`` how many values the scatter
        takes for that.
        ``cylinder_bound`` belongs to the uncrumpled cylinder. A ratio is our mean over the
        published fit; these columns are there for the published case alone.
    """
    import pandas as pd

    status = cube["status"].transpose("thickness", "overlength", "seed")
    usable = sound(cube).transpose(*status.dims).to_numpy()
    not_converged = (status == "not_converged").to_numpy()
    there, wish = realised(cube).to_numpy(), wished_half_width(cube)
    reference, trust = comparable(cube), assess_trust(cube)
    slenderness = trust.slenderness.to_numpy()
    rows = []
    for direction in map(str, cube["direction"].values):
        static, free, limit = (
            _by_cell(good(cube, name, direction=direction)) for name in _STIFFNESSES
        )
        mesh_error = _by_cell(cube["static_stiffness_mesh_error"].sel(direction=direction))
        bound = cube["cylinder_stiffness"].sel(direction=direction)
        bound = bound.transpose("thickness", "overlength").to_numpy()
        mesh_error_max = trust.mesh_error.sel(direction=direction).to_numpy()
        trusted = trust.trusted.sel(direction=direction).to_numpy()
        for i, j in np.ndindex(bound.shape):
            thickness = float(cube["thickness"][i])
            overlength = float(cube["overlength"][j])
            values = _finite(static[i, j])
            mean = _mean(values)
            std = _std(values)
            rows.append(
                {
                    "thickness_um": thickness,
                    "overlength_percent": overlength,
                    "reference_height_mm": float(cube["reference_height"][j]),
                    "direction": direction,
                    "n": values.size,
                    "n_not_converged": not_converged[i, j].sum(),
                    "n_failed": (there[i, j] & ~usable[i, j]).sum(),
                    "mean": mean,
                    "std": std,
                    "cv": std / mean,
                    "min": values.min() if values.size else np.nan,
                    "max": values.max() if values.size else np.nan,
                    "free_mean": _mean(free[i, j]),
                    "mesh_limit_mean": _mean(limit[i, j]),
                    "mesh_limit_std": _std(_finite(limit[i, j])),
                    "mesh_error_mean": _mean(mesh_error[i, j]),
                    "mesh_error_share_max": mesh_error_max[i, j],
                    "element_over_sqrt_rt": slenderness[i, j],
                    "trusted": trusted[i, j],
                    **_confidence(
                        answering_values(static[i, j], limit[i, j], mesh_error[i, j]), wish
                    ),
                    "cylinder_bound": bound[i, j],
                }
                | _beside_published(reference, direction, overlength, thickness, mean)
            )
    return pd.DataFrame(rows)


def _confidence(values: np.ndarray, wish: float) -> dict[str, float]:
    mean = MeanInterval.of(values)
    return {
        "best_n": mean.n,
        "best_low": mean.low,
        "best_high": mean.high,
        "best_half_width": mean.half_width,
        "wished_half_width": wish,
        "wish_takes": mean.values_for(wish) if np.isfinite(wish) else np.nan,
    }


def wished_half_width(cube) -> float:
    """Half width of the interval of a mean that the study wished for; NaN where it did not."""
    percent = configuration(cube).get("report", {}).get("confidence_percent")
    return np.nan if percent is None else percent / 100


def _beside_published(reference, direction, overlength, thickness, mean) -> dict[str, float]:
    if reference is None:
        return {}
    columns = {}
    for source, law in reference.power_laws[direction].items():
        fitted = law.law.stiffness(overlength, thickness)
        columns |= {f"published_{source}": fitted, f"ratio_{source}": mean / fitted}
    return columns


def best_mean(summary):
    """The mean stiffness in the mesh limit, and on the crumpled mesh where there is no limit.

    Parameters
    ----------
    summary : pandas.DataFrame
        From `stiffness_summary`.
    """
    stated = summary["mesh_error_mean"].notna()
    return summary["mesh_limit_mean"].where(stated, summary["mean"])


def _by_cell(values) -> np.ndarray:
    return values.transpose("thickness", "overlength", "seed").to_numpy()


def _finite(values: np.ndarray) -> np.ndarray:
    return values[np.isfinite(values)]


def _std(values: np.ndarray) -> float:
    return float(values.std(ddof=1)) if values.size > 1 else np.nan


def _mean(values: np.ndarray) -> float:
    values = _finite(values)
    return float(values.mean()) if values.size else np.nan
