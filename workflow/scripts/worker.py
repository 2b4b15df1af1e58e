"""Fill the kernel cache, then run the jobs of a study: worker.py."""

import sys

from foilstudy.study.worker import work

work(again=sys.argv[1:] == ["again"])
