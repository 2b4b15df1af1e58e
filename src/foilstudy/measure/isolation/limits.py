"""How far up in frequency a link stays soft beside the mount that it bypasses.

Well above all suspension frequencies the payload moves by transfer stiffness over its inertia, so
that links with a share s of the mount's transfer stiffness raise its motion by 1 + s at most.
"""

from __future__ import annotations

import numpy as np


def stiffness_share(link: np.ndarray, mount: np.ndarray, links: int = 1) -> np.ndarray:
    """Magnitude of the dynamic stiffness of several equal links over that of the mount.

    Parameters
    ----------
    link : ndarray of complex, shape (..., f)
        One link, N/m.
    mount : ndarray of complex, shape (f,)
        Transfer stiffness of the mount at the same frequencies, N/m.
    links : int
        Number of links, taken as equal; different ones add up to no more than the sum of their
        magnitudes.

    Returns
    -------
    ndarray, shape (..., f)
    """
    return links * np.abs(link) / np.abs(mount)


def kept_up_to(frequencies: np.ndarray, share: np.ndarray, allowed: float) -> np.ndarray:
    """Highest frequency up to which a share is nowhere above the allowed one.

    Between two frequencies the share is taken as a power of the frequency.

    Parameters
    ----------
    frequencies : ndarray, shape (f,)
        Ascending, Hz.
    share : ndarray, shape (..., f)
        As from `stiffness_share`. It is known up to its first NaN.
    allowed : float

    Returns
    -------
    ndarray, shape (...)
        Hz; zero where the lowest frequency exceeds it already, the highest frequency at which the
        share is known where none does, NaN where it is known at none.

    Raises
    ------
    ValueError
        If the allowed share is not positive, or frequencies and share do not fit together.
    """
    frequencies, share = np.asarray(frequencies, dtype=float), np.asarray(share, dtype=float)
    if not (np.isfinite(allowed) and allowed > 0):
        raise ValueError(f"The allowed share is {allowed!r}; give a finite value above zero.")
    if share.shape[-1:] != frequencies.shape or (np.diff(frequencies) <= 0).any():
        raise ValueError(
            f"The share has shape {share.shape} at {frequencies.shape} frequencies; give "
            "ascending frequencies, and one share for each along the last axis."
        )
    kept = [_kept(frequencies, curve, allowed) for curve in share.reshape(-1, frequencies.size)]
    return np.array(kept).reshape(share.shape[:-1])


def _kept(frequencies: np.ndarray, share: np.ndarray, allowed: float) -> float:
    unknown = np.isnan(share)
    known = int(unknown.argmax()) if unknown.any() else share.size
    if known == 0:
        return np.nan
    above = share[:known] > allowed
    if not above.any():
        return float(frequencies[known - 1])
    first = int(above.argmax())
    if first == 0:
        return 0.0
    # A share may vanish, but not as a power of the frequency.
    below = max(share[first - 1], np.finfo(float).tiny)
    fraction = np.log(allowed / below) / np.log(share[first] / below)
    step = frequencies[first] / frequencies[first - 1]
    return float(frequencies[first - 1] * step**fraction)
