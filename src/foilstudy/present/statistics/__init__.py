"""Laws fitted to the cube, their uncertainty, and their comparison with published values."""
