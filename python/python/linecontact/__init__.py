"""Line contact of two bodies, each a parametric curve: contact limits and pressure.

Lengths, pressures and loads per unit length are in any consistent units: mm, MPa and N/mm, or m, Pa
and N/m. The lower body is body 1. The contact runs from x = -b to x = a.

Examples
--------
A steel roller of 10 mm radius on a steel flat: mm, MPa, N/mm.

>>> import linecontact as lc
>>> roller = lc.Ellipse.circle(10.0, (-1.0, 1.0))
>>> solution = lc.solve(lc.Flat(), roller, load=500.0, contact_modulus=115e3)
>>> round(solution.peak().pressure, 1)
1352.9
"""

from typing import get_type_hints as _types

from . import bodies as _bodies
from . import errors
from .bodies import *
from .contact import (
    Contact,
    Edge,
    EdgePressure,
    Layer,
    Material,
    Midpoint,
    Panels,
    PinInHole,
    Reference,
    References,
    Search,
    contact_modulus,
)
from .differentiating import gradient, parameters
from .errors import EvaluationError, InputError, LineContactError, SolveError
from .exploring import explore
from .files import Scene
from .finite_roller import FiniteRoller, RollerState
from .outlines import Outline, read_outline
from .pair import Pair, Pose, Wrench
from .reading import MeasuredProfile, read_profile
from .slipping import PartialSlip
from .solution import (
    Approach,
    Attempt,
    Certificate,
    Conformity,
    ContactRegion,
    Cost,
    Extremum,
    Interval,
    LoadRates,
    Peak,
    Solution,
    Stress,
    StressPeak,
    Summary,
    Uncertainty,
)
from .solver import Solver, SpringPoints, SpringTable, solve
from .sweeping import Columns, sweep

__all__ = [
    "Approach",
    "Attempt",
    "Certificate",
    "Conformity",
    "Columns",
    "Contact",
    "ContactRegion",
    "Cost",
    "Edge",
    "EdgePressure",
    "EvaluationError",
    "Extremum",
    "FiniteRoller",
    "InputError",
    "Interval",
    "Layer",
    "LineContactError",
    "LoadRates",
    "Material",
    "MeasuredProfile",
    "Midpoint",
    "Outline",
    "Pair",
    "Panels",
    "PartialSlip",
    "Peak",
    "PinInHole",
    "Pose",
    "Reference",
    "References",
    "RollerState",
    "Scene",
    "Search",
    "Solution",
    "SolveError",
    "Solver",
    "SpringPoints",
    "SpringTable",
    "Stress",
    "StressPeak",
    "Summary",
    "Uncertainty",
    "Wrench",
    "contact_modulus",
    "errors",
    "explore",
    "gradient",
    "parameters",
    "read_outline",
    "read_profile",
    "solve",
    "sweep",
]
__all__ += _bodies.__all__

# A NamedTuple keeps the types of its fields as words: documentation needs the types.
for _row in [_kind for _kind in globals().values() if hasattr(_kind, "_fields")]:
    if _row.__new__.__module__.startswith("namedtuple_"):
        _row.__new__.__annotations__.update(_types(_row))
