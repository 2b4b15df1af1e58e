"""Post-buckling energy on refined meshes: elements_buckled.py RECORD_JSON."""

import sys

from foilstudy.elementstudy.buckled import reference_energies
from foilstudy.elementstudy.records import write

write(reference_energies(), sys.argv[1])
