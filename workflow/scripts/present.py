"""Tables and figures of the records of a side study: present.py STUDY FOLDER."""

import sys

from foilstudy.study.kernel.files import present
from foilstudy.study.registry import STUDIES

study, folder = sys.argv[1:]
present(STUDIES[study], folder)
