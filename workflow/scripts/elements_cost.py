"""Time of a force evaluation by every element: elements_cost.py RECORD_JSON."""

import sys

from foilstudy.study.elements.cost import costs
from foilstudy.study.elements.records import write

write(costs(), sys.argv[1])
