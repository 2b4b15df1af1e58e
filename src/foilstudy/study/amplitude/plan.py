"""Which crumples are swept and which of their modes are looked at."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.study.kernel.plan import Lazy, Part, Study, results
from foilstudy.study.published import HEIGHT_MM, THICKNESSES_UM

SIZE_MM, COARSE_MM = 5.0, 10.0
"""Of the elements of sweeps; of those of time integrations, each of which takes thousands of steps
a period."""
RAMP_SLOWNESS = 10.0
"""A quarter of that of a study: any shape of these coarse meshes will do."""
SEED = 0
MOTIONS = {500: ("axial", "radial_x", "tilt_x", "twist"), 50: ("axial", "radial_x")}
"""By thickness; thin foil snaps often, and each snap takes as long as a sweep without."""
SEEDS = tuple(range(6))
"""Crumples of which it is asked how far they are linear. From the smallest to the largest of six is
an interval of their median of 97 %, of whatever shape their distribution is."""
SPREAD_MOTIONS = ("axial", "radial_x")
AMPLITUDE_MM = 1.0
MODES = 3
RELEASED_MM = (0.2,)
"""Largest displacements from which modes are let go."""
PERIODS = 4.2


@dataclass(frozen=True)
class Shape:
    """A crumple of the default method, in a ramp of `RAMP_SLOWNESS`, and the default imperfection.

    Attributes
    ----------
    thickness_um, height_mm : int
        Of the foil and of the uncrumpled cylinder.
    size_mm : float
        Element size asked for.
    seed : int
    """

    thickness_um: int
    height_mm: int
    size_mm: float
    seed: int


@dataclass(frozen=True)
class State:
    """A crumple as it is or free of stress.

    Attributes
    ----------
    prestressed : bool
    """

    thickness_um: int
    height_mm: int
    size_mm: float
    seed: int
    prestressed: bool

    @property
    def shape(self) -> Shape:
        """The crumple."""
        return Shape(self.thickness_um, self.height_mm, self.size_mm, self.seed)

    @property
    def words(self) -> str:
        """For people."""
        state = "pre-stressed" if self.prestressed else "stress-free"
        return f"{self.thickness_um} um, {state}"


@dataclass(frozen=True)
class Sweep(State):
    """One motion of the ring of a crumple.

    Attributes
    ----------
    motion : str
        See `foilstudy.pipeline.amplitude.MOTIONS`.
    """

    motion: str


@dataclass(frozen=True)
class Letting(State):
    """A mode of a crumple that is let go.

    Attributes
    ----------
    mode : int
        From 1.
    displacement_mm : float
        Largest of a control point.
    """

    mode: int
    displacement_mm: float


def _states(thicknesses: tuple[int, ...], size_mm: float, seed: int = SEED) -> list[State]:
    return [
        State(thickness, HEIGHT_MM, size_mm, seed, stressed)
        for thickness in thicknesses
        for stressed in (False, True)
    ]


STATES = tuple(_states(THICKNESSES_UM, SIZE_MM))
SPREADS = tuple(
    Sweep(**vars(state), motion=motion)
    for seed in SEEDS
    for state in _states(THICKNESSES_UM, SIZE_MM, seed)
    for motion in SPREAD_MOTIONS
)
SWEEPS = tuple(
    Sweep(**vars(state), motion=motion)
    for state in STATES
    for motion in MOTIONS[state.thickness_um]
)
LETTINGS = tuple(
    Letting(**vars(state), mode=mode, displacement_mm=displacement)
    for state in _states(THICKNESSES_UM[:1], COARSE_MM)
    for mode in range(1, MODES + 1)
    for displacement in RELEASED_MM
)

_HERE = "foilstudy.study.amplitude"
_NEEDS = {"shapes": lambda case: [case.shape]}

STUDY = Study(
    name="amplitude",
    title="how far the stiffness holds",
    parts=(
        Part(
            "shapes",
            tuple(dict.fromkeys(case.shape for case in (*SWEEPS, *SPREADS, *LETTINGS))),
            Lazy(f"{_HERE}.measure:crumple_shape"),
            arrays=("points",),
        ),
        Part("sweeps", SWEEPS, Lazy(f"{_HERE}.measure:sweep"), needs=_NEEDS),
        Part("spreads", SPREADS, Lazy(f"{_HERE}.measure:spread"), needs=_NEEDS),
        Part("modes", STATES, Lazy(f"{_HERE}.measure:modes"), needs=_NEEDS),
        Part("releases", LETTINGS, Lazy(f"{_HERE}.measure:release"), needs=_NEEDS),
    ),
    findings=results,
    tables={
        "sweeps.csv": Lazy(f"{_HERE}.tables:steps"),
        "linear.csv": Lazy(f"{_HERE}.tables:linear"),
        "spreads.csv": Lazy(f"{_HERE}.tables:spreads"),
        "modes.csv": Lazy(f"{_HERE}.tables:modes"),
        "releases.csv": Lazy(f"{_HERE}.tables:releases"),
        "amplitude.md": Lazy(f"{_HERE}.tables:page"),
    },
    figures={name: Lazy(f"{_HERE}.figures:{name}") for name in ("stiffness", "backbones")},
)
