"""A dozen foils drawn from all that a configuration may hold, extreme corners included.

The last is 0.27 um thin on elements of 64 mm, where rounding holds its rings a little.

`benchmarks/random_configurations.py` draws as many as one likes.
"""

import importlib.util
from pathlib import Path

import pytest

_SCRIPT = Path(__file__).parents[1] / "benchmarks" / "random_configurations.py"


def _script():
    spec = importlib.util.spec_from_file_location("random_configurations", _SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("seed", [*range(100, 111), 354])
def test_a_random_foil_is_crumpled_and_measured_or_says_why_not(seed, tmp_path):
    script = _script()
    result = script.outcome(script.drawn(seed), tmp_path)
    assert result["problems"] == []


def test_what_is_wrong_is_noticed():
    script = _script()
    failed = {"status": "failed", "message": "SolveError: why"}
    assert script.problems({}, failed, {}) == ["SolveError: why"]
    values = {
        "static_stiffness": [1.0, 2.0],
        "eigenfrequency": [10.0],
        "frequency": [1e-3, 1.0],
        "dynamic_stiffness_re": [[[1.2, 1.0], [2.0, 1.0]]],
    }
    values = {key: script.np.array(value) for key, value in values.items()}
    settled = {"status": "converged", "message": ""}
    dynamics = {"damping": "modal", "tolerance": 1e-3}
    (problem,) = script.problems(values, settled, dynamics)
    assert "2.0e-01 off the static stiffness" in problem
