"""How a realisation can end."""

STATUSES = ("converged", "not_converged", "diverged", "failed")
"""From best to worst."""

USABLE = ("converged", "not_converged")
"""Those that leave a shape, whose numbers enter the statistics."""
