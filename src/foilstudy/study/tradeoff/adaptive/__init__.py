"""Would an adaptive mesh pay? What a given crumple would save with elements of several sizes.

`sensor` says where the energy error of a uniform mesh is, `sizes` which elements have the same
error with the fewest, `measure` asks both of a crumple and of the ramp that led to it, `present`
shows it.
"""
