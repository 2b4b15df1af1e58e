"""Digests of values: alike for the same bits in any file, other for any other."""

from __future__ import annotations

from collections.abc import Mapping
from hashlib import sha256

import numpy as np

__all__ = ["digest_of"]

_COSTS = ("seconds_", "peak_memory")
"""Beginnings of the names of quantities."""


def digest_of(arrays: Mapping[str, np.ndarray], text: str = "") -> str:
    """Sixteen hexadecimal digits of arrays by name, of numbers or texts, and of a text.

    What a computation has cost does not count, as it differs from run to run.
    """
    summary = sha256(text.encode())
    for name in sorted(name for name in arrays if not name.startswith(_COSTS)):
        array = np.ascontiguousarray(arrays[name])
        if array.dtype.kind in "OU":
            kind, content = "text", "\0".join(map(str, array.ravel())).encode()
        else:
            kind, content = array.dtype.str, array.tobytes()
        summary.update(f"\0{name} {kind} {array.shape}\0".encode())
        summary.update(content)
    return summary.hexdigest()[:16]
