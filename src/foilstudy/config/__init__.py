"""The study configuration: typed model, defaults, cells of the sweep and tasks of the jobs.

The model is the one source of the defaults, of ``config/schema.json`` and of the reference page
``config/README.md``; ``python -m foilstudy.config`` writes both.
"""

from foilstudy.base.errors import ConfigError

from .accuracy import Accuracy
from .contact import Contact
from .export import Export
from .isolation import Isolation
from .load import load_config, load_merged
from .mesh import Mesh
from .model import Cell, StudyConfig
from .sections import (
    Dynamics,
    Imperfection,
    Material,
    Method,
    Relaxation,
    Report,
    Sheet,
    Stiffness,
    Study,
    Sweep,
)
from .tasks import CrumpleTask, RefineTask, ResponseTask

__all__ = [
    "Accuracy",
    "Cell",
    "ConfigError",
    "Contact",
    "CrumpleTask",
    "RefineTask",
    "Dynamics",
    "Export",
    "Imperfection",
    "Isolation",
    "Material",
    "Mesh",
    "Method",
    "Relaxation",
    "Report",
    "ResponseTask",
    "Sheet",
    "Stiffness",
    "Study",
    "StudyConfig",
    "Sweep",
    "load_config",
    "load_merged",
]
