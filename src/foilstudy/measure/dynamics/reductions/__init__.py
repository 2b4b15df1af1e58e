"""Ways to reduce a structure: one file each, all of the protocol `Reduction`."""
