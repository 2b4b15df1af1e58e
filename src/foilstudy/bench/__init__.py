"""From the signals of a test rig to a dynamic stiffness, and beside the simulated one.

`signals` that excite, `recording` of channels on disk, `estimation` of responses from them, `rig`:
a virtual one whose truth is known, `measured`: responses from files, `comparison` with a cube.
"""
