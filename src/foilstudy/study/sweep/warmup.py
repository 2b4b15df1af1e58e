"""Load every numba kernel, compiling what is not in the cache yet, before any job starts."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

from foilstudy.base.outcome import USABLE
from foilstudy.base.registry import Registry
from foilstudy.config import load_config
from foilstudy.model.shell.elements import ELEMENTS
from foilstudy.model.shell.material import LAWS
from foilstudy.solve.choices import MASSES, SEARCHES


def compile_kernels() -> bool:
    """Run a very small realisation with every element and strategy, from end to end.

    And what only studies of elements need besides.

    Returns
    -------
    bool
        Whether anything had to be compiled, rather than read from the cache.

    Raises
    ------
    RuntimeError
        If one of them fails.
    """
    from numba.core import event

    from foilstudy.base.record import read_record
    from foilstudy.study.sweep.crumple import crumple_job
    from foilstudy.study.sweep.respond import respond_job

    with event.install_recorder("numba:compile") as compiled:
        for sections in _variants():
            study = load_config(_smallest(sections))
            (cell,) = study.cells()
            with tempfile.TemporaryDirectory() as folder:
                paths = Path(folder) / "crumple.nc", Path(folder) / "response.nc"
                crumple_job(study.crumple_task(cell), paths[0])
                respond_job(study.response_task(cell), *paths)
                _, attributes = read_record(paths[1])
            if attributes["status"] not in USABLE:
                raise RuntimeError(
                    f"the kernels do not work on this machine with {sections}: "
                    f"{attributes['message']}"
                )
        _general_force()
    return bool(compiled.buffer)


def _variants() -> Iterator[dict]:
    """Sections that choose every element, and every strategy, but the default ones.

    Not those that are known to fail: whoever tries one waits for its kernels. A path has none.
    """
    yield from ({"mesh": {"element": name}} for name in _safe(ELEMENTS))
    yield from ({"material": {"law": name}} for name in _safe(LAWS)[1:])
    registries = {"mass": MASSES, "search": SEARCHES}
    for key, registry in registries.items():
        yield from ({"method": {key: name}} for name in _safe(registry)[1:])


def _safe(registry: Registry) -> list[str]:
    return [name for name in registry if not registry.choice(name).caution]


def _general_force() -> None:
    """Force by the kernel for any strain sampling; a realisation needs its tangent alone."""
    import numpy as np

    from foilstudy.config.foils import foil_of
    from foilstudy.config.scene import mesh_of
    from foilstudy.model.patch import cylinder_control_points
    from foilstudy.model.shell.elements.sampled import STAGGERED
    from foilstudy.model.shell.shell import Shell

    study = load_config(_smallest({}))
    (cell,) = study.cells()
    task = study.crumple_task(cell)
    foil = foil_of(task)
    patch = mesh_of(task.mesh).patch(foil)
    points = cylinder_control_points(patch, foil.diameter)
    shell = Shell.elastic(patch, points, foil.material, foil.thickness, STAGGERED)
    shell.force(points, np.empty_like(points))


def _smallest(sections: dict) -> dict:
    content = {
        "study": {"name": "warmup"},
        "sweep": {"thickness_um": [500], "reference_height_mm": [150], "realisations": 1},
        "mesh": {"element_size_mm": 18},
        "relaxation": {"ramp_steps": 100},
        "stiffness": {"refinements": 1},
        "dynamics": {"shown_max_hz": 50},
    }
    return content | {key: content.get(key, {}) | value for key, value in sections.items()}
