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
            caution=(
                "it may diverge once folds stiffen the sheet, and takes more steps than there are"
                " where elements are small; use spectral"
            ),
        ),
        "nodal": Choice(
            "solve.relaxation.mass.nodal:NodalMassScaling",
            "each control point raised to what its own stability takes",
            caution=(
                "long waves become as heavy as the shortest, so that foil folds beside a ring that "
                "moves alone; use spectral"
            ),
        ),
        "selective": Choice(
            "solve.relaxation.mass.selective:SelectiveMassScaling",
            "off-diagonal terms that spare translations, solved iteratively",
            caution=(
                "it takes tens of times as long as the spectral mass and its iterations may not "
                "converge; use spectral"
            ),
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
            caution=(
                "it amplifies rounding, so that other machines crumple to other shapes; use "
                "adaptive_viscous"
            ),
        ),
        "fixed_viscous": Choice(
            "solve.relaxation.damping.fixed_viscous:FixedViscousDamping",
            "one coefficient",
            caution="one coefficient serves one frequency; use adaptive_viscous",
        ),
        "kinetic": Choice(
            "solve.relaxation.damping.kinetic:KineticDamping",
            "motion stopped where the kinetic energy peaks",
            caution=(
                "with lumped masses and the ring alone thin foil diverges and thick foil folds; "
                "use adaptive_viscous"
            ),
        ),
        "kinetic_reset": Choice(
            "solve.relaxation.damping.kinetic_reset:KineticResetDamping",
            "velocities cleared once the kinetic energy has fallen",
            caution="the motion breaks down; use adaptive_viscous",
        ),
        "none": Choice(
            "solve.relaxation.damping.none:NoDamping",
            "no damping",
            caution=(
                "the foil swings through many shapes before it rests in one; use adaptive_viscous"
            ),
        ),
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
            caution=(
                "in a short ramp the foil folds beside the ring instead of crumpling, without any "
                "sign of it; use relaxation"
            ),
        ),
        "installation": Choice(
            "solve.paths.installation:InstallationPath",
            "the same by the moves of `installation`, as a foil is fitted",
        ),
        "newton": Choice(
            "solve.paths.newton:NewtonPath",
            "equilibria at growing displacement by plain Newton; ends at the first buckling",
            caution="it ends where the cylinder buckles; use relaxation",
        ),
        "arc_length": Choice(
            "solve.paths.arc_length:ArcLengthPath",
            "equilibria along the arc length (Riks, Crisfield); ends after 1 to 4 % of the way",
            caution="it spends its factorisations within a few per cent of the way; use relaxation",
        ),
        "branch_switching": Choice(
            "solve.paths.branch_switching:BranchSwitchingPath",
            "the same, onto the branch of the lowest mode at bifurcations",
            caution="it spends its factorisations within a few per cent of the way; use relaxation",
        ),
        "minimisation": Choice(
            "solve.paths.minimisation:MinimisationPath",
            "stable equilibria at growing displacement, snaps along the lowest mode; slow",
            caution="it takes many times as long; use relaxation",
        ),
    },
)
