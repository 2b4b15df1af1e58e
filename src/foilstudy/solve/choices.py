"""What there is to choose from in crumpling: one file each, one line here."""

from foilstudy.base.registry import Choice, Registry

MASSES = Registry(
    "mass scaling",
    {
        "spectral": Choice(
            "solve.relaxation.mass.spectral:SpectralMassScaling",
            "bounds the stiffness of the sheet at every wavelength",
        ),
        "courant": Choice(
            "solve.relaxation.mass.courant:CourantMass",
            "no scaling, physical mass and the Courant step",
        ),
        "nodal": Choice(
            "solve.relaxation.mass.nodal:NodalMassScaling",
            "each control point raised to what its own stability takes",
        ),
        "selective": Choice(
            "solve.relaxation.mass.selective:SelectiveMassScaling",
            "off-diagonal terms that spare translations, solved iteratively",
        ),
    },
)
DAMPINGS = Registry(
    "damping of the relaxation",
    {
        "adaptive_viscous": Choice(
            "solve.relaxation.damping.adaptive_viscous:AdaptiveViscousDamping",
            "in proportion to the frequency of the current motion, averaged over steps",
        ),
        "adaptive_viscous_plain": Choice(
            "solve.relaxation.damping.adaptive_viscous_plain:PlainAdaptiveViscousDamping",
            "the same without the average",
        ),
        "fixed_viscous": Choice(
            "solve.relaxation.damping.fixed_viscous:FixedViscousDamping",
            "one coefficient",
        ),
        "kinetic": Choice(
            "solve.relaxation.damping.kinetic:KineticDamping",
            "motion stopped where the kinetic energy peaks",
        ),
        "kinetic_reset": Choice(
            "solve.relaxation.damping.kinetic_reset:KineticResetDamping",
            "velocities cleared once the kinetic energy has fallen",
        ),
        "none": Choice("solve.relaxation.damping.none:NoDamping", "no damping"),
    },
)
SEARCHES = Registry(
    "search for the minimum",
    {
        "quasi_newton": Choice(
            "solve.equilibrium.newton:minimise",
            "quasi-Newton steps on a factored tangent, its negative eigenvalues counted",
        )
    },
)
PATHS = Registry(
    "path",
    {
        "relaxation": Choice(
            "solve.paths.relaxation:RelaxationPath",
            "the top ring closes the gap in a ramp while the sheet relaxes, then it settles",
        ),
        "ring_alone": Choice(
            "solve.paths.ring_alone:RingAlonePath",
            "the same without spreading the ring's motion over the height, as explicit codes do",
        ),
    },
)
