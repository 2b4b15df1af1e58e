"""What a result was made of: its task, the code, and the results that went into it.

Stored with every record and compared wherever one is read: a record counts as the result of a task
only if all three are the same. Dates of files and the workflow's own notes say nothing that copying
or cloning a folder could not have changed.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from hashlib import sha256
from typing import Any, Self

__all__ = ["Origin"]

SHOWN = 60
"""Characters of a value in a sentence."""


@dataclass(frozen=True)
class Origin:
    """What decides a result.

    Attributes
    ----------
    task : str
        JSON of all that was asked for.
    code : str
        Fingerprint of the code, see `foilstudy.base.fingerprint`.
    sources : tuple of str
        Digests of the records that the result was made from.
    """

    task: str = "{}"
    code: str = ""
    sources: tuple[str, ...] = ()

    def attributes(self) -> dict[str, str]:
        """As attributes of a record: ``task``, ``code`` and ``made_from``."""
        return {"task": self.task, "code": self.code, "made_from": " ".join(self.sources)}

    @property
    def digest(self) -> str:
        """Of all of it, for what the origin alone decides."""
        return sha256("\0".join((self.task, self.code, *self.sources)).encode()).hexdigest()[:16]

    @classmethod
    def of(cls, attributes: Mapping[str, Any]) -> Self:
        """The origin that `attributes` has put down; what is missing is empty."""
        sources = str(attributes.get("made_from", "")).split()
        return cls(
            str(attributes.get("task", "{}")), str(attributes.get("code", "")), tuple(sources)
        )

    def departure(self, wanted: Origin) -> str:
        """What is another than wanted, in words that follow "made"; empty if nothing is.

        The task comes first: a record in a wrong place has many other things wrong, too.
        """
        if words := _differences(_content(self.task), _content(wanted.task)):
            return f"for another task ({words})"
        if self.code != wanted.code:
            return "by other code" if self.code else "by code that is not recorded"
        if self.sources != wanted.sources:
            return "from other records than those beside it"
        return ""


def _content(task: str) -> dict[str, Any]:
    try:
        content = json.loads(task)
    except ValueError:
        return {}
    return dict(_leaves(content)) if isinstance(content, dict) else {}


def _leaves(content: Mapping[str, Any], path: str = "") -> Iterator[tuple[str, Any]]:
    for key, value in content.items():
        if isinstance(value, dict):
            yield from _leaves(value, f"{path}{key}.")
        else:
            yield f"{path}{key}", value


def _differences(found: Mapping[str, Any], wanted: Mapping[str, Any]) -> str:
    keys = [key for key in {**wanted, **found} if found.get(key) != wanted.get(key)]
    if not keys:
        return ""
    key = keys[0]
    if key not in found:
        words = f"without {key}"
    elif key not in wanted:
        words = f"with {key}"
    else:
        words = f"{key} {_short(found[key])}, not {_short(wanted[key])}"
    return words if len(keys) == 1 else f"{words}, and {len(keys) - 1} more"


def _short(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= SHOWN else f"{text[: SHOWN - 3]}..."
