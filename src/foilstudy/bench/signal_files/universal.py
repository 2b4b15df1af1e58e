"""Time signals in a Universal File: a dataset 58 or 58b of type 1 for each channel.

A channel is named by its first ID line; its unit is that of its axis label, or follows from its
data type (acceleration 12, force 13) and the factors of a dataset 164. Text has twelve digits,
58b all; both give the time step to six.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.files import written_whole
from foilstudy.bench.measured.universal import datasets
from foilstudy.bench.recording import ACCELERATION, FORCE
from foilstudy.bench.signal_files.signals import Signals, whole_rate

__all__ = ["FORMAT"]

_TIME_RESPONSE, _TIME = 1, 17
_TYPES = {12: ACCELERATION, 13: FORCE}
_STEP_DIGITS = 5e-6


class _Universal:
    """See `SignalFormat`."""

    def read(self, path: Path) -> Signals:
        functions, units = datasets(path)
        found = [each for each in functions if each["func_type"] == _TIME_RESPONSE]
        if not found:
            raise Refusal(f"{path}: holds no time response (dataset 58 of type 1); export them so.")
        names = tuple(each["id1"].strip() for each in found)
        if len(set(names)) < len(names):
            twice = next(name for name in names if names.count(name) > 1)
            raise Refusal(
                f"{path}: several channels are called {twice!r}; name each in its first ID line."
            )
        first = found[0]
        for each in found[1:]:
            if _sampling(each) != _sampling(first):
                raise Refusal(
                    f"{path}: channels {names[0]} and {each['id1'].strip()} were not sampled "
                    "together (start, step or number of samples differ); export one recording."
                )
        step = float(first["abscissa_inc"])
        if not first["abscissa_spacing"] or not step > 0:
            raise Refusal(
                f"{path}: its times are not evenly spaced; export them with a fixed step."
            )
        values = np.array([each["data"].real for each in found])
        read_units, sizes = zip(*(_unit(path, each, units) for each in found))
        values = values * np.array(sizes)[:, None] if any(s != 1 for s in sizes) else values
        return Signals(names, read_units, whole_rate(1 / step, _STEP_DIGITS), values)

    def write(self, signals: Signals, path: Path) -> None:
        import pyuff

        times = np.arange(signals.values.shape[1]) / signals.rate_hz
        types = {unit: kind for kind, unit in _TYPES.items()}
        common = {
            "type": 58, "func_type": _TIME_RESPONSE, "binary": 1, "x": times,
            "rsp_dir": 0, "ref_node": 0, "ref_dir": 0, "abscissa_spacing": 1,
            "abscissa_spec_data_type": _TIME, "abscissa_axis_lab": "Time",
            "abscissa_axis_units_lab": "s", "orddenom_spec_data_type": 0,
        }  # fmt: skip
        sets = [
            common
            | {"id1": name, "data": row, "rsp_node": k + 1, "ordinate_axis_units_lab": unit}
            | {"ordinate_spec_data_type": types.get(unit, 0)}
            for k, (name, unit, row) in enumerate(zip(signals.names, signals.units, signals.values))
        ]
        with written_whole(path) as partial:
            # its mode "overwrite" loses the head of a binary set
            pyuff.UFF(str(partial)).write_sets(sets, "add")


FORMAT = _Universal()


def _sampling(function: dict) -> tuple:
    names = ("abscissa_min", "abscissa_inc", "abscissa_spacing", "num_pts")
    return tuple(function[each] for each in names)


def _unit(path: Path, function: dict, units: list[dict]) -> tuple[str, float]:
    """Unit of a channel, and what its values have to be multiplied by to be in it."""
    label = function["ordinate_axis_units_lab"].strip()
    if label not in ("", "NONE"):
        return label, 1.0
    kind, name = function["ordinate_spec_data_type"], function["id1"].strip()
    if not units or kind not in _TYPES:
        raise Refusal(
            f"{path}: channel {name} states no unit, neither on its axis nor by its data type "
            f"({kind}) with a dataset 164; export it with one."
        )
    factor = units[0]["length" if kind == 12 else "force"]  # from SI
    return _TYPES[kind], 1 / factor
