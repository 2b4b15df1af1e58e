"""A virtual rig whose truth is known: frames, shaker, specimen, sensors, and their signals."""
