"""Figures as files."""

from __future__ import annotations

from pathlib import Path

from foilstudy.base.files import written_whole

PNG_DPI = 150


def save(figure, stem) -> tuple[Path, Path]:
    """Write ``<stem>.png`` and ``<stem>.svg``; the same figure always gives the same bytes.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    stem : path without suffix; its folder is made if missing

    Returns
    -------
    png, svg : Path
    """
    from foilstudy.plot.style import styled  # matplotlib

    stem = Path(stem)
    return tuple(
        _save_one(styled(figure.savefig), stem.with_name(f"{stem.name}.{suffix}"), metadata)
        for suffix, metadata in (("png", {"Software": None}), ("svg", {"Date": None}))
    )


def _save_one(savefig, path: Path, metadata: dict) -> Path:
    with written_whole(path) as partial:
        savefig(partial, format=path.suffix[1:], dpi=PNG_DPI, metadata=metadata)
    return path
