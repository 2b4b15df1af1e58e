"""How a realisation can end."""

STATUSES = ("converged", "not_converged", "diverged", "failed")
"""From best to worst."""

USABLE = ("converged", "not_converged")
"""Those that leave a shape, whose numbers enter the statistics."""

NOT_NEEDED = "not_needed"
"""In a cube, of a seed that this configuration did not take, though another one did: no outcome."""
