"""What input decks have in common."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

__all__ = ["comment"]


def comment(text: str, provenance: Mapping[str, str] | None = None) -> Iterator[str]:
    """Lines that the codes skip."""
    origin = [f"{name}: {value}" for name, value in (provenance or {}).items()]
    for line in [*text.strip().splitlines(), *origin]:
        yield f"** {' '.join(line.split())}".rstrip()
