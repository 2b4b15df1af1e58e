"""Call a function of the package with the words of a rule: call.py MODULE:FUNCTION WORD...

The module is named within the package, such as study.sweep.crumple.

Each word becomes what the function's annotation says: a task or a study of its JSON, a path or text
of the word itself; the last annotation holds for all the words that are left.
"""

import sys
from inspect import signature
from itertools import chain, repeat
from pkgutil import resolve_name

from foilstudy.base.errors import Refusal

place, *words = sys.argv[1:]
function = resolve_name(f"foilstudy.{place}")
kinds = [each.annotation for each in signature(function, eval_str=True).parameters.values()]
makers = [getattr(kind, "model_validate_json", kind) for kind in kinds]
try:
    function(*(make(word) for make, word in zip(chain(makers, repeat(makers[-1])), words)))
except Refusal as problem:
    sys.exit(str(problem))
except OSError as problem:
    if problem.filename is None:  # not a file's
        raise
    sys.exit(f"{problem.filename}: {problem.strerror}; check path, permissions and disk.")
