"""One realisation, from its task to its files."""

from foilstudy.realisation.crumple import crumple
from foilstudy.realisation.cylinder import cylinder_bounds
from foilstudy.realisation.respond import respond

__all__ = ["crumple", "cylinder_bounds", "respond"]
