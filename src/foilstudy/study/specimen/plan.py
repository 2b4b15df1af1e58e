"""Which scenes, drawn shapes and ways to share the shortening are compared."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

from foilstudy.study.kernel.plan import Lazy, Part, Study

THICKNESS_UM, HEIGHT_MM, SIZE_MM = 500, 170, 5.0
"""Of all crumples; the drawn shapes have finer meshes."""
SCENES = ("plain", "seam", "heavy_seam", "uneven", "oval", "tilt", "slip", "loose", "weight")
SCENE_SEEDS = 6
OVERLENGTHS_PERCENT = (3.8, 15.4, 30.8, 53.8, 92.3)
"""Of the published study."""
MERIDIANS = ("pleat", "two_pleats", "three_pleats", "concertina")
SHARED_PERCENT = (3.8, 15.4, 30.8)
LAWS = ("elastic", "plastic")
SHARES = ("whole", "half", "third", "ring_alone")
"""Of the height that takes the shortening between clamped ends; in the last it is free to choose,
but the top ring moves alone."""
SHARED_SEEDS = 2


@dataclass(frozen=True)
class Scene:
    """A specimen of one kind.

    Attributes
    ----------
    scene : str
        One of `SCENES`.
    seed : int
        Of imperfection and thickness.
    """

    scene: str
    seed: int


@dataclass(frozen=True)
class Drawn:
    """A shape drawn by hand.

    Attributes
    ----------
    meridian : str
        One of `MERIDIANS`.
    overlength_percent : float
    size_mm : float
        Element size along.
    """

    meridian: str
    overlength_percent: float
    size_mm: float


@dataclass(frozen=True)
class Shared:
    """A crumple whose shortening is left to a share of the height.

    Attributes
    ----------
    law, share : str
        Of `LAWS` and `SHARES`.
    overlength_percent : float
        Of the whole.
    seed : int
    """

    law: str
    share: str
    overlength_percent: float
    seed: int


_HERE = "foilstudy.study.specimen"

STUDY = Study(
    name="specimen",
    title="what of a real specimen matters",
    parts=(
        Part(
            "scenes",
            tuple(Scene(scene, seed) for seed in range(SCENE_SEEDS) for scene in SCENES),
            Lazy(f"{_HERE}.crumples:scene"),
        ),
        Part(
            "drawn",
            tuple(Drawn(*case) for case in product(MERIDIANS, OVERLENGTHS_PERCENT, (2.5, 1.25))),
            Lazy(f"{_HERE}.shapes:measure"),
        ),
        Part(
            "shared",
            tuple(
                Shared(*case) for case in product(LAWS, SHARES, SHARED_PERCENT, range(SHARED_SEEDS))
            ),
            Lazy(f"{_HERE}.crumples:shared"),
        ),
    ),
    tables={
        "scenes.csv": Lazy(f"{_HERE}.tables:scene_rows"),
        "drawn.csv": Lazy(f"{_HERE}.tables:drawn_rows"),
        "shared.csv": Lazy(f"{_HERE}.tables:shared_rows"),
        "specimen.md": Lazy(f"{_HERE}.tables:page"),
    },
    figures={"localisation": Lazy(f"{_HERE}.figures:chart")},
)
