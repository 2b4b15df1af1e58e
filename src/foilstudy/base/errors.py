"""Errors that a user of the package is meant to read."""

from __future__ import annotations

__all__ = ["ConfigError", "Refusal"]


class Refusal(ValueError):
    """What was asked for cannot be done: one sentence that says what, where and what to do.

    Any other `ValueError` is a bug, or a fault of a caller in Python, and keeps its traceback.
    """


class ConfigError(Refusal):
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
