"""What the convergence study is held against.

Published: M. Bader, Structural Dynamics of Crumpled Thin Sheets, TU Delft, 2026. The energies are
not: they were computed for this project, for the published case (500 um, h_ref 0.17 m), by an
established explicit code with the published kind of element, a 4-node shell with reduced
integration (QEPH), weakly mass-scaled.
"""

QEPH_5MM_J = (5.04, 4.74, 4.83)
"""Three seeds."""
QEPH_2MM5_J = 4.31
RUNTIME_EXPONENT = {500: -2.54, 50: -2.74}
"""Of the run time against element size, by thickness in um."""
