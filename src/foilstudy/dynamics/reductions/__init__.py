"""Ways to reduce a structure: one file each, all of the protocol `Reduction`."""

from foilstudy.dynamics.reductions.craig_bampton import CraigBampton
from foilstudy.dynamics.reductions.guyan import Guyan
from foilstudy.dynamics.reductions.hintz_herting import HintzHerting
from foilstudy.dynamics.reductions.rational_krylov import RationalKrylov

__all__ = ["CraigBampton", "Guyan", "HintzHerting", "RationalKrylov"]
