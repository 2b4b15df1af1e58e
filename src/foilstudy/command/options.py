"""Options that several commands have."""

from typing import Annotated

from cyclopts import Parameter
from cyclopts.validators import Number

__all__ = ["Cores"]

Cores = Annotated[int, Parameter(help="Jobs at once.", validator=Number(gte=1))]
