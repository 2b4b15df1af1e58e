"""Export one realisation of a study: python -m foilstudy.export FOLDER --format FORMAT."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Sequence
from pathlib import Path

from foilstudy.config import ResponseTask, StudyConfig, load_config
from foilstudy.export import FORMATS, check_format, write
from foilstudy.linalg import SolveError
from foilstudy.study.sweep.export import contents_of

_REALISATIONS = 3
"""Folders from a realisation up to the folder of all: seed, overlength, thickness."""


def main(words: Sequence[str] | None = None) -> None:
    """Read the command line; a problem is one sentence and exit code 1."""
    arguments = _parsed(words)
    try:
        for path in _exported(arguments):
            print(f"wrote {path}")
    except (ValueError, SolveError) as problem:
        sys.exit(str(problem))


def _parsed(words: Sequence[str] | None) -> Namespace:
    known = "\n".join(f"  {name:4} {kind.content}" for name, kind in FORMATS.items())
    parser = ArgumentParser(
        prog="python -m foilstudy.export",
        description="Export one realisation of a study.",
        epilog=f"formats:\n{known}\n  all  every one of them",
        formatter_class=RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "folder", type=Path, help="such as results/NAME/realisations/t500um/h170mm/0"
    )
    parser.add_argument("--format", required=True, help="see below")
    parser.add_argument(
        "--output",
        type=Path,
        help="file, or folder for all formats; default: FOLDER/export with the usual names",
    )
    parser.add_argument(
        "--config", type=Path, help="YAML of the study; default: the one in results/NAME/cube.nc"
    )
    parser.add_argument(
        "--refinements", type=int, default=0, help="halve the elements so often before; default: 0"
    )
    return parser.parse_args(words)


def _exported(arguments: Namespace) -> list[Path]:
    names = list(FORMATS) if arguments.format == "all" else [arguments.format]
    for name in names:
        check_format(name)
    record = arguments.folder / "crumple.nc"
    contents = contents_of(_task(arguments), record, arguments.refinements)
    paths = []
    for name in names:
        path = arguments.folder / "export" / FORMATS[name].filename
        if arguments.output:
            several = arguments.format == "all" or arguments.output.is_dir()
            path = arguments.output / path.name if several else arguments.output
        write(contents, name, path)
        paths.append(path)
    return paths


def _task(arguments: Namespace) -> ResponseTask:
    """Foil, damping and band are those of the study; the records hold shape and status only."""
    place = arguments.folder.resolve()
    if len(place.parents) <= _REALISATIONS:
        raise ValueError(
            f"{arguments.folder}: is not the folder of a realisation, such as "
            "results/NAME/realisations/t500um/h170mm/0."
        )
    study = _study(arguments.config, place.parents[_REALISATIONS])
    return study.response_task(study.cell(*place.parts[-_REALISATIONS:]))


def _study(config: Path | None, results: Path) -> StudyConfig:
    if config is not None:
        return load_config(config)
    cube = results / "cube.nc"
    if not cube.is_file():
        raise ValueError(
            f"{cube}: there is no such file, so that the configuration is not known; finish the "
            "study, or give it with --config."
        )
    import netCDF4
    import yaml

    with netCDF4.Dataset(cube) as file:
        return load_config(yaml.safe_load(file.config))


if __name__ == "__main__":
    main()
