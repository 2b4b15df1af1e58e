"""Cylindrical roof between two diaphragms under its weight, in Koiter's linear shell theory.

Along the axis sines of m pi z / L, which the diaphragms allow; along the arc Legendre polynomials,
whose edges are free by themselves (Ritz). The strains are those of `theory_cylinder`, with the
roles of the two directions exchanged.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.study.verification.spectral import LineBasis
from foilstudy.study.verification.theory_cylinder import Cylinder


@dataclass(frozen=True)
class Roof:
    """An arc of a cylinder, straight edges free.

    Attributes
    ----------
    half_angle : float
        rad, from the crown to the edge.
    weight : float
        Vertical load per area, Pa.
    """

    cylinder: Cylinder
    half_angle: float
    weight: float


def edge_deflection(roof: Roof, terms: int = 60, functions: int = 24) -> float:
    """Downward deflection of a straight edge at mid-length, m.

    Parameters
    ----------
    terms, functions : int
        Sine terms, of which the even ones do nothing, and polynomials per displacement.
    """
    cylinder = roof.cylinder
    arc = 2 * roof.half_angle * cylinder.radius
    basis = LineBasis(functions, 0, arc, functions + 20)
    law = cylinder.law()
    derivatives = np.stack([basis.weighted(order) for order in range(3)])
    angle = basis.points / cylinder.radius - roof.half_angle
    # the load on the displacements along the axis, around and outwards
    direction = np.stack([0 * angle, np.sin(angle), -np.cos(angle)])
    load = roof.weight * (direction * basis.root_weights) @ derivatives[0].T
    edge = basis.end()
    down = np.stack([0 * edge, np.sin(roof.half_angle) * edge, -np.cos(roof.half_angle) * edge])
    total = 0.0
    for m in range(1, terms, 2):
        strains = np.einsum(
            "sck,kfg->sgcf", _strains(cylinder.radius, m * np.pi / cylinder.length), derivatives
        ).reshape(6, -1, 3 * functions)
        stiffness = np.einsum("sgi,st,tgj->ij", strains, law, strains, optimize=True)
        share = 4 / (m * np.pi)  # of an even load in this sine
        answer = np.linalg.solve(stiffness, share * load.ravel())
        total += np.sin(0.5 * m * np.pi) * down.ravel() @ answer
    return float(total)


def _strains(radius: float, p: float) -> np.ndarray:
    """Strain, component (along cos pz; around, outwards sin pz), derivative along the arc."""
    b = np.zeros((6, 3, 3))
    b[0, 0, 0] = -p
    b[1, 1, 1], b[1, 2, 0] = 1, 1 / radius
    b[2, 0, 1], b[2, 1, 0] = 1, p
    b[3, 2, 0] = -(p**2)
    b[4, 2, 2], b[4, 1, 1], b[4, 2, 0] = 1, -2 / radius, -1 / radius**2
    b[5, 2, 1], b[5, 1, 0] = 2 * p, -2 * p / radius
    return b
