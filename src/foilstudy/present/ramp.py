"""The ramp in which the foils of a cube were crumpled, and which of them it hurried."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from foilstudy.config.haste import RAMPED, haste
from foilstudy.config.sections import Relaxation
from foilstudy.present.configuration import configuration

__all__ = ["haste_findings", "ramp_steps"]


def ramp_steps(config: Mapping[str, Any], thickness_um: float) -> float:
    """Steps of the ramp of one thickness; NaN where the configuration does not say."""
    if "relaxation" not in config or "sheet" not in config:
        return np.nan
    relaxation = Relaxation.model_validate(config["relaxation"])
    return relaxation.resolved(1e3 * config["sheet"]["diameter_mm"] / 2 / thickness_um).ramp_steps


def haste_findings(cube: xr.Dataset) -> list[str]:
    """What is known of foils that the ramp hurried; nothing if it hurried none."""
    config = configuration(cube)
    if config.get("method", {}).get("path", RAMPED[0]) not in RAMPED or "sheet" not in config:
        return []
    steps = {t: ramp_steps(config, t) for t in map(float, cube["thickness"].values)}
    said = haste(steps, config["sheet"]["diameter_mm"] / 2, "µm")
    return [said] if said else []
