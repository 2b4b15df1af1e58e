"""Time of a force evaluation by every element: elements_cost.py RECORD_JSON."""

import sys

from foilstudy.elementstudy.cost import costs
from foilstudy.elementstudy.records import write

write(costs(), sys.argv[1])
