"""What there is to choose from in measuring: one file each, one line here."""

from dataclasses import dataclass

from foilstudy.base.registry import Choice, Registry

CLOSED_CONTACTS = ("normal", "rigid", "stuck")
"""What closed contacts may do in a small motion beside opening, see
`measure.stiffness.contacts.ContactBracket`."""


@dataclass(frozen=True)
class ReductionChoice(Choice):
    """A reduction.

    Attributes
    ----------
    has_cutoff : bool
        Whether it keeps the modes up to a frequency.
    """

    has_cutoff: bool = False


STRESS_REMOVALS = Registry(
    "stress removal",
    {
        "reset": Choice(
            "measure.stiffness.stress_removal:Reset",
            "the crumpled shape is taken as stress-free, exactly",
        ),
        "johnson_cook": Choice(
            "measure.stiffness.stress_flow:JohnsonCook",
            "rate-dependent flow in the held shape, as published; leaves residual stress",
        ),
        "zerilli_armstrong": Choice(
            "measure.stiffness.stress_flow:ZerilliArmstrong",
            "flow by temperature in the held shape, as published for solids; the same residue",
        ),
    },
)
REDUCTIONS = Registry(
    "reduction",
    {
        "rational_krylov": ReductionChoice(
            "measure.dynamics.reductions.rational_krylov:RationalKrylov",
            "chooses its order from the tolerance",
        ),
        "hintz_herting": ReductionChoice(
            "measure.dynamics.reductions.hintz_herting:HintzHerting",
            "keeps the free modes up to `cutoff_hz`, as published",
            has_cutoff=True,
        ),
        "craig_bampton": ReductionChoice(
            "measure.dynamics.reductions.craig_bampton:CraigBampton",
            "keeps the clamped modes up to `cutoff_hz`",
            has_cutoff=True,
        ),
        "guyan": ReductionChoice("measure.dynamics.reductions.guyan:Guyan", "quasi-static"),
    },
)
AIRS = Registry(
    "surrounding air",
    {
        "none": Choice("measure.air.vacuum:Vacuum", "vacuum"),
        "added_mass": Choice(
            "measure.air.added_mass:AddedMass",
            "air moves with the foil on both sides, without friction, as about a cylinder",
        ),
        "added_mass_true_surface": Choice(
            "measure.air.true_surface:TrueSurface",
            "as about the crumpled surface, between open ends; for at most 6 000 elements",
        ),
    },
)
ENCLOSURES = Registry(
    "enclosed air",
    {
        "vented": Choice(
            "measure.air.enclosures:Vented", "its mean pressure is that outside, by an opening"
        ),
        "sealed_isothermal": Choice(
            "measure.air.enclosures:SealedIsothermal",
            "it is compressed and keeps its temperature, as far below 0.01 Hz",
        ),
        "sealed_adiabatic": Choice(
            "measure.air.enclosures:SealedAdiabatic",
            "it is compressed and warms, as above 0.1 Hz",
        ),
    },
)
STRUCTURAL_DAMPINGS = Registry(
    "damping",
    {
        "modal": Choice(
            "measure.dynamics.damping:ModalDamping",
            "the same share of the critical damping in every mode, as published",
        ),
        "structural": Choice(
            "measure.dynamics.damping:StructuralDamping", "a loss factor of twice that share"
        ),
        "rayleigh": Choice(
            "measure.dynamics.damping:RayleighDamping", "that share at `rayleigh_hz`"
        ),
    },
)
