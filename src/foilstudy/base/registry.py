"""Registries: what there is to choose from, by name, loaded on use.

A registry lists names, the words that say what each means, and where the code stands. Reading the
list imports none of that code, so that a configuration, its schema and its reference page can be
made from it at once.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from importlib import import_module
from typing import Any

from foilstudy.base.errors import Refusal

__all__ = ["Choice", "Registry", "UnknownChoice", "did_you_mean"]


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """``did you mean NAME? `` with the known name closest to another one, or nothing."""
    folded = {each.casefold(): each for each in known}
    close = get_close_matches(str(name).casefold(), folded, n=1)
    return f"did you mean {folded[close[0]]}? " if close else ""


class UnknownChoice(Refusal, KeyError):
    """A name that a registry does not have; the text says which ones it has."""

    def __str__(self) -> str:
        return str(self.args[0])


@dataclass(frozen=True)
class Choice:
    """One entry of a registry.

    Attributes
    ----------
    place : str
        ``module:attribute``, the module relative to the package.
    words : str
        What it is, for a reference page: the end of a sentence that begins with its name.
    caution : str
        What fails with it and what to take instead, for whoever chooses it: a clause.
    """

    place: str
    words: str
    caution: str = field(default="", kw_only=True)

    def load(self) -> Any:
        """The attribute itself."""
        module, _, attribute = self.place.partition(":")
        return getattr(import_module(f"foilstudy.{module}"), attribute)


class Registry(Mapping[str, Any]):
    """Choices of one kind by name; an item is loaded when it is asked for.

    Parameters
    ----------
    kind : str
        What the choices are, in the singular: ``element``.
    choices : mapping of str to Choice
        In the order of tables and messages.
    """

    def __init__(self, kind: str, choices: Mapping[str, Choice]) -> None:
        self.kind = kind
        self.choices = dict(choices)

    def __getitem__(self, name: str) -> Any:
        return self.choice(name).load()

    def choice(self, name: str) -> Choice:
        """The entry itself, nothing loaded.

        Raises
        ------
        UnknownChoice
            Naming the known ones.
        """
        if name not in self.choices:
            known = ", ".join(self.choices)
            hint = did_you_mean(name, self.choices)
            raise UnknownChoice(f"{name!r} is not a known {self.kind}; {hint}use one of {known}.")
        return self.choices[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.choices)

    def __len__(self) -> int:
        return len(self.choices)

    def __contains__(self, name: object) -> bool:
        return name in self.choices

    def __repr__(self) -> str:
        return f"<{self.kind}: {', '.join(self.choices)}>"

    @property
    def words(self) -> str:
        """All choices in one sentence of a reference page."""
        return "; ".join(f"`{name}`: {choice.words}" for name, choice in self.choices.items()) + "."
