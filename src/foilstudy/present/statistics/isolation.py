"""A payload on mounts with the foil links of a cube: transmissibility and design limits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.measure.isolation import (
    foil_link,
    in_parallel,
    kept_up_to,
    stiffness_share,
    transmissibility,
)
from foilstudy.measure.isolation.parallel import FLOOR, PAYLOAD
from foilstudy.present.configuration import isolation_options
from foilstudy.present.statistics.cells import good, measured
from foilstudy.present.statistics.mounts import mounts, static_spring

_ORDER = ("thickness", "overlength", "seed")


@dataclass(frozen=True)
class Transmissibilities:
    """Transmissibility of one payload on one kind of mount, in one direction.

    Attributes
    ----------
    alone : ndarray of complex, shape (frequency,)
        Without links.
    linked : ndarray of complex, shape (thickness, overlength, seed, frequency)
        With the links of each realisation; NaN where it left no result.
    """

    alone: np.ndarray
    linked: np.ndarray


def link_stiffness(cube, direction: str, definition: str) -> np.ndarray:
    """Dynamic stiffness of one link per realisation.

    Parameters
    ----------
    direction
        ``axial`` or ``radial``.
    definition
        ``transfer``, ``driving`` or ``relative``.

    Returns
    -------
    ndarray of complex, shape (thickness, overlength, seed, frequency), N/m
        NaN where the realisation diverged or failed.
    """
    stiffness = measured(cube, "dynamic_stiffness", direction=direction, definition=definition)
    return stiffness.transpose(*_ORDER, "frequency").to_numpy()


def payload_transmissibility(cube, direction: str) -> dict[str, Transmissibilities]:
    """Transmissibility of the study's payload without and with its links.

    Parameters
    ----------
    direction
        ``axial`` or ``radial``.

    Returns
    -------
    dict of Transmissibilities
        By kind of mount, in the order of `foilstudy.measure.isolation.MOUNTS`.
    """
    options = isolation_options(cube)
    frequencies = cube["frequency"].to_numpy()
    driving, transfer = (link_stiffness(cube, direction, d) for d in ("driving", "transfer"))
    link = foil_link(driving, transfer)
    result = {}
    for name, mount in mounts(options, direction).items():
        alone = mount.dynamic_stiffness(frequencies)
        both = in_parallel([(1, alone), (options.links, link)])
        # The complex division of a failed realisation, NaN by NaN, is no news.
        with np.errstate(invalid="ignore"):
            result[name] = Transmissibilities(
                *(
                    transmissibility(stiffness, frequencies, options.payload_mass_kg)
                    for stiffness in (alone, both)
                )
            )
    return result


def isolation_table(cube, definition: str = "transfer"):
    """Return how far up in frequency the links of each configuration keep their share.

    Parameters
    ----------
    definition
        Which dynamic stiffness of the links is held against the transfer stiffness of the mount.

    Returns
    -------
    pandas.DataFrame
        A row per direction, mount and configuration. ``static_share_*``: static stiffness of
        all links over the mount's; ``kept_to_hz_*``: frequency up to which their dynamic
        stiffness is at most ``allowed_share`` of the mount's, zero where it is not at rest, the
        end of the band in which it is known where it always is. ``n_whole_band`` of ``n``
        realisations keep it up to ``band_end_hz``, the highest frequency of the study; ``worst``
        is the least favourable one. ``kept``: whether that one keeps the share up to
        ``up_to_hz``, the frequency asked for, or the end of the study's band below it.
    """
    import pandas as pd

    options = isolation_options(cube)
    frequencies = cube["frequency"].to_numpy()
    band_end = frequencies[-1]
    up_to = min(options.up_to_hz, band_end)
    allowed = options.stiffness_share_percent / 100
    rows = []
    for direction in map(str, cube["direction"].values):
        link = link_stiffness(cube, direction, definition)
        static = good(cube, "static_stiffness", direction=direction).transpose(*_ORDER).to_numpy()
        static = options.links * static / static_spring(options, direction).stiffness
        for name, mount in mounts(options, direction).items():
            transfer = mount.dynamic_stiffness(frequencies)[:, PAYLOAD, FLOOR]
            share = stiffness_share(link, transfer, options.links)
            kept = np.where(static > allowed, 0.0, kept_up_to(frequencies, share, allowed))
            for i, j in np.ndindex(kept.shape[:2]):
                cell = kept[i, j][np.isfinite(kept[i, j])]
                shares = static[i, j][np.isfinite(static[i, j])]
                rows.append(
                    {
                        "direction": direction,
                        "mount": name,
                        "thickness_um": float(cube["thickness"][i]),
                        "overlength_percent": float(cube["overlength"][j]),
                        "reference_height_mm": float(cube["reference_height"][j]),
                        "links": options.links,
                        "allowed_share": allowed,
                        "n": cell.size,
                        "static_share_median": _of(np.median, shares),
                        "static_share_worst": _of(np.max, shares),
                        "kept_to_hz_median": _of(np.median, cell),
                        "kept_to_hz_worst": _of(np.min, cell),
                        "n_whole_band": int((cell == band_end).sum()),
                        "band_end_hz": band_end,
                        "up_to_hz": up_to,
                        "kept": bool(cell.size and cell.min() >= up_to),
                    }
                )
    return pd.DataFrame(rows)


def _of(statistic, values: np.ndarray) -> float:
    return float(statistic(values)) if values.size else np.nan
