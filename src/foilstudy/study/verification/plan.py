"""Which benchmarks there are, and with which elements."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module

from foilstudy.study.kernel import Lazy, Part, Study

MODULES = {
    "rigid_motions": "linear",
    "plates": "linear",
    "scordelis_lo": "linear",
    "pinched_cylinder": "linear",
    "plate_frequencies": "frequencies",
    "clamped_cylinder": "frequencies",
    "diaphragm_cylinder": "frequencies",
    "free_cylinder": "frequencies",
    "axial_buckling": "stability",
    "cantilever_end_shear": "nonlinear",
    "cantilever_roll_up": "nonlinear",
    "open_cylinder_pull_out": "nonlinear",
    "pinched_clamped_cylinder": "nonlinear",
    "slit_annular_plate": "nonlinear",
}
"""Module of this package whose ``BENCHMARKS`` has the benchmark, in the order of the table."""

ELEMENT_NAMES = ("corner", "one_point")
"""Keys of `candidates.CANDIDATES`, the default element of the studies first."""


@dataclass(frozen=True)
class Trial:
    """One benchmark with one element.

    Attributes
    ----------
    benchmark : str
        A key of `MODULES`.
    element : str
        One of `ELEMENT_NAMES`.
    """

    benchmark: str
    element: str


def run(trial: Trial):
    """Compute one benchmark with one element.

    Returns
    -------
    records.Benchmark
    """
    from foilstudy.study.verification.candidates import CANDIDATES

    module = import_module(f"foilstudy.study.verification.{MODULES[trial.benchmark]}")
    return module.BENCHMARKS[trial.benchmark](CANDIDATES[trial.element])


_HERE = "foilstudy.study.verification"

STUDY = Study(
    name="verify",
    title="the shell against theory and publications",
    folder="verification",
    parts=(
        Part(
            "benchmarks",
            # for the table: the elements of one benchmark follow each other
            tuple(Trial(name, element) for name in MODULES for element in ELEMENT_NAMES),
            run,
            memory_mb=2000,
        ),
    ),
    tables={
        "verification.csv": Lazy(f"{_HERE}.summary:rows"),
        "verification.md": Lazy(f"{_HERE}.summary:page"),
    },
    figures={f"figures/{name}": Lazy(f"{_HERE}.figures:draw_one", (name,)) for name in MODULES},
    findings=Lazy(f"{_HERE}.summary:benchmarks_of"),
    problems=Lazy(f"{_HERE}.summary:problems"),
)
