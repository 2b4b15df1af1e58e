"""A kernel has the same bits in the process that compiles it and in one that finds it compiled."""

import hashlib
import os
import subprocess
import sys

import numpy as np
import pytest

from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.imperfections.cylinder import imperfect_cylinder
from foilstudy.model.patch import Patch
from foilstudy.model.shell.elements import ELEMENTS
from foilstudy.model.shell.elements.sampled import STAGGERED
from foilstudy.model.shell.shell import Shell


def digests():
    """Of force, energy and tangent of every element, in a rough shape and the stress-free one."""
    foil = Foil(0.2, 0.17, 0.13, 500e-6, "FEP")
    patch = Patch.for_cylinder(foil.diameter, foil.reference_height, 10e-3)
    points = imperfect_cylinder(patch, foil, Imperfection())
    rough = points + np.random.default_rng(0).normal(scale=1e-3, size=points.shape)
    for element in [*(ELEMENTS[name]() for name in ELEMENTS), STAGGERED]:
        shell = Shell.elastic(patch, points, foil.material, foil.thickness, element)
        for shape in (rough, points):
            force = shell.force(shape, np.empty_like(shape))
            for result in (force, shell.energies(shape).total, shell.tangent_blocks(shape)):
                yield hashlib.md5(np.ascontiguousarray(result).tobytes()).hexdigest()


@pytest.mark.slow
def test_compiling_a_kernel_does_not_change_its_bits(tmp_path):
    def run():
        return subprocess.run(
            [sys.executable, __file__],
            env=os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)},
            capture_output=True,
            text=True,
            check=True,
        ).stdout.split()

    compiling, finding = run(), run()
    assert compiling == finding
    assert len(compiling) == 6 * (len(ELEMENTS) + 1)


if __name__ == "__main__":
    print(*digests())
