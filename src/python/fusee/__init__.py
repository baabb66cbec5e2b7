"""fusee: from a tendon-driven joint to the exact pulley that drives it.

    >>> import fusee
    >>> arm = fusee.read(fusee.new("forearm"))
    >>> built = fusee.build(arm.with_({"pulley.r1_mm": 15}))
    >>> built.status
    'done'

The verbs are functions: ``read``, ``synthesise``, ``build``, ``rewind``, ``check``, ``analyze``, ``optimize``, ``calibrate``, ``simulate``,
``plan``, ``kit``. What they answer are frozen values: arrays are read-only views, units stand in the names, angles are in radians inside
and in degrees where the file has them. A joint that cannot be made is a value that says why and what would do; what cannot be used is an
``InputError`` with all its diagnostics.
"""

from ._core import version as __version__
from ._errors import Bug, Diagnostic, InputError, OutputError
from ._mechanism import Mechanism, explain, new, read, templates
from ._values import (
    Analysis,
    Built,
    Calibration,
    Change,
    Check,
    Condition,
    Effect,
    ErrorFigures,
    ErrorSource,
    Extreme,
    Forces,
    FrontPoint,
    Kit,
    Knot,
    LargestTension,
    Mesh,
    NextMeasurement,
    Optimum,
    Outline,
    PaperForces,
    Parameter,
    Placement,
    Plan,
    PlanStep,
    Residual,
    Rewound,
    Simulation,
    Strength,
    Stroke,
    Synthesis,
    Table,
    ToleranceEffect,
    Winding,
)
from ._verbs import Log, analyze, build, calibrate, check, kit, optimize, plan, rewind, simulate, synthesise

__all__ = [
    "Analysis",
    "Bug",
    "Built",
    "Calibration",
    "Change",
    "Check",
    "Condition",
    "Diagnostic",
    "Effect",
    "ErrorFigures",
    "ErrorSource",
    "Extreme",
    "Forces",
    "FrontPoint",
    "InputError",
    "Kit",
    "Knot",
    "LargestTension",
    "Log",
    "Mechanism",
    "Mesh",
    "NextMeasurement",
    "Optimum",
    "Outline",
    "OutputError",
    "PaperForces",
    "Parameter",
    "Placement",
    "Plan",
    "PlanStep",
    "Residual",
    "Rewound",
    "Simulation",
    "Strength",
    "Stroke",
    "Synthesis",
    "Table",
    "ToleranceEffect",
    "Winding",
    "__version__",
    "analyze",
    "build",
    "calibrate",
    "check",
    "explain",
    "kit",
    "new",
    "optimize",
    "plan",
    "read",
    "rewind",
    "simulate",
    "synthesise",
    "templates",
]
