"""Load every numba kernel, compiling what is not in the cache yet, before any job starts."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from foilstudy.base.outcome import USABLE
from foilstudy.base.registry import Registry
from foilstudy.config import load_config
from foilstudy.model.foil import Foil
from foilstudy.model.patch import RING_ROWS, Patch
from foilstudy.model.shell.elements import ELEMENTS
from foilstudy.model.shell.material import LAWS
from foilstudy.solve.choices import MASSES, SEARCHES


def compile_kernels(contact: bool = False) -> bool:
    """Run a very small realisation with every element and strategy, from end to end.

    And what only studies of elements need besides.

    Parameters
    ----------
    contact : bool
        Whether parts of the foil touch in the study. The kernels of that are compiled in a process
        that compiles no others, whose last bits have differed where both were: not in one call,
        but in the next, in another process.

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

    with event.install_recorder("numba:compile") as compiled:
        for sections in _variants():
            _realise(sections)
        _general_force()
        if contact and not compiled.buffer:
            _realise({"contact": {"kind": "barrier"}})
            _touching()
    return bool(compiled.buffer)


def _realise(sections: dict) -> None:
    from foilstudy.base.record import read_record
    from foilstudy.study.sweep.crumple import crumple_job
    from foilstudy.study.sweep.respond import respond_job

    study = load_config(_smallest(sections))
    (cell,) = study.cells()
    with tempfile.TemporaryDirectory() as folder:
        paths = Path(folder) / "crumple.nc", Path(folder) / "response.nc"
        crumple_job(study.crumple_task(cell), paths[0])
        respond_job(study.response_task(cell), *paths)
        _, attributes = read_record(paths[1])
    if attributes["status"] not in USABLE:
        raise RuntimeError(
            f"the kernels do not work on this machine with {sections}: {attributes['message']}"
        )


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
    from foilstudy.model.shell.elements.sampled import STAGGERED
    from foilstudy.model.shell.shell import Shell

    foil, patch, points = _cylinder()
    shell = Shell.elastic(patch, points, foil.material, foil.thickness, STAGGERED)
    shell.force(points, np.empty_like(points))


def _touching() -> None:
    """What closed contacts exert: a foil pressed flat between two plates."""
    from foilstudy.model.contact.options import BarrierContact
    from foilstudy.model.shell.shell import Shell

    foil, patch, points = _cylinder()
    section = Shell.elastic(patch, points, foil.material, foil.thickness).section
    sheet, planes = BarrierContact(ring_planes=True).terms(section)
    half = 0.5 * sheet.thickness + 0.45 * sheet.reach  # an end is half as far from both sides
    pressed = points.copy()
    np.clip(points[1], -half, half, out=pressed[1])
    force = np.empty_like(points)
    for term in (sheet, planes):
        energy = term.force(pressed, force)
        if not np.isfinite(energy).all():
            raise RuntimeError(f"the kernels of contact do not work on this machine: {energy}")
        term.tangent(pressed)
        term.spring_forces(np.ascontiguousarray(force[:, RING_ROWS:-RING_ROWS]))
    if not len(sheet.closed()):
        raise RuntimeError("the kernels of contact do not work on this machine: nothing touches")


def _cylinder() -> tuple[Foil, Patch, np.ndarray]:
    """The smallest foil, its patch and the control points of its cylinder."""
    from foilstudy.config.foils import foil_of
    from foilstudy.config.scene import mesh_of
    from foilstudy.model.patch import cylinder_control_points

    study = load_config(_smallest({}))
    (cell,) = study.cells()
    task = study.crumple_task(cell)
    foil = foil_of(task)
    patch = mesh_of(task.mesh).patch(foil)
    return foil, patch, cylinder_control_points(patch, foil.diameter)


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
