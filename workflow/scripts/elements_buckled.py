"""Post-buckling energy on refined meshes: elements_buckled.py RECORD_JSON."""

import sys

from foilstudy.study.elements.buckled import reference_energies
from foilstudy.study.elements.records import write

write(reference_energies(), sys.argv[1])
