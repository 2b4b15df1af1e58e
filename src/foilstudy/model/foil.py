"""What is simulated, as plain data in SI units: foil and imperfection."""

from __future__ import annotations

from dataclasses import dataclass, field

from foilstudy.base.ranges import require_count, require_number
from foilstudy.model.materials import Material, material
from foilstudy.model.specimen import Specimen

DIAMETER_MAX = 10.0
"""m; a larger one is most likely in millimetres."""


@dataclass(frozen=True)
class Foil:
    """A foil rolled into a cylinder, to be pushed together into a gap; lengths in m.

    Attributes
    ----------
    diameter, reference_height : float
        Of the cylinder before it is crumpled.
    gap_height : float
    thickness : float
    material : Material
        Or the name of a known one.
    specimen : Specimen
        In what it departs from an even foil between true rings.
    """

    diameter: float
    reference_height: float
    gap_height: float
    thickness: float
    material: Material
    specimen: Specimen = field(default=Specimen(), repr=False)

    def __post_init__(self):
        for name in ("reference_height", "gap_height", "thickness"):
            what = f"{name.replace('_', ' ')} of a foil"
            require_number(what, getattr(self, name), "m", above=0)
        require_number("diameter of a foil", self.diameter, "m", above=0, most=DIAMETER_MAX)
        require_number("thickness of a foil", self.thickness, "m", below=self.diameter / 2)
        object.__setattr__(self, "material", material(self.material))

    def __repr__(self) -> str:
        return f"<Foil: {self}>"

    def __str__(self) -> str:
        return (
            f"{1e6 * self.thickness:g} µm {self.material.name or 'foil'}, diameter "
            f"{1e3 * self.diameter:g} mm, {1e3 * self.reference_height:g} mm in a gap of "
            f"{1e3 * self.gap_height:g} mm"
        )

    @property
    def overlength(self) -> float:
        """(h_ref - h_gap) / h_gap."""
        return (self.reference_height - self.gap_height) / self.gap_height

    @property
    def shortening(self) -> float:
        """h_ref - h_gap, m."""
        return self.reference_height - self.gap_height


SMOOTH_LENGTH_MIN = 0.7
"""Least correlation length of a smooth imperfection over the element size that resolves it."""


@dataclass(frozen=True)
class Imperfection:
    """Random deviation of the stress-free shape from a perfect cylinder.

    Attributes
    ----------
    kind : str
        A name of `foilstudy.model.imperfections.IMPERFECTIONS`.
    amplitude : float
        Standard deviation of each coordinate of a control point (of the radial one for buckling
        modes), m. The surface averages over neighbours: half of it for ``gaussian``. That of
        ``smoothed`` is the surface's own, away from the rings.
    correlation_length : float
        Standard deviation of the smoothing kernel of ``smoothed``, m; zero for the others.
    seed : int
        Of the realisation.
    removed : bool
        Whether it is taken out of the stress-free shape once the foil has buckled.
    """

    kind: str = "gaussian"
    amplitude: float = 10e-6
    correlation_length: float = 0.0
    seed: int = 0
    removed: bool = False

    def __post_init__(self):
        require_number("amplitude of an imperfection", self.amplitude, "m", least=0)
        length = self.correlation_length
        require_number("correlation length of an imperfection", length, "m", least=0)
        require_count("seed of an imperfection", self.seed, 0)

    def stream(self, foil: Foil) -> tuple[int, int, int]:
        """Key of the random stream: of seed, thickness (nm) and height (um), and nothing else.

        So a foil keeps its realisations when the sweep around it changes.
        """
        return self.seed, round(foil.thickness * 1e9), round(foil.reference_height * 1e6)
