"""Error of an element where theory knows the answer and bending dominates."""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh

from foilstudy.model.patch import Patch, cylinder_control_points
from foilstudy.model.shell.shell import Shell
from foilstudy.model.shell.tangent import mass_matrix
from foilstudy.solve.loading.path import follow_load
from foilstudy.study.elements.variants import Variant
from foilstudy.study.published import FEP, HEIGHT, RADIUS
from foilstudy.study.verification.candidates import Candidate
from foilstudy.study.verification.frequencies import circumferential_orders
from foilstudy.study.verification.nonlinear import ROLL_UP
from foilstudy.study.verification.theory_cylinder import FREE, Cylinder, frequencies

SLENDERNESS = (0.01, 0.02, 0.05, 0.1, 0.2)
"""Thickness over element size."""

_AROUND, _ALONG = 16, 4
"""A ring as coarse as a crumple is at its ridges: R = 2.5 h."""
_ORDERS = (2, 3)
ROLL_UP_ELEMENTS = 16


def ring_error(variant: Variant, slenderness: float) -> float:
    """Relative error of the bending stiffness of a free ring of 16 elements.

    The lowest two pairs of modes of a free cylinder bend it without stretching; the square of their
    frequencies is the stiffness. Held against Koiter's theory (`verification.theory_cylinder`).

    Returns
    -------
    float
        Root mean square over the modes.
    """
    size = 2 * np.pi * RADIUS / _AROUND
    thickness = slenderness * size
    patch = Patch(_AROUND, _ALONG, size, HEIGHT / _ALONG)
    points = cylinder_control_points(patch, 2 * RADIUS)
    sheet = Shell.elastic(patch, points, FEP, thickness, variant.element)
    cylinder = Cylinder(RADIUS, HEIGHT, thickness, FEP)
    mass = mass_matrix(patch, FEP.density * thickness * sheet.section.areas)
    eigenvalues, shapes = eigh(sheet.tangent().toarray(), mass.toarray())
    orders = circumferential_orders(patch, points, shapes)
    errors = []
    for n in _ORDERS:
        exact = (2 * np.pi * frequencies(cylinder, FREE, n, 1)[0]) ** 2
        errors.append(eigenvalues[orders == n][0] / exact - 1)
    return float(np.sqrt(np.mean(np.square(errors))))


def roll_up_error(variant: Variant) -> float:
    """Relative error of the end deflection of a strip of 16 elements, half rolled up.

    Sze, Liu and Lo 2004, see `verification.nonlinear`; half the load makes a half circle.

    Returns
    -------
    float
        NaN where no equilibrium is found.
    """
    candidate = Candidate(variant.label, variant.element, edge_order=1.0)
    loaded = ROLL_UP.build(candidate, ROLL_UP_ELEMENTS)
    factors = [f for f in ROLL_UP.factors if f <= 0.5]
    path = follow_load(loaded, factors)
    if path.status != "converged":
        return np.nan
    probe = ROLL_UP.probes[0]
    exact = probe.published[ROLL_UP.factors.index(0.5)]
    return abs(probe.read(loaded, path.equilibria[-1].points) / exact - 1)
