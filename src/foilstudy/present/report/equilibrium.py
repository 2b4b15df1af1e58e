"""Whether the crumpled shapes are equilibria, stable ones, and what it took to get there."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr

from foilstudy.base.numerals import number, plural
from foilstudy.present.ramp import ramp_steps
from foilstudy.present.report.spread import Spread
from foilstudy.present.statistics.cells import realised


@dataclass(frozen=True)
class Settling:
    """How the realisations of one thickness settled.

    Attributes
    ----------
    cells : int
        Realisations in the sweep.
    settled : int
        Those with a residual within the tolerance and no negative eigenvalue of the tangent.
    worst_residual : float
        Free force norm over ring force norm.
    steps, newton_steps : Spread or None
        Pseudo-time steps after the ramp, quasi-Newton steps after them; None where not recorded.
    """

    thickness_um: float
    cells: int
    settled: int
    worst_residual: float
    steps: Spread | None
    newton_steps: Spread | None


@dataclass(frozen=True)
class Equilibrium:
    """How the realisations of a study settled.

    Attributes
    ----------
    tolerance : float
        Relative residual that the study asked for; NaN when its configuration does not say.
    unstable : int or None
        Realisations with a negative eigenvalue; None when the cube does not say.
    thicknesses : tuple of Settling
        Those with a recorded residual.
    cells : int
        Realisations in the sweep, failed ones among them.
    retried : int
        Those whose crumple is of another attempt than the first, with safer settings.
    """

    tolerance: float
    unstable: int | None
    thicknesses: tuple[Settling, ...]
    cells: int
    retried: int = 0

    @property
    def settled(self) -> int:
        """Realisations that are stable equilibria to the tolerance."""
        return sum(row.settled for row in self.thicknesses)

    @property
    def worst_residual(self) -> float:
        """Largest residual of all."""
        return max((row.worst_residual for row in self.thicknesses), default=np.nan)


def assess_equilibrium(cube: xr.Dataset, config: Mapping) -> Equilibrium:
    """Read from the cube how its realisations settled.

    Parameters
    ----------
    cube
        The study's result cube.
    config
        The study's configuration, for the tolerance and the length of the ramp.
    """
    options = config.get("relaxation", {})
    tolerance = options.get("residual_tolerance", np.nan)
    eigenvalues = _variable(cube, "negative_eigenvalues")
    residual = _variable(cube, "equilibrium_residual")
    settled = (residual <= tolerance) & (eigenvalues == 0)
    steps = _variable(cube, "steps")
    newton_steps = _variable(cube, "newton_steps")
    there = realised(cube)
    rows = []
    for thickness in cube["thickness"].values:
        at = {"thickness": thickness}
        residuals = Spread.of(residual.sel(at))
        if residuals:
            rows.append(
                Settling(
                    float(thickness),
                    int(there.sel(at).sum()),
                    int(settled.sel(at).sum()),
                    residuals.highest,
                    Spread.of(steps.sel(at) - ramp_steps(config, thickness)),
                    Spread.of(newton_steps.sel(at)),
                )
            )
    unstable = int((eigenvalues > 0).sum()) if np.isfinite(eigenvalues).any() else None
    retried = int((_variable(cube, "attempt") > 1).sum())
    return Equilibrium(float(tolerance), unstable, tuple(rows), int(there.sum()), retried)


def equilibrium_findings(equilibrium: Equilibrium) -> list[str]:
    """Say how many realisations are equilibria, and whether they are stable ones."""
    if not equilibrium.thicknesses:
        return []
    sentences = []
    if np.isfinite(equilibrium.tolerance) and equilibrium.unstable is not None:
        sentences.append(
            f"{equilibrium.settled} of {plural(equilibrium.cells, 'realisation')} reached the "
            f"relative residual of {number(equilibrium.tolerance, 1)} at a tangent without a "
            "negative eigenvalue: a stable equilibrium with the rings held."
        )
    sentences.append(
        f"The largest residual is {number(equilibrium.worst_residual, 2)} (free force norm over "
        "ring force norm)."
    )
    if equilibrium.unstable:
        sentences.append(
            f"{plural(equilibrium.unstable, 'realisation')} ended where the tangent has negative "
            "eigenvalues: no stable equilibrium."
        )
    elif equilibrium.unstable == 0:
        sentences.append("No tangent with the stress left in has a negative eigenvalue.")
    if equilibrium.retried:
        sentences.append(
            f"Of {plural(equilibrium.retried, 'crumple')} that failed as configured a further "
            "attempt with safer settings stands here (method.retries): mass, damping and ramp are "
            "not those of the rest; the record says which."
        )
    return sentences


def _variable(cube: xr.Dataset, name: str) -> xr.DataArray:
    """Variable of the cube, NaN where an older cube lacks it."""
    return cube[name] if name in cube else xr.full_like(cube["membrane_energy"], np.nan)
