"""Errors that a user of the package is meant to read."""

from __future__ import annotations

__all__ = ["ConfigError"]


class ConfigError(ValueError):
    """A study configuration that cannot be run.

    Parameters
    ----------
    *problems : str
        One sentence per problem: where, what is wrong, what to do.

    Attributes
    ----------
    problems : tuple of str
        The same sentences; the text of the error has one per line.
    """

    def __init__(self, *problems: str) -> None:
        super().__init__("\n".join(problems))
        self.problems = problems
