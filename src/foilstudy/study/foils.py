"""The foil of the published case, of which the side studies are made."""

from foilstudy.model.materials import material

FEP = material("FEP")
