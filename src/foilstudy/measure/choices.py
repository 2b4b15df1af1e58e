"""What there is to choose from in measuring: one file each, one line here."""

from foilstudy.base.registry import Choice, Registry

STRESS_REMOVALS = Registry(
    "stress removal",
    {
        "reset": Choice(
            "measure.stiffness.stress_removal:Reset",
            "the crumpled shape is taken as stress-free, exactly",
        )
    },
)
REDUCTIONS = Registry(
    "reduction",
    {
        "rational_krylov": Choice(
            "measure.dynamics.reductions.rational_krylov:RationalKrylov",
            "chooses its order from the tolerance",
        ),
        "hintz_herting": Choice(
            "measure.dynamics.reductions.hintz_herting:HintzHerting",
            "keeps the free modes up to `cutoff_hz`, as published",
        ),
        "craig_bampton": Choice(
            "measure.dynamics.reductions.craig_bampton:CraigBampton",
            "keeps the clamped modes up to `cutoff_hz`",
        ),
        "guyan": Choice("measure.dynamics.reductions.guyan:Guyan", "quasi-static"),
    },
)
MODAL_REDUCTIONS = ("hintz_herting", "craig_bampton")
"""Reductions that have a cut-off."""
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
