"""What there is to choose from in crumpling: one file each, one line here."""

from foilstudy.base.registry import Choice, Registry

MASSES = Registry(
    "mass scaling",
    {
        "spectral": Choice(
            "solve.relaxation.mass.spectral:SpectralMassScaling",
            "bounds the stiffness of the sheet at every wavelength",
        )
    },
)
DAMPINGS = Registry(
    "damping of the relaxation",
    {
        "adaptive_viscous": Choice(
            "solve.relaxation.damping.adaptive_viscous:AdaptiveViscousDamping",
            "in proportion to the frequency of the current motion, averaged over steps",
        )
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
        "newton": Choice(
            "solve.paths.newton:NewtonPath",
            "equilibria at growing displacement by plain Newton; ends at the first buckling",
        ),
        "arc_length": Choice(
            "solve.paths.arc_length:ArcLengthPath",
            "equilibria along the arc length (Riks, Crisfield); ends after 1 to 4 % of the way",
        ),
        "branch_switching": Choice(
            "solve.paths.branch_switching:BranchSwitchingPath",
            "the same, onto the branch of the lowest mode at bifurcations",
        ),
        "minimisation": Choice(
            "solve.paths.minimisation:MinimisationPath",
            "stable equilibria at growing displacement, snaps along the lowest mode; slow",
        ),
    },
)
