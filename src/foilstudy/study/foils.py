"""The foil of the published case, of which the side studies are made."""

from __future__ import annotations

from foilstudy.config.scene import material_of
from foilstudy.model.materials import MATERIALS

FEP = material_of(MATERIALS["FEP"])
