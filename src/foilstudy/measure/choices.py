"""What there is to choose from in measuring: one file each, one line here."""

from dataclasses import dataclass

from foilstudy.base.registry import Choice, Registry


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
