"""What the jobs of the element study write, and reading it back."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from foilstudy.base.files import written_whole
from foilstudy.study.elements.bending import SLENDERNESS, ring_error, roll_up_error
from foilstudy.study.elements.buckled import buckled
from foilstudy.study.elements.frozen import FrozenShape, frozen_errors
from foilstudy.study.elements.scene import micrometres
from foilstudy.study.elements.variants import VARIANTS


@dataclass(frozen=True)
class VariantErrors:
    """Relative errors of one variant; NaN where it found no answer. Thicknesses in micrometres.

    Attributes
    ----------
    ring : dict of str to float
        By slenderness t/h.
    roll_up : float
    frozen : dict of str to (axial, radial)
        By thickness; 5 mm mesh against refined.
    buckled : float
        Energy of the post-buckled panel, 5 mm mesh, J.
    """

    ring: dict[str, float]
    roll_up: float
    frozen: dict[str, tuple[float, float]]
    buckled: float


def measure(name: str, shapes: list[FrozenShape]) -> VariantErrors:
    """Everything that one variant does with a given shape or a given path."""
    variant = VARIANTS[name]
    return VariantErrors(
        {f"{s:g}": ring_error(variant, s) for s in SLENDERNESS},
        roll_up_error(variant),
        {str(micrometres(s.thickness)): frozen_errors(variant, s) for s in shapes},
        buckled(variant).energy,
    )


def write(record, path: str | Path) -> None:
    """Write a dataclass of numbers as JSON, NaN as null."""
    with written_whole(path) as partial:
        text = json.dumps(_without_nan(asdict(record)), indent=1)
        partial.write_text(text + "\n")


def read(path: str | Path) -> dict:
    """What `write` has written, null as NaN."""
    return _with_nan(json.loads(Path(path).read_text()))


def write_shape(shape: FrozenShape, path: str | Path) -> None:
    """Write a crumpled shape with its refined stiffness."""
    with written_whole(path) as partial, partial.open("wb") as file:
        np.savez_compressed(file, **asdict(shape))


def read_shape(path: str | Path) -> FrozenShape:
    """What `write_shape` has written."""
    with np.load(path) as values:
        return FrozenShape(float(values["thickness"]), values["points"], values["referees"])


def _without_nan(value):
    if isinstance(value, dict):
        return {key: _without_nan(item) for key, item in value.items()}
    if isinstance(value, (tuple, list)):
        return [_without_nan(item) for item in value]
    return None if isinstance(value, float) and np.isnan(value) else value


def _with_nan(value):
    if isinstance(value, dict):
        return {key: _with_nan(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_with_nan(item) for item in value]
    return np.nan if value is None else value
