"""How far the stiffness of the published foil holds: rings swept, modes at finite amplitude."""
