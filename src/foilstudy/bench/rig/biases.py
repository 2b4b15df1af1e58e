"""Known truth in, bias out: what each step of the published procedure and each fault of a rig does
to the static stiffness that is read in the end."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from foilstudy.base.ranges import require_count, require_number
from foilstudy.bench.estimation.best_linear import best_linear, measured_lines
from foilstudy.bench.estimation.estimate import Estimate
from foilstudy.bench.estimation.periods import Periods
from foilstudy.bench.estimation.procedure import Published
from foilstudy.bench.estimation.several import TransferMatrix, interface_lines, transfer_matrix
from foilstudy.bench.estimation.spectra import Blocks
from foilstudy.bench.estimation.static import STATIC_BAND_HZ
from foilstudy.bench.estimation.subtraction import without_bypass
from foilstudy.bench.rig.measurement import Measurement, measured
from foilstudy.bench.rig.rig import Rig
from foilstudy.bench.rig.specimens.absent import Absent
from foilstudy.bench.signals.multisine import Multisine

__all__ = ["Bias", "Drive", "Faults", "biases"]

_SIXES = 2
"""Realisations with six runs each, which scatter little."""


@dataclass(frozen=True)
class Drive:
    """Records that the table is made of.

    Attributes
    ----------
    rms : float
        Force of the shaker, N.
    high_hz : float
        Upper end of the multisine.
    period_s, duration_s, rate_hz : float
        The rate need not be that of the published work, as nothing lies above the band.
    realisations : int
        Of phases and noise.
    """

    rms: float = 5.0
    high_hz: float = 150.0
    period_s: float = 8.0
    duration_s: float = 64.0
    rate_hz: float = 1000.0
    realisations: int = 5

    def __post_init__(self) -> None:
        require_count("number of realisations", self.realisations, 2)

    def records(
        self, rig: Rig, realisations: int | None = None
    ) -> list[tuple[Measurement, np.ndarray]]:
        """A recording and the excited lines of each realisation, of all or so many."""
        found = []
        for k in range(realisations or self.realisations):
            signal = Multisine(0.0, self.high_hz, self.rms, self.period_s, realisation=k).signal()
            seed = 2 * k + isinstance(rig.specimen, Absent)  # other noise in the empty rig
            found.append((measured(rig, signal, self.rate_hz, self.duration_s, seed), signal.lines))
        return found

    def runs(self, rig: Rig) -> list[list[tuple[Measurement, np.ndarray]]]:
        """With the shaker at each of `Shaker.around`; by realisation, then by place."""
        places = (replace(rig, shaker=each) for each in rig.shaker.around())
        by_place = [self.records(each, _SIXES) for each in places]
        return [list(runs) for runs in zip(*by_place)]


@dataclass(frozen=True)
class Faults:
    """How bad a rig is when it has a fault; the published ones are not known.

    Attributes
    ----------
    bypass : float
        N/m, from the reaction mass of the shaker.
    turning_hz : tuple of float
        Frequencies of base and metrology frame about all axes where nothing guides them.
    offset_m : float
        Of the shaker from the axis, which makes them turn.
    tilt : float
        Share of gravity in accelerometers that tilt, on frames that turn.
    plate : float
        kg between force cells and upper ring.
    noise : float
        Factor on the noise of all sensors.
    """

    bypass: float = 100.0
    turning_hz: tuple[float, float] = (4.0, 1.5)
    offset_m: float = 0.02
    tilt: float = 1.0
    plate: float = 1.0
    noise: float = 10.0

    def __post_init__(self) -> None:
        require_number("offset of the shaker", self.offset_m, "m", least=0)

    def rigs(self, rig: Rig) -> dict[str, Rig]:
        """The rig with each fault alone, and with all of them."""
        x, y, z = rig.shaker.point
        bypass = {"shaker": {"bypass": self.bypass}}
        noise = {
            "sensors": {
                "acceleration_noise": self.noise * rig.sensors.acceleration_noise,
                "force_noise": self.noise * rig.sensors.force_noise,
            }
        }
        plate, tilt = {"sensors": {"plate": self.plate}}, {"sensors": {"tilt": self.tilt}}
        turning = {"shaker": {"point": (x + self.offset_m, y + self.offset_m, z)}}
        for name, hz in zip(("base", "metrology"), self.turning_hz):
            turning[name] = {"mount_hz": (*getattr(rig, name).mount_hz[:3], hz, hz, hz)}
        changes = {
            "noise": [noise],
            "bypass": [bypass],
            "plate": [plate],
            "turning": [turning],
            "tilt": [turning, tilt],
            "all": [noise, bypass, plate, turning, tilt],
        }
        return {name: _changed(rig, each) for name, each in changes.items()}


def _changed(rig: Rig, changes: list[dict[str, dict]]) -> Rig:
    """A rig with fields of its parts changed, one set after the other."""
    for change in changes:
        parts = {name: replace(getattr(rig, name), **fields) for name, fields in change.items()}
        rig = replace(rig, **parts)
    return rig


@dataclass(frozen=True)
class Bias:
    """The static stiffness that one way of processing reads from one rig.

    Attributes
    ----------
    rig : str
        Its fault: ``none`` or a key of `Faults.rigs`.
    processing : str
    value, deviation : float
        Mean and standard deviation over the realisations, N/m.
    truth : float
        Mean of the magnitude over the same band, N/m.
    coherence : float
        Median in that band.
    """

    rig: str
    processing: str
    value: float
    deviation: float
    truth: float
    coherence: float

    @property
    def percent(self) -> float:
        """Bias in per cent of the truth."""
        return 100 * (self.value / self.truth - 1)


_Processing = Callable[[Measurement, np.ndarray], Estimate]


def biases(
    rig: Rig,
    drive: Drive = Drive(),
    faults: Faults = Faults(),
    band_hz: tuple[float, float] = STATIC_BAND_HZ,
) -> Iterator[Bias]:
    """Each way of processing on the sound rig, and the three whole ones on each faulty rig.

    Parameters
    ----------
    rig : Rig
        Without faults.
    drive : Drive
    faults : Faults
    band_hz : tuple of float
        Where the static stiffness is read.
    """
    step = 1 / drive.period_s
    frequencies = np.arange(band_hz[0], band_hz[1] + step / 2, step)
    truth = float(np.abs(rig.truth(frequencies)).mean())
    ways = _ways(rig, drive)

    def estimates(of: Rig, chosen: Iterable[str]) -> dict[str, list[Estimate]]:
        records = drive.records(of)
        found = {way: [ways[way](*record) for record in records] for way in chosen}
        cut = Periods(drive.period_s)
        found["six runs"] = [
            _six_runs(runs, cut, rig.gap_m, band_hz[1]).along(rig.shaker.motion)
            for runs in drive.runs(of)
        ]
        return found

    def bias(fault: str, way: str, estimates: list[Estimate]) -> Bias:
        inside = [each.within(*band_hz) for each in estimates]
        values = [np.abs(each.values).mean() for each in inside]
        coherence = float(np.median([each.coherence for each in inside]))
        return Bias(
            fault, way, float(np.mean(values)), float(np.std(values, ddof=1)), truth, coherence
        )

    for way, found in estimates(rig, ways).items():
        yield bias("none", way, found)
    for fault, faulty in faults.rigs(rig).items():
        whole = "published", "periods"
        empty = estimates(faulty.emptied(), whole)
        for way, with_it in estimates(faulty, whole).items():
            yield bias(fault, way, with_it)
            taken_off = [without_bypass(*pair) for pair in zip(with_it, empty[way])]
            yield bias(fault, f"{way}, empty rig taken off", taken_off)


def _six_runs(
    runs: list[tuple[Measurement, np.ndarray]], cut: Periods, gap_m: float, highest_hz: float
) -> TransferMatrix:
    """Whole periods of runs with the shaker at six places."""
    means = [interface_lines(run, cut, gap_m, highest_hz) for run, _ in runs]
    return transfer_matrix(means, runs[0][1])


def _ways(rig: Rig, drive: Drive) -> dict[str, _Processing]:
    """Ways of processing, from the best one step by step to the published one."""
    motion, gap = rig.shaker.motion, rig.gap_m

    def periods(record: Measurement, lines: np.ndarray) -> Estimate:
        means = measured_lines(record, Periods(drive.period_s), motion, gap, drive.high_hz)
        return best_linear([means], lines).estimate

    def by(procedure: Published) -> _Processing:
        return lambda record, lines: procedure.estimate([record], motion, gap)

    synchronous = Blocks(drive.period_s, 0.5)
    return {
        "periods": periods,
        "periods, smoothed": lambda *record: Published().smoothed(periods(*record)),
        "blocks of a period": by(Published(synchronous, smooth_hz=0.0)),
        "blocks of 2 s": by(Published(smooth_hz=0.0)),
        "published": by(Published()),
        "published, H2": by(Published(estimator="h2")),
        "published, Hv": by(Published(estimator="hv")),
    }
