"""Fail if the records of a side study miss what is asked of them: check.py STUDY FOLDER."""

import sys

from foilstudy.study.kernel.files import problems
from foilstudy.study.registry import STUDIES

study, folder = sys.argv[1:]
sys.exit("\n".join(problems(STUDIES[study], folder)) or 0)
