"""Ways to reduce a structure: one file each, all of the protocol `Reduction`."""

from foilstudy.measure.dynamics.reductions.craig_bampton import CraigBampton
from foilstudy.measure.dynamics.reductions.guyan import Guyan
from foilstudy.measure.dynamics.reductions.hintz_herting import HintzHerting
from foilstudy.measure.dynamics.reductions.rational_krylov import RationalKrylov

__all__ = ["CraigBampton", "Guyan", "HintzHerting", "RationalKrylov"]
