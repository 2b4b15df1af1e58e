"""Time signals in MATLAB variables: ``signals`` (samples, channels), ``rate_Hz``, ``names`` and
``units`` (cells of text)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.files import written_whole
from foilstudy.bench.measured.matlab import variables
from foilstudy.bench.signal_files.signals import Signals

__all__ = ["FORMAT"]

_NEEDED = ("signals", "rate_Hz", "names", "units")


class _Matlab:
    """See `SignalFormat`."""

    def read(self, path: Path) -> Signals:
        content = variables(path)
        if not content.keys() >= set(_NEEDED):
            there = ", ".join(k for k in content if not k.startswith("__")) or "nothing"
            raise Refusal(f"{path}: holds {there}, not {', '.join(_NEEDED)}; save these four.")
        names, units = (
            tuple(map(str.strip, map(str, np.atleast_1d(content[each]))))
            for each in ("names", "units")
        )
        values = np.asarray(content["signals"], float)
        values = values[:, None] if values.ndim == 1 else values
        if not values.ndim == 2 or not values.shape[1] == len(names) == len(units):
            raise Refusal(
                f"{path}: signals of shape {values.shape} do not belong to {len(names)} names and "
                f"{len(units)} units; give a column of samples for each."
            )
        return Signals(names, units, float(content["rate_Hz"]), np.ascontiguousarray(values.T))

    def write(self, signals: Signals, path: Path) -> None:
        from scipy.io import savemat

        names, units = (np.array(each, dtype=object) for each in (signals.names, signals.units))
        content = {
            "signals": signals.values.T,
            "rate_Hz": signals.rate_hz,
            "names": names,
            "units": units,
        }
        with written_whole(path) as partial, partial.open("wb") as file:
            savemat(file, content)


FORMAT = _Matlab()
