"""Transfer stiffness as levels and one-third octaves, by hand."""

from dataclasses import replace

import numpy as np
import pytest

from foilstudy.base.errors import Refusal
from foilstudy.bench.estimation.best_linear import measured_lines
from foilstudy.bench.estimation.estimate import Estimate
from foilstudy.bench.estimation.periods import Periods
from foilstudy.bench.linearity import Driven, linearity
from foilstudy.bench.rig.measurement import measured
from foilstudy.bench.rig.rig import Rig
from foilstudy.bench.rig.specimens.nonlinear import NonlinearAxial
from foilstudy.bench.rig.specimens.spring import Spring
from foilstudy.bench.signals.multisine import Multisine
from foilstudy.bench.transfer_level import blocked, level, linear, third_octaves


def test_a_level_by_hand():
    assert np.allclose(level(np.array([1.0, -10j, 2000.0])), [0, 20, 66.0206], atol=1e-4)


def test_bands_by_hand():
    """90 to 112 Hz in 1 Hz is the band of 100 Hz, with ends 10^1.95 = 89.13 and 112.20 Hz."""
    f = np.arange(80.0, 121.0)
    k = np.where(f < 101, 1000.0, 2000.0)
    below, middle, above = third_octaves(f, k)
    assert middle.centre_hz == pytest.approx(100) and middle.lines == 23
    # 11 lines of 1000 N/m and 12 of 2000 N/m: mean square (11 + 48) / 23 of 1e6
    assert middle.level_db == pytest.approx(10 * np.log10(59e6 / 23))
    assert (below.lines, above.lines) == (10, 8)
    assert below.level_db == pytest.approx(60)


def test_a_band_of_few_lines_has_no_level():
    (band,) = third_octaves(np.array([98.0, 100.0, 102.0]), np.ones(3))
    assert band.lines == 3 and np.isnan(band.level_db)


def test_frequencies_that_are_not_even_are_refused():
    with pytest.raises(Refusal, match="evenly spaced"):
        third_octaves(np.geomspace(1, 100, 50), np.ones(50))


def test_blocking_and_linearity_at_their_limits():
    assert blocked(np.array([0.1, 0.11, 0.05j])).tolist() == [True, False, True]
    ratio = 10 ** (np.array([1.4, 1.6, -1.6]) / 20)
    assert linear(np.ones(3), ratio).tolist() == [True, False, False]


# --- linearity -----------------------------------------------------------------------------------

F = np.arange(10.0, 200.0)


def driven(size, power, coherence=1.0):
    full = np.ones(F.size)
    return Driven(Estimate(F, size * full + 0j, 0 * full, coherence * full), power * full)


def test_a_specimen_that_stiffens_is_told_from_one_that_does_not():
    weak = driven(1000.0, 1e-12)
    assert linearity(weak, driven(1000 * 10 ** (1.4 / 20), 1e-11)).holds
    harder = np.where(F < 50, 1000.0, 1200.0)  # 1.58 dB
    found = linearity(weak, driven(harder, 1e-11))
    assert not found.holds and found.judged.all()
    assert found.apart_db == pytest.approx(np.full(found.centres.size, 10.0))
    assert found.linear.tolist() == [f < 51 for f in found.centres]
    assert found.change_db[-1] == pytest.approx(20 * np.log10(1.2))


def test_bands_with_inputs_too_close_are_not_judged():
    weak, power = driven(1000.0, 1e-12), np.where(F < 60, 1e-11, 5e-12)
    found = linearity(weak, driven(np.where(F < 60, 1000.0, 2000.0), power))
    assert found.holds and found.judged.sum() < found.centres.size
    with pytest.raises(Refusal, match="at most 7.0 dB apart"):
        linearity(weak, driven(1000.0, 5e-12))


def test_incoherent_frequencies_do_not_count_for_linearity():
    weak = driven(1000.0, 1e-12)
    doubtful = driven(np.where(F < 30, 1000.0, 5000.0), 1e-11, np.where(F < 30, 1.0, 0.5))
    found = linearity(weak, doubtful)
    assert found.holds and found.centres[-1] < 33
    with pytest.raises(Refusal, match="no frequency is coherent in both"):
        linearity(weak, driven(1000.0, 1e-11, 0.5))
    with pytest.raises(Refusal, match="other frequencies"):
        other = replace(weak.estimate, frequencies=F + 1)
        linearity(weak, Driven(other, weak.power))


def test_a_cubic_link_of_the_virtual_rig_is_linear_only_when_driven_weakly():
    """k + 3 c sigma^2 under Gaussian motion (Bussgang): 2 per mille at 0.1 mm, most at 1 mm."""
    k, cubic = 2000.0, 1e8

    def run(rms):
        gap = 0.13
        link = Spring(axial=k, radial=k, rocking=50.0, torsion=50.0, gap_m=gap)
        motion = np.linspace(-1e-2, 1e-2, 801)
        specimen = NonlinearAxial(link, motion, k * motion + cubic * motion**3)
        force = Multisine(2.0, 40.0, rms=rms, period_s=4.0).signal()
        made = measured(Rig(specimen, gap), force, 256.0, 16.0)
        return Driven.of(measured_lines(made, Periods(4.0), 2, gap, 40.0), force.lines)

    weak, middle, strong = (run(rms) for rms in (0.05, 0.5, 30.0))
    assert linearity(weak, middle).holds
    hard = linearity(middle, strong)
    assert not hard.holds and hard.change_db.max() > 1.5
    assert np.abs(strong.estimate.values).mean() > 1.2 * np.abs(weak.estimate.values).mean()
