"""What localised shapes are like: their stiffness, and what they cost."""

from __future__ import annotations

import numpy as np

from foilstudy.plot import style
from foilstudy.study.kernel.plan import Records
from foilstudy.study.specimen.plan import (
    LAWS,
    MERIDIANS,
    OVERLENGTHS_PERCENT,
    SHARED_PERCENT,
    SHARES,
)
from foilstudy.study.specimen.tables import measured_stiffness, of_seeds, stiffness


@style.styled
def chart(records: Records):
    """Stiffness of drawn shapes beside the measured laws; energy by where the shortening goes."""
    figure = style.new_figure(style.PAGE_WIDTH, 3.2)
    axial, radial, cost = figure.subplots(1, 3)
    drawn = {(c.meridian, c.overlength_percent, c.size_mm): r.result
             for c, r in records["drawn"].items()}  # fmt: skip
    finest = min(size for _, _, size in drawn)
    for direction, ax in enumerate((axial, radial)):
        name = ("axial", "radial")[direction]
        for meridian in MERIDIANS:
            values = [
                stiffness(drawn[meridian, percent, finest])[direction]
                for percent in OVERLENGTHS_PERCENT
            ]
            label = meridian.replace("_", " ")
            ax.loglog(OVERLENGTHS_PERCENT, 1e-3 * np.array(values), "o-", ms=3, label=label)
        fit = [1e-3 * measured_stiffness(name, percent) for percent in OVERLENGTHS_PERCENT]
        ax.loglog(OVERLENGTHS_PERCENT, fit, "k--", label="measured fit")
        ax.set_xlabel("overlength, %")
        ax.set_ylabel(f"{name} stiffness, kN/m")
    axial.legend(fontsize=6)
    _costs(cost, records)
    return figure


def _costs(ax, records: Records) -> None:
    """Energy and work used up over those of the foil that is left free."""
    lines = {"elastic": "o-", "plastic": "s--"}
    for law in LAWS:
        for percent in SHARED_PERCENT:
            means = [
                np.mean(
                    [
                        each["energy"] + each["dissipated_work"]
                        for each in of_seeds(records, law, share, percent)
                        if "energy" in each
                    ]
                    or [np.nan]
                )
                for share in SHARES
            ]
            ax.plot(range(len(SHARES)), np.array(means) / means[0], lines[law], ms=3,
                    label=f"{law}, {percent:g} %")  # fmt: skip
    ax.set_xticks(range(len(SHARES)), [share.replace("_", "\n") for share in SHARES])
    ax.set_ylabel("energy and work over the free foil's")
    ax.legend(fontsize=6)
