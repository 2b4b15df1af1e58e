"""What a reduced model is worth beyond its band, and what modal damping is worth under stress.

A foil dissipates with its elastic strains. The stress that holds a crumple, mostly compression,
takes off the stiffness of a motion and none of its dissipation: of a mode phi with the elastic
stiffness K_e and the tangent K_t the loss factor is that of the material times
phi.K_e phi / phi.K_t phi, one without stress. Modal damping gives every mode the same.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from foilstudy.linalg import lowest_modes
from foilstudy.measure.dynamics import (
    Reduction,
    StructuralDamping,
    Structure,
    Wanted,
    directional_stiffness,
    dynamic_stiffness,
    full_order,
    relative_error,
)
from foilstudy.measure.dynamics.reductions.craig_bampton import CraigBampton
from foilstudy.measure.dynamics.reductions.guyan import Guyan
from foilstudy.measure.dynamics.reductions.hintz_herting import HintzHerting
from foilstudy.measure.dynamics.reductions.rational_krylov import RationalKrylov
from foilstudy.model.foil import Imperfection
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.method import Mesh
from foilstudy.pipeline.structures import prestressed_structure, stress_free_structure
from foilstudy.study.limits.bounds import Vibrating
from foilstudy.study.limits.trial import baseline
from foilstudy.study.published import foil

OVER_CUTOFF = (0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 4.0)
"""Frequencies at which a reduced model is held against the truth, over its cut-off."""
TOLERANCE = 1e-3
LOSS_FACTOR = 0.1
MODES = 20


def measure(case: Vibrating) -> dict:
    """Crumple, reduce, and hold against the full order; modes with and without the stress.

    Returns
    -------
    dict
        ``status``; ``over_cutoff``; ``reductions``: by name ``size``, ``estimate``,
        ``valid_to_hz`` and ``errors`` (largest relative one of the definitions of dynamic
        stiffness); ``eigenfrequencies`` and ``stressed_eigenfrequencies``, Hz; ``loss``: loss
        factor of the stressed modes over that of the material.
    """
    sheet = foil(case.thickness_um, case.height_mm)
    mesh, imperfection = Mesh(case.size_mm * 1e-3), Imperfection(seed=case.seed)
    crumpled = crumple(sheet, mesh, imperfection, baseline(sheet))
    if crumpled.status != "converged":
        return {"status": crumpled.status}
    structure, stressed = stress_free_structure(crumpled), prestressed_structure(crumpled)
    elastic, heavy = structure.stiffness.interior, structure.mass.interior
    free = lowest_modes(elastic, heavy, structure.static.factor, MODES)
    held = lowest_modes(stressed.stiffness.interior, heavy, stressed.static.factor, MODES)
    dissipating = np.einsum("ij,ij->j", held.shapes, elastic @ held.shapes)
    return {
        "status": crumpled.status,
        "over_cutoff": list(OVER_CUTOFF),
        "reductions": _reductions(structure, case.cutoff_hz),
        "eigenfrequencies": _hertz(free.eigenvalues),
        "stressed_eigenfrequencies": _hertz(held.eigenvalues),
        "loss": list(map(float, dissipating / held.eigenvalues)),
    }


def _hertz(eigenvalues: np.ndarray) -> list[float]:
    return list(map(float, np.sqrt(eigenvalues) / (2 * np.pi)))


def _reductions(structure: Structure, cutoff: float) -> dict[str, dict]:
    """Each is made for a cut-off, and asked how far it is valid in four times as wide a band."""
    damping, grid = StructuralDamping(LOSS_FACTOR), cutoff * np.array(OVER_CUTOFF)
    wide = Wanted(TOLERANCE, highest_hz=grid[-1], damping=damping)
    narrow = Wanted(TOLERANCE, highest_hz=cutoff, damping=damping)
    made: dict[str, Reduction] = {
        "guyan": Guyan(wide),
        "craig_bampton": CraigBampton(cutoff, wide),
        "hintz_herting": HintzHerting(cutoff, wide),
        "rational_krylov": RationalKrylov(narrow),
    }
    truth = directional_stiffness(full_order(structure, grid, damping))
    found = {}
    for name, reduction in made.items():
        model = reduction.reduce(structure)
        everywhere = replace(model, valid_to_hz=np.nan)
        errors = relative_error(dynamic_stiffness(everywhere, grid, damping), truth)
        found[name] = {
            "size": model.size,
            "estimate": float(model.error_estimate),
            "valid_to_hz": float(model.valid_to_hz),
            "errors": list(map(float, errors.max(axis=(0, 1)))),
        }
    return found
