"""Failures of the linear algebra."""


class SolveError(RuntimeError):
    """A factorisation failed or a solution does not satisfy its equations."""
