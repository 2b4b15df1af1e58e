"""The elements on which the foils of a cube were crumpled, and on which their shapes are others."""

from __future__ import annotations

import xarray as xr

from foilstudy.config.width import wide
from foilstudy.present.configuration import configuration
from foilstudy.present.statistics.trust import assess_trust

__all__ = ["width_findings"]


def width_findings(cube: xr.Dataset) -> list[str]:
    """What is known of foils on elements as wide as these; nothing where finer ones do nothing."""
    if configuration(cube).get("mesh", {}).get("element", "corner") != "corner":
        return []
    widths = assess_trust(cube).slenderness.max("overlength")
    said = wide(dict(zip(widths["thickness"].values.tolist(), widths.values.tolist())), "µm")
    return [said] if said else []
