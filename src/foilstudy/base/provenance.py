"""Where a result comes from: code, libraries, time and machine."""

from __future__ import annotations

import os
import platform
import subprocess
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

__all__ = ["git_commit", "machine", "package_versions", "provenance"]

_PACKAGE = Path(__file__).parents[1]

PACKAGES = (
    "foilstudy",
    "numpy",
    "scipy",
    "numba",
    "xarray",
    "netCDF4",
    "statsmodels",
    "mkl",
)


def provenance() -> dict[str, str]:
    """Attributes that every result file carries.

    Returns
    -------
    dict of str
        ``git_commit``, ``package_versions``, ``created`` (UTC, ISO 8601) and ``machine``.
    """
    return {
        "git_commit": git_commit(),
        "package_versions": package_versions(),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "machine": machine(),
    }


def package_versions() -> str:
    """Versions of Python and of the packages that decide the numbers, those installed."""
    found = [f"Python {platform.python_version()}"]
    for package in PACKAGES:
        try:
            found.append(f"{package} {version(package)}")
        except PackageNotFoundError:
            continue
    return ", ".join(found)


@cache
def git_commit() -> str:
    """Commit of the source that runs, ``-dirty`` behind it if changed since; else ``unknown``.

    As it was at the first call: what changes later is not what this process has loaded.
    """
    try:
        # An installed copy may lie inside an unrelated repository, which does not track it.
        _git("ls-files", "--error-unmatch", "__init__.py")
        commit = _git("rev-parse", "HEAD")
        # Of the package alone: a run rewrites results that may be tracked as well.
        changed = _git("status", "--porcelain", "--", ".")
    except (OSError, subprocess.SubprocessError):
        return "unknown"
    return f"{commit}-dirty" if changed else commit


def _git(*arguments: str) -> str:
    return subprocess.run(
        ["git", "-C", str(_PACKAGE), *arguments],
        check=True,
        capture_output=True,
        text=True,
        timeout=10,
    ).stdout.strip()


def machine() -> str:
    """Operating system, processor and memory in words; no host or user name."""
    words = [f"{platform.system()} {platform.machine()}", _processor()]
    words.append(f"{os.cpu_count()} logical processors")
    if "SC_PHYS_PAGES" in getattr(os, "sysconf_names", {}):
        memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
        words.append(f"{memory / 1e9:.0f} GB of memory")
    return ", ".join(word for word in words if word)


def _processor() -> str:
    """Model of the processor, empty where the system does not tell."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    models = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(models, "")
