"""Post-buckling energy on refined meshes: elements_buckled.py THICKNESS_UM RECORD_JSON."""

import sys

from foilstudy.elementstudy.buckled import reference_energies
from foilstudy.elementstudy.records import write

thickness_um, record_json = sys.argv[1:]
write(reference_energies(float(thickness_um) * 1e-6), record_json)
