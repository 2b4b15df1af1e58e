"""The stiffness of the foils as they stand, beside the stress-free one that was published."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

from foilstudy.base.numerals import plural
from foilstudy.present.statistics.cells import measured
from foilstudy.present.statistics.powerlaw import AS_IT_STANDS, SIMULATED
from foilstudy.present.statistics.trust import assess_trust

_TRUE = SIMULATED[AS_IT_STANDS]


@dataclass(frozen=True)
class TrueCell:
    """One configuration in one direction.

    Attributes
    ----------
    mean : float
        N/m; NaN without a value.
    scatter : float
        Coefficient of variation over the realisations; NaN of a single one.
    n : int
        Realisations that have one.
    resolved : bool
        Whether the mesh resolves the folds; no mesh error of this stiffness is known.
    """

    mean: float
    scatter: float
    n: int
    resolved: bool


@dataclass(frozen=True)
class TrueRow:
    """One thickness."""

    thickness_um: float
    cells: tuple[TrueCell, ...]


@dataclass(frozen=True)
class TrueGrid:
    """One direction; its columns are the overlengths, in per cent."""

    direction: str
    overlengths_percent: tuple[float, ...]
    rows: tuple[TrueRow, ...]


def true_grids(cube: xr.Dataset) -> tuple[TrueGrid, ...]:
    """A grid for each direction; none where the foils are elastic shells and nothing more."""
    if _TRUE not in cube:
        return ()
    values, trust = measured(cube, _TRUE), assess_trust(cube)
    resolved = ~(trust.unresolved | trust.folded)
    overlengths = tuple(map(float, cube["overlength"].values))
    return tuple(
        TrueGrid(
            str(direction),
            overlengths,
            tuple(
                TrueRow(
                    float(thickness),
                    tuple(
                        _cell(values.sel(place).values, bool(resolved.sel(place)))
                        for overlength in cube["overlength"].values
                        for place in (_place(thickness, overlength, direction),)
                    ),
                )
                for thickness in cube["thickness"].values
            ),
        )
        for direction in cube["direction"].values
    )


def _place(thickness: float, overlength: float, direction: str) -> dict:
    return {"thickness": thickness, "overlength": overlength, "direction": direction}


def _cell(values: np.ndarray, resolved: bool) -> TrueCell:
    known = values[np.isfinite(values)]
    if not known.size:
        return TrueCell(np.nan, np.nan, 0, resolved)
    mean = float(known.mean())
    # of values of either sign, a coefficient of variation says nothing
    told = known.size > 1 and (known > 0).all()
    scatter = float(known.std(ddof=1) / mean) if told else np.nan
    return TrueCell(mean, scatter, known.size, resolved)


def true_findings(cube: xr.Dataset) -> list[str]:
    """Say of how many foils the ring or the foil itself would run away, if of any."""
    if _TRUE not in cube:
        return []
    loose = measured(cube, "true_ring_negative_eigenvalues")
    known, running = int(np.isfinite(loose).sum()), int((loose > 0).sum())
    unstable = int((measured(cube, "true_negative_eigenvalues") > 0).sum())
    sentences = []
    if running:
        sentences.append(
            f"Of {plural(known, 'foil')} as they stand {running} would push a free top ring out of "
            "its place: the forces that hold them there leave it a motion without resistance."
        )
    if unstable:
        sentences.append(
            f"{plural(unstable, 'foil')} rest in no stable equilibrium, so that nothing vibrates "
            "about it."
        )
    return sentences
