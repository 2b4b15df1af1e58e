"""What the foil links do to a payload on mounts, in sentences."""

from __future__ import annotations

import pandas as pd

from foilstudy.base.numerals import fixed, nominal, number, percent, plural, stiffness
from foilstudy.config import Isolation
from foilstudy.measure.isolation import decibels
from foilstudy.present.statistics.mounts import static_spring

_MOUNT_WORDS = {"ideal": "the ideal mount", "resonant": "the mount with its own resonance"}


def isolation_findings(table: pd.DataFrame, options: Isolation) -> list[str]:
    """Say what is asked of the links, and which configurations keep to it.

    Parameters
    ----------
    table
        Table ``isolation.csv``.
    options
        The study's section ``isolation``.

    Returns
    -------
    list of str
        One paragraph on the demand and one per direction; empty without any usable realisation.
    """
    if not table["n"].any():
        return []
    return [_demand(table, options)] + [
        paragraph
        for direction in table["direction"].unique()
        if (paragraph := _kept(direction, table[table["direction"] == direction]))
    ]


def _demand(table: pd.DataFrame, options: Isolation) -> str:
    first = table.iloc[0]
    allowed, links = first["allowed_share"], int(first["links"])
    loss = fixed(float(decibels(1 + allowed)), 1)
    axial, radial = (static_spring(options, d).stiffness for d in ("axial", "radial"))
    return (
        f"A payload of {nominal(options.payload_mass_kg)} kg stands on mounts of "
        f"{stiffness(axial)} axially ({nominal(options.suspension_axial_hz)} Hz) and "
        f"{stiffness(radial)} radially ({nominal(options.suspension_radial_hz)} Hz). The transfer "
        f"stiffness of {plural(links, 'foil link')} is to stay below {percent(allowed)} of the "
        f"mount's up to {nominal(first['up_to_hz'])} Hz; well above the suspension frequency "
        f"that raises the motion of the payload by {loss} dB at most."
    )


def _kept(direction: str, cells: pd.DataFrame) -> str:
    cells = cells[cells["n"] > 0]
    if cells.empty:
        return ""
    parts = []
    for mount, rows in cells.groupby("mount", sort=False):
        kept = rows[rows["kept"]]
        text = f"{len(kept)} of {plural(len(rows), 'configuration')} on {_MOUNT_WORDS[mount]}"
        if len(kept):
            text += f", none thicker than {nominal(kept['thickness_um'].max())} µm"
        parts.append(text)
    text = f"{direction.capitalize()}, every realisation keeps to it in {'; in '.join(parts)}. "
    ideal = cells[cells["mount"] == "ideal"]
    at_rest = int((ideal["static_share_worst"] > ideal["allowed_share"]).sum())
    if at_rest:
        text += f"At rest already, some realisation does not in {at_rest}. "
    share = ideal["static_share_median"]
    low, high = number(100 * share.min(), 2), number(100 * share.max(), 2)
    return f"{text}The static stiffness of all links, median, is {low} to {high} % of the mount's."
