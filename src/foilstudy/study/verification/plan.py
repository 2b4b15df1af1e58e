"""Which benchmarks there are, and with which elements."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.study.kernel.plan import Lazy, Part, Study

_HERE = "foilstudy.study.verification"

BENCHMARKS = {
    "rigid_motions": Lazy(f"{_HERE}.linear:rigid_motions"),
    "plates": Lazy(f"{_HERE}.linear:plates"),
    "scordelis_lo": Lazy(f"{_HERE}.linear:scordelis_lo"),
    "pinched_cylinder": Lazy(f"{_HERE}.linear:pinched_cylinder"),
    "plate_frequencies": Lazy(f"{_HERE}.frequencies:plate_frequencies"),
    "clamped_cylinder": Lazy(f"{_HERE}.frequencies:cylinder_frequencies", ("clamped",)),
    "diaphragm_cylinder": Lazy(f"{_HERE}.frequencies:cylinder_frequencies", ("diaphragm",)),
    "free_cylinder": Lazy(f"{_HERE}.frequencies:cylinder_frequencies", ("free",)),
    "axial_buckling": Lazy(f"{_HERE}.stability:axial_buckling"),
    "cantilever_end_shear": Lazy(f"{_HERE}.nonlinear:END_SHEAR.run"),
    "cantilever_roll_up": Lazy(f"{_HERE}.nonlinear:ROLL_UP.run"),
    "open_cylinder_pull_out": Lazy(f"{_HERE}.nonlinear:OPEN_CYLINDER.run"),
    "pinched_clamped_cylinder": Lazy(f"{_HERE}.nonlinear:PINCHED_CYLINDER.run"),
    "slit_annular_plate": Lazy(f"{_HERE}.nonlinear:SLIT_ANNULUS.run"),
}
"""Functions of the element under test that return a `records.Benchmark`; in the table's order."""

ELEMENT_NAMES = ("corner", "one_point")
"""Keys of `candidates.CANDIDATES`, the default element of the studies first."""


@dataclass(frozen=True)
class Trial:
    """One benchmark with one element.

    Attributes
    ----------
    benchmark : str
        A key of `BENCHMARKS`.
    element : str
        One of `ELEMENT_NAMES`.
    """

    benchmark: str
    element: str


def run(trial: Trial):
    """Compute one benchmark with one element."""
    from foilstudy.study.verification.candidates import CANDIDATES

    return BENCHMARKS[trial.benchmark](CANDIDATES[trial.element])


STUDY = Study(
    name="verify",
    title="the shell against theory and publications",
    folder="verification",
    parts=(
        Part(
            "benchmarks",
            # for the table: the elements of one benchmark follow each other
            tuple(Trial(name, element) for name in BENCHMARKS for element in ELEMENT_NAMES),
            run,
            memory_mb=2000,
        ),
    ),
    tables={
        "verification.csv": Lazy(f"{_HERE}.summary:rows"),
        "verification.md": Lazy(f"{_HERE}.summary:page"),
    },
    figures={f"figures/{name}": Lazy(f"{_HERE}.figures:draw_one", (name,)) for name in BENCHMARKS},
    findings=Lazy(f"{_HERE}.summary:benchmarks_of"),
    problems=Lazy(f"{_HERE}.summary:problems"),
)
