"""Transfer stiffness as levels and one-third octaves, by hand."""

import numpy as np
import pytest

from foilstudy.base.errors import Refusal
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
