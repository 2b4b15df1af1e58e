"""The files for other tools of a study configuration."""

from __future__ import annotations

from typing import Literal

from .sections import Section, unit_field

__all__ = ["Export"]


class Export(Section):
    """Files for other tools, of every realisation; changing it computes no physics again.

    They are written to `results/NAME/realisations/THICKNESS/HEIGHT/SEED/export/`, see
    `docs/exchange.md`.
    """

    formats: tuple[Literal["nc", "mat", "uff", "csv", "vtu", "npz", "inp"], ...] = unit_field(
        "list of choices",
        "`nc`, `mat`: reduced model for Python and MATLAB; `uff`, `csv`: dynamic stiffness as "
        "Universal File and table; `vtu`, `npz`: crumpled shape for ParaView and NumPy; `inp`: "
        "shell model for CalculiX.",
        (),
        strict=False,
    )
