"""Sparse symmetric factorisation and eigenpairs behind one face."""

from foilstudy.linalg.blocks import BlockPattern, SymmetricBlocks
from foilstudy.linalg.dissection import dissection
from foilstudy.linalg.eigenpairs import (
    MODES_MAX,
    Modes,
    TooManyModes,
    largest_eigenvalue,
    lowest_modes,
    modes_below,
    shifted,
)
from foilstudy.linalg.errors import SolveError
from foilstudy.linalg.factorisation import Factorisation, backend, factorise
from foilstudy.linalg.krylov import BlockKrylov, mass_orthonormal, projected
from foilstudy.linalg.updated import Updated, combined, updated

__all__ = [
    "MODES_MAX",
    "BlockKrylov",
    "BlockPattern",
    "SymmetricBlocks",
    "Factorisation",
    "Modes",
    "SolveError",
    "TooManyModes",
    "Updated",
    "backend",
    "combined",
    "dissection",
    "factorise",
    "largest_eigenvalue",
    "lowest_modes",
    "mass_orthonormal",
    "modes_below",
    "projected",
    "shifted",
    "updated",
]
