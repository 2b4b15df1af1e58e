"""Fitted laws and their spread as CSV: tables.py CUBE_NC FOLDER."""

import sys
from pathlib import Path

from foilstudy import open_cube
from foilstudy.present.statistics.tables import write_tables

cube_nc, folder = map(Path, sys.argv[1:])
write_tables(open_cube(cube_nc), folder)
