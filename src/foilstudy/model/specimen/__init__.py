"""In what a specimen departs from an even foil between true rings: plain data in SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_count, require_number
from foilstudy.model.supports.moves import GAP_MIN

__all__ = ["Clamps", "Seam", "Specimen", "Unevenness"]

FACTOR_MAX = 20.0
"""Of thickness or modulus: beyond it the seam is another body."""
DEVIATION_MAX = 0.25
"""Of the thickness; at `CUT` times it half the foil is left."""
CUT = 2.0
"""Standard deviations at which the thickness field is cut off."""
TILT_MAX = 0.2
"""rad."""
ELLIPTICITY_MAX = 0.2
"""Over the radius: beyond it a ring bent without stretching is no ellipse."""
SLIP_MAX = 0.05
"""Over the gap: what comes out of a clamp stands as straight as in it."""


@dataclass(frozen=True)
class Seam:
    """A strip along the height, of other thickness or modulus; its middle lies on the x axis.

    Attributes
    ----------
    width : float
        m; zero for none.
    thickness_factor, modulus_factor : float
        Of the foil's. Yield stress and hardening are in the proportion of the modulus.
    """

    width: float = 0.0
    thickness_factor: float = 1.0
    modulus_factor: float = 1.0

    def __post_init__(self):
        require_number("width of a seam", self.width, "m", least=0)
        for name in ("thickness_factor", "modulus_factor"):
            what = f"{name.replace('_', ' ')} of a seam"
            require_number(what, getattr(self, name), above=0, most=FACTOR_MAX)


@dataclass(frozen=True)
class Unevenness:
    """A smooth random field of thickness, cut off at twice its deviation to either side.

    Attributes
    ----------
    deviation : float
        Standard deviation, before the cut, over the thickness; zero for an even foil.
    correlation_length : float
        Standard deviation of the smoothing kernel, m.
    seed : int
        The field is the same on every mesh.
    """

    deviation: float = 0.0
    correlation_length: float = 0.03
    seed: int = 0

    def __post_init__(self):
        require_number("deviation of a thickness", self.deviation, least=0, most=DEVIATION_MAX)
        length = self.correlation_length
        require_number("correlation length of a thickness", length, "m", above=0)
        require_count("seed of a thickness", self.seed, 0)


@dataclass(frozen=True)
class Clamps:
    """Rings out of true, from before the foil is pushed together, and clamps that let it slip.

    Attributes
    ----------
    ellipticity : float
        By how much both rings are wider along x, and narrower along y, than their mean radius, m.
    tilt : float
        Of the top ring about y, rad.
    slip : float
        As far as the foil may slip along itself, out of a clamp or into it, m; with zero it is
        held.
    grip : float
        Line force along the foil that a clamp that lets slip bears without, N/m.
    """

    ellipticity: float = 0.0
    tilt: float = 0.0
    slip: float = 0.0
    grip: float = 1000.0

    def __post_init__(self):
        require_number("slip in a clamp", self.slip, "m", least=0)
        require_number("grip of a clamp", self.grip, "N/m", least=0)
        require_number("ellipticity of a ring", self.ellipticity, "m")
        require_number("tilt of a ring", self.tilt, "rad", least=-TILT_MAX, most=TILT_MAX)

    @property
    def true(self) -> bool:
        """Whether both rings are round and level."""
        return not (self.ellipticity or self.tilt)

    def beyond(self, radius: float, gap: float) -> str:
        """Why rings of a radius, m, cannot stand so, in words that follow a subject; or nothing."""
        most = ELLIPTICITY_MAX * radius
        if abs(self.ellipticity) > most:
            return (
                f"bends rings of a radius of {1e3 * radius:.4g} mm by "
                f"{1e3 * abs(self.ellipticity):.4g} mm; keep it to {1e3 * most:.3g} mm"
            )
        if self.slip > SLIP_MAX * gap:
            return (
                f"lets the foil slip by {1e3 * self.slip:.3g} mm, which is much of a gap of "
                f"{1e3 * gap:.4g} mm; keep it to {1e3 * SLIP_MAX * gap:.3g} mm"
            )
        lower = (radius + abs(self.ellipticity)) * math.sin(abs(self.tilt))
        if gap - lower < GAP_MIN * gap:
            return (
                f"brings the rings to {1e3 * (gap - lower):.3g} mm from each other; keep them "
                f"{1e3 * GAP_MIN * gap:.3g} mm apart"
            )
        return ""


@dataclass(frozen=True)
class Specimen:
    """What a real foil and its clamps have and the ideal ones have not; all off by default.

    Attributes
    ----------
    seam : Seam
    unevenness : Unevenness
    clamps : Clamps
    gravity : float
        Acceleration against the axis, from the top ring to the bottom one, m/s2.
    """

    seam: Seam = Seam()
    unevenness: Unevenness = Unevenness()
    clamps: Clamps = Clamps()
    gravity: float = 0.0

    def __post_init__(self):
        require_number("gravity on a specimen", self.gravity, "m/s2")

    @property
    def even(self) -> bool:
        """Whether thickness and modulus are the same everywhere."""
        return not (self.seam.width or self.unevenness.deviation)

    def require_even(self, what: str) -> None:
        """Refuse what knows one thickness and one modulus only.

        Raises
        ------
        Refusal
        """
        if not self.even:
            raise Refusal(
                f"{what} knows one thickness and one modulus; leave out the seam and the "
                "deviation of the thickness."
            )
