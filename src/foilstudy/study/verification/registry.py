"""Which benchmarks there are, and for which elements, by name.

Names alone, so that a workflow can list them without importing what computes them.
"""

from __future__ import annotations

from importlib import import_module

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


def run(name: str, element: str):
    """Compute one benchmark with one element.

    Parameters
    ----------
    name : str
        A key of `MODULES`.
    element : str
        One of `ELEMENT_NAMES`.

    Returns
    -------
    records.Benchmark

    Raises
    ------
    KeyError
        If there is no such benchmark or element.
    """
    if name not in MODULES:
        raise KeyError(f"no benchmark {name!r}: choose one of {', '.join(MODULES)}")
    if element not in ELEMENT_NAMES:
        raise KeyError(f"no element {element!r}: choose one of {', '.join(ELEMENT_NAMES)}")
    from foilstudy.study.verification.candidates import CANDIDATES

    module = import_module(f"foilstudy.study.verification.{MODULES[name]}")
    return module.BENCHMARKS[name](CANDIDATES[element])
