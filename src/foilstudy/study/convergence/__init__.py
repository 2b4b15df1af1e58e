"""How the crumple, its energy and its stiffness depend on the mesh and on when it is stopped."""
