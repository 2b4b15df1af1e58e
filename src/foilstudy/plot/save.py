"""Pictures as files: small PNG for pages, SVG for print."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

from foilstudy.base.files import written_whole

PNG_DPI = 150

_COLOURS = 256


def save(figure, stem, dpi: int = PNG_DPI) -> tuple[Path, Path]:
    """Write ``<stem>.png`` and ``<stem>.svg``; the same figure always gives the same bytes.

    The PNG has a palette of 256 colours, which makes it a third of the size of one with true
    colours.

    Parameters
    ----------
    stem : path without suffix; its folder is made if missing
    dpi : int
        Dots per inch of the PNG, and of pictures within the SVG.
    """
    from foilstudy.plot.style import styled

    stem = Path(stem)
    png, svg = (stem.with_name(f"{stem.name}.{suffix}") for suffix in ("png", "svg"))
    savefig = styled(figure.savefig)
    with written_whole(png) as partial:
        _with_palette(savefig, dpi).save(partial, "png", optimize=True, dpi=(dpi, dpi))
    figure.set_layout_engine("none")  # it is laid out now, which costs as much as drawing
    with written_whole(svg) as partial:
        savefig(partial, format="svg", dpi=dpi, metadata={"Date": None})
    return png, svg


def _with_palette(savefig, dpi: int):
    from PIL import Image  # what matplotlib itself writes PNG with

    true_colours = BytesIO()
    savefig(true_colours, format="png", dpi=dpi)
    image = Image.open(true_colours).convert("RGB")
    # Keeps the few dots of a strong colour, which a median cut merges with others.
    palette = image.quantize(_COLOURS, Image.Quantize.MAXCOVERAGE)
    # Dithered, or else shaded surfaces show steps.
    return image.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG)


def inches_wide(png: Path) -> float:
    """Width at which a PNG was drawn, `PNG_DPI` where it does not tell its resolution."""
    from PIL import Image

    with Image.open(png) as image:
        return image.width / image.info.get("dpi", (PNG_DPI,))[0]
