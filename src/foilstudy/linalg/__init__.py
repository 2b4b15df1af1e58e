"""Sparse symmetric factorisation and eigenpairs behind one face."""

from foilstudy.linalg.eigenpairs import Modes, lowest_modes, modes_below
from foilstudy.linalg.errors import SolveError
from foilstudy.linalg.factorisation import Factorisation, backend, factorise
from foilstudy.linalg.krylov import BlockKrylov, mass_orthonormal

__all__ = [
    "BlockKrylov",
    "Factorisation",
    "Modes",
    "SolveError",
    "backend",
    "factorise",
    "lowest_modes",
    "mass_orthonormal",
    "modes_below",
]
