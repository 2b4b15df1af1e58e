"""Which elements are compared, and in what."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.study.elements.variants import VARIANTS
from foilstudy.study.kernel.plan import Lazy, Part, Study, results

DEFAULT = "corner_1"
"""The element of the default configuration."""
BASELINE = "one_point_0p05"
"""The one-point element with the default stabilisation, against which costs count."""
_VARIANTS = tuple(VARIANTS)
COARSE_MM = 5.0
"""Element size on which elements are compared."""


@dataclass(frozen=True)
class Frozen:
    """A crumple made with the default element on 5 mm, whose shape every element measures."""

    thickness_um: int


@dataclass(frozen=True)
class Fine:
    """Crumples by the default element on a finer mesh."""

    size_mm: float


FROZEN = tuple(map(Frozen, (50, 250, 500, 1000)))
"""On 5 mm elements t/h = 0.01 to 0.2."""
FINE = tuple(map(Fine, (2.5, 1.25)))

_HERE = "foilstudy.study.elements"

STUDY = Study(
    name="elements",
    title="element variants, error against cost",
    parts=(
        Part("fine", FINE, Lazy(f"{_HERE}.crumpling:fine_crumples"), memory_mb=2000, priority=3),
        Part(
            "frozen",
            FROZEN,
            Lazy(f"{_HERE}.frozen:frozen_shape"),
            arrays=("points",),
            memory_mb=4000,
            priority=2,
        ),
        Part(
            "buckled",
            (DEFAULT,),
            Lazy(f"{_HERE}.buckled:reference_energies"),
            memory_mb=2000,
            priority=2,
        ),
        Part(
            "variants",
            _VARIANTS,
            Lazy(f"{_HERE}.errors:variant_errors"),
            needs={"frozen": lambda variant: FROZEN},
        ),
        Part("crumples", _VARIANTS, Lazy(f"{_HERE}.crumpling:crumples")),
        # Last, and alone on its core: ratios within one run, but a full machine blurs them.
        Part("cost", (BASELINE,), Lazy(f"{_HERE}.cost:costs"), priority=-1),
    ),
    findings=results,
    tables={
        "elements.csv": Lazy(f"{_HERE}.summary:rows"),
        "elements.md": Lazy(f"{_HERE}.summary:page"),
    },
    figures={"elements": Lazy(f"{_HERE}.chart:draw")},
)
