"""Sparse symmetric factorisation and eigenpairs behind one face."""

from foilstudy.linalg.eigenpairs import Modes, modes_below
from foilstudy.linalg.errors import SolveError
from foilstudy.linalg.factorisation import Factorisation, backend, factorise

__all__ = ["Factorisation", "Modes", "SolveError", "backend", "factorise", "modes_below"]
