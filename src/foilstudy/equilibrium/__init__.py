"""Static equilibrium of a sheet with edges and loads: paths, minima and buckling."""
