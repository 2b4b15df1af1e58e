"""What of a real specimen and its clamps matters, and where its overlength goes."""
