"""Sparse symmetric factorisation and eigenpairs behind one face."""

from foilstudy.linalg.eigenpairs import (
    MODES_MAX,
    Modes,
    TooManyModes,
    lowest_modes,
    modes_below,
    shifted,
)
from foilstudy.linalg.errors import SolveError
from foilstudy.linalg.factorisation import Factorisation, backend, factorise
from foilstudy.linalg.krylov import BlockKrylov, mass_orthonormal

__all__ = [
    "MODES_MAX",
    "BlockKrylov",
    "Factorisation",
    "Modes",
    "SolveError",
    "TooManyModes",
    "backend",
    "factorise",
    "lowest_modes",
    "mass_orthonormal",
    "modes_below",
    "shifted",
]
