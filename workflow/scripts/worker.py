"""Fill the kernel cache, then run the jobs of a study: worker.py [contact]."""

import sys

from foilstudy.study.worker import work

work(again=sys.argv.count("again"), contact="contact" in sys.argv)
