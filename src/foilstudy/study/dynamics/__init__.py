"""Reductions held against the full-order truth: error against order and cost."""
