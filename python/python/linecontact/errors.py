"""Errors of a scene, with remedies.

Every error of the solver has its own exception class, with the place and the values as attributes.
All are subclasses of `LineContactError`, by way of `InputError` (a body, edge, load or setting is
invalid: the same call fails again), `SolveError` (no contact was found, or the result is not a
contact: another load, domain or start may help) or `EvaluationError` (the contact is known, but the
quantity asked for is not available there).

The names are taken from the Rust library: the variant `DomainTooShort` of `ContactError` is
`DomainTooShortError`. Variants of `ProfileError`, `PiecewiseError`, `SplineError` and `SearchError`
have the prefix `Profile`, `Piecewise`, `Spline` or `Search`.

Examples
--------
>>> import linecontact as lc
>>> roller = lc.Parabola(10.0, (-0.1, 0.1))
>>> contact = lc.Contact(lc.Flat(), roller, contact_modulus=115e3)
>>> try:
...     contact.solve(load=500.0)
... except lc.errors.DomainTooShortError as error:
...     print(f"{error.carried:.0f} of {error.load:.0f} N/mm")
90 of 500 N/mm
"""

from __future__ import annotations

# Words of the Rust library in its messages that are different here.
_IN_PYTHON = {
    "Edge::Fixed or FreeUntil": "Edge.fixed or Edge.free_until",
    "Free, Fixed or FreeUntil": "free, fixed or free_until",
    "the edge Fixed(": "the edge Edge.fixed(",
    "with Fixed(": "with Edge.fixed(",
    "with FreeUntil(": "with Edge.free_until(",
    "with Adhesive(": "with Edge.adhesive(",
    "is Adhesive": "is adhesive",
    "Edge::FreeUntil": "Edge.free_until",
    "Material::Rigid": "Material.rigid()",
    "by Contact::materials": "by materials=(lower, upper)",
    "name the lower or upper one": "give body='lower' or body='upper'",
    "is not Free": "is not free",
    "Convexity::Unknown": 'the convexity "unknown"',
    "Placement::flipped": "Body.flipped",
    "use Piecewise::placed": "place its parts one by one",
    "by Piecewise::with_tolerance, above": "by Piecewise(parts, tolerance) with a tolerance above",
    "Fit::smooth": "smooth=True",
    "set Fit::outliers to None": "give outliers=None",
    "of points set Fit::period": "of points give Spline(points, period=...)",
    "Fit::outliers is": "outliers is",
    "edge_singularities()": "edge_singularities",
}


class LineContactError(Exception):
    """Base class of all exceptions of the solver."""

    def __init__(self, *given: object) -> None:
        super().__init__(*(_translated(one) if isinstance(one, str) else one for one in given))


def _translated(message: str) -> str:
    """Replaces names of the Rust library by those of this package."""
    for there, here in _IN_PYTHON.items():
        message = message.replace(there, here)
    return message


class InputError(LineContactError, ValueError):
    """A body, edge, load or setting is invalid. The same call fails again."""


class SolveError(LineContactError):
    """No contact was found, or the result is not a contact.

    Another load, domain or start may help.
    """


class EvaluationError(LineContactError):
    """The contact is known, but the quantity asked for is not available there."""


class SearchError(SolveError):
    """A search has found no root of a function of one variable."""


class SceneFileError(InputError):
    """A file holds no scene, or a scene cannot be written to a file.

    Attributes
    ----------
    path : str
        Name of the file.
    line : int or None
        Line of the fault, counted from 1, if it is known.
    field : str
        Field at fault, such as `upper.shape`; empty if it is the file as a whole.
    reason : str
        Nature of the fault.
    """

    path: str
    line: int | None
    field: str
    reason: str

    def __init__(self, path: str, line: int | None, field: str, reason: str) -> None:
        super().__init__(path, line, field, reason)
        self.path, self.line, self.field, self.reason = path, line, field, reason

    def __str__(self) -> str:
        place = self.path if self.line is None else f"{self.path}:{self.line}"
        return ": ".join(filter(None, (place, self.field, self.reason)))


class MissingDerivativesError(InputError, TypeError):
    """The function of a `Curve` has not returned four arrays.

    Attributes
    ----------
    count : int
        Number of arrays returned; 1 for a single array or number.
    """

    count: int

    def __init__(self, count: int) -> None:
        super().__init__(count)
        self.count = count

    def __str__(self) -> str:
        returned = {0: "nothing", 1: "one array"}.get(self.count, f"{self.count} arrays")
        return (
            f"the function of a Curve has returned {returned}: it must return four, X, Y and their "
            "derivatives by k, of as many numbers as k has. For a circle of radius R by its angle:\n"
            "    def circle(k):\n"
            "        x, y = R * np.sin(k), R * (1 - np.cos(k))\n"
            "        dx, dy = R * np.cos(k), R * np.sin(k)\n"
            "        return x, y, dx, dy"
        )


class MeasuredFileError(InputError):
    """A file of a measured profile, or of a drawing, cannot be read.

    Attributes
    ----------
    path : str
        File.
    reason : str
        Fault, and its remedy.
    line : int or None
        Line of the fault in a text, counted from 1.
    byte : int or None
        Place of the fault in a binary file, counted from 0.
    """

    path: str
    reason: str
    line: int | None
    byte: int | None

    def __init__(
        self, path: str, reason: str, line: int | None = None, byte: int | None = None
    ) -> None:
        super().__init__(path, reason, line, byte)
        self.path, self.reason, self.line, self.byte = path, reason, line, byte

    def __str__(self) -> str:
        place = "" if self.line is None else f":{self.line}"
        return f"{self.path}{place if self.byte is None else f', byte {self.byte}'}: {self.reason}"


class ProfileError(InputError):
    """The profile of a body is faulty.

    Attributes
    ----------
    body : str
        Body with this profile.
    source : LineContactError
        Fault of the profile.
    """

    body: str
    source: LineContactError


class PoseError(InputError):
    """The force of a `Pair` is not known where its bodies stand: body 2 turns back or is upside
    down, its place is not finite, or the contact is not found.

    Attributes
    ----------
    x : float
        Place of the origin of body 2 along body 1: a length.
    y : float
        Its height above body 1: a length.
    angle : float
        Angle from body 1 to body 2, counter-clockwise: radians.
    source : LineContactError
        Fault of body 2 as it stands, or of the contact.
    """

    x: float
    y: float
    angle: float
    source: LineContactError


class NoCommonRangeError(InputError):
    """The two bodies have no `x` in common.

    Attributes
    ----------
    lower : tuple[float, float]
        Range of `x` of the lower body.
    upper : tuple[float, float]
        Range of `x` of the upper body.
    """

    lower: tuple[float, float]
    upper: tuple[float, float]


class InvalidLoadError(InputError):
    """The load, half-width, peak pressure or approach asked for is not finite, or so small that it
    has lost digits, or not positive.

    With adhesion, and in an interval that is not checked, a load may have any sign; of bodies that
    may lift off, a load of zero and an approach of zero or less leave them apart.

    Attributes
    ----------
    quantity : str
        Quantity asked for: `load`, `half-width`, `peak pressure` or `approach`; of a table of
        springs `least load` or `largest load`.
    value : float
        Its value.
    must : str
        Condition on the value, besides that it is finite.
    """

    quantity: str
    value: float
    must: str


class InvalidKappaError(InputError):
    """κ is not a positive finite number.

    Attributes
    ----------
    kappa : float
        κ as given.
    """

    kappa: float


class InvalidModulusError(InputError):
    """The contact modulus E* is not a positive finite number, or κ = π E*/2 is not.

    Attributes
    ----------
    modulus : float
        E* as given.
    """

    modulus: float


class InvalidLimitsError(InputError):
    """Given or starting limits are not in order, or a half-width is lost in the rounding of `x`.

    Attributes
    ----------
    interval : tuple[float, float]
        The interval as given.
    """

    interval: tuple[float, float]


class InvalidThicknessError(InputError):
    """The thickness of a layer is not a positive finite number.

    Attributes
    ----------
    body : str
        Body with this layer.
    thickness : float
        Thickness as given.
    """

    body: str
    thickness: float


class InvalidPeriodError(InputError):
    """The period of the bodies is not a positive finite number.

    Attributes
    ----------
    period : float
        Period as given.
    """

    period: float


class NotPeriodicError(InputError):
    """A body is not the same at both ends of the period over which it is described.

    Attributes
    ----------
    body : str
        Body.
    what : str
        Quantity that differs, for the message.
    ends : tuple[float, float]
        Its values at the left and at the right end; of x, less the period at the right end.
    """

    body: str
    what: str
    ends: tuple[float, float]


class KernelError(InputError):
    """A kernel, or a compliance by wavenumber, cannot be used.

    Attributes
    ----------
    what : str
        Fault, for the message.
    at : float
        Length at fault; of a value that is, its place or wavenumber.
    """

    what: str
    at: float


class LayerTooThinError(InputError):
    """A contact is too wide for the layer below it, or another kernel as short.

    Attributes
    ----------
    ratio : float
        Half-width by thickness, to about a tenth; by half the distance of the nearest singularity
        of a kernel.
    limit : float
        Largest ratio that is solved.
    """

    ratio: float
    limit: float


class KernelNotSupportedError(InputError):
    """Layers, periods and other kernels cannot be combined with another setting.

    Attributes
    ----------
    why : str
        Reason, for the message.
    """

    why: str


class InvalidEdgePressureError(InputError):
    """One of A, B, ε_a, ε_b, ε₁, ε₂ of Eq. (6) is out of range.

    Attributes
    ----------
    name : str
        Name of the quantity.
    value : float
        Its value.
    """

    name: str
    value: float


class InvalidSegmentsError(InputError):
    """The number of segments is zero, or there are more points than can be counted.

    Attributes
    ----------
    segments : int
        Number of segments, N.
    extrapolations : int
        Number of extrapolations, ET.
    """

    segments: int
    extrapolations: int


class InconsistentHeightsError(InputError):
    """A body's Y does not match its Y', so that heights and slopes of the gap contradict each
    other.

    Y has a step, or a derivative is wrong: `check_derivatives` tells for which body.

    Attributes
    ----------
    between : tuple[float, float]
        Two abscissae, equal at a joint of pieces that do not meet.
    by_heights : float
        Rise of `Y₂ - Y₁` from the first abscissa to the second.
    by_slopes : float
        `∫ (Y₂'/X₂' - Y₁'/X₁') dx` from the first abscissa to the second.
    """

    between: tuple[float, float]
    by_heights: float
    by_slopes: float


class NotConvexError(InputError):
    """The bodies declare that they bulge towards each other, but the slope of the gap falls.

    Attributes
    ----------
    between : tuple[float, float]
        Two abscissae, the left one first; equal where the slope jumps.
    slopes : tuple[float, float]
        Slopes of the gap at these abscissae, before the bodies turn: ratios of lengths.
    """

    between: tuple[float, float]
    slopes: tuple[float, float]


class InvalidToleranceError(InputError):
    """The tolerance of the panels is negative, one or more, or NaN.

    Attributes
    ----------
    tolerance : float
        The tolerance as given.
    """

    tolerance: float


class InvalidResolutionError(InputError):
    """The resolution is not a length, is lost in the rounding of x, or takes too many points on
    bodies as long as these.

    Attributes
    ----------
    resolution : float
        The resolution as given: a length.
    least : float
        Least length that the bodies, and the rounding of x in a contact that was found, allow.
    """

    resolution: float
    least: float


class InvalidAdhesionError(InputError):
    """A work of adhesion is negative or not finite.

    Attributes
    ----------
    work : float
        The work of adhesion as given.
    """

    work: float


class BothLimitsGivenError(InputError):
    """Both limits are given: then only a load can be asked for.

    Attributes
    ----------
    interval : tuple[float, float]
        The limits.
    """

    interval: tuple[float, float]


class InvalidMomentError(InputError):
    """A moment, the place where a load acts, or the misalignment of a roller is not finite.

    Attributes
    ----------
    quantity : str
        Quantity: `moment`, `place that the moment is about`, `centre of pressure` or
        `misalignment`.
    value : float
        The value.
    """

    quantity: str
    value: float


class TiltNotSupportedError(InputError):
    """A moment, or the place where the load acts, was given for bodies that cannot be turned.

    Attributes
    ----------
    why : str
        Reason, for the message.
    """

    why: str


class PeakEdgeError(InputError):
    """A peak pressure was asked for together with an edge at which the pressure is not bounded.

    Attributes
    ----------
    edge : tuple[str, float | None]
        The edge asked for.
    """

    edge: tuple[str, float | None]


class InvalidPoissonRatioError(InputError):
    """Poisson's ratio is not one of an isotropic body that contracts when pulled.

    Attributes
    ----------
    body : str | None
        Body with this ratio; `None` of one that was given for a stress.
    ratio : float
        Poisson's ratio as given.
    """

    body: str | None
    ratio: float


class InvalidYoungsModulusError(InputError):
    """Young's modulus is not a positive finite number.

    Attributes
    ----------
    body : str
        Body with this modulus.
    modulus : float
        Young's modulus as given.
    """

    body: str
    modulus: float


class BothRigidError(InputError):
    """Both bodies are rigid: then there is no pressure."""


class NoMaterialsError(InputError):
    """An approach was asked for without the materials of the bodies: it depends on the deformation
    of each body, which E* alone does not give."""


class InvalidReferenceError(InputError):
    """The depth, radius or length of a reference is not a positive finite number, or a disc is
    smaller than the contact.

    Attributes
    ----------
    length : float
        Length as given.
    """

    length: float


class InvalidRollerError(InputError):
    """The length of a roller is not a positive finite number, or it has no slices, or too many.

    Attributes
    ----------
    length : float
        Length of the roller as given.
    slices : int
        Number of slices as given.
    most : int
        Largest number of slices.
    """

    length: float
    slices: int
    most: int


class InvalidReliefError(InputError):
    """The relief of a roller is nowhere positive: it has the wrong sign.

    Attributes
    ----------
    z : float
        First place along the axis at which it is negative.
    height : float
        Relief there, a length.
    """

    z: float
    height: float


class ReliefError(InputError):
    """The relief of a roller is no profile, or does not reach the middles of the outermost slices.

    Attributes
    ----------
    source : LineContactError
        Fault of the relief.
    """

    source: LineContactError


class InvalidFrictionError(InputError):
    """The coefficient of friction is not finite.

    Attributes
    ----------
    coefficient : float
        Coefficient as given.
    """

    coefficient: float


class InvalidSlipFrictionError(InputError):
    """The coefficient of friction of partial slip is not a positive finite number.

    Attributes
    ----------
    friction : float
        μ as given.
    """

    friction: float


class InvalidShearError(InputError):
    """The force or the tension of partial slip is not finite.

    Attributes
    ----------
    quantity : str
        Name of the quantity: `force` or `tension`.
    value : float
        Value as given.
    """

    quantity: str
    value: float


class UnlikeBodiesError(InputError):
    """Bodies of different elasticity, whose pressure with friction, or as a pin in a hole, is not
    known.

    Attributes
    ----------
    beta : float
        Dundurs' constant β in plane strain, from -1/2 to 1/2.
    """

    beta: float


class SlipNotSupportedError(InputError):
    """Partial slip is not known with these conditions.

    Attributes
    ----------
    why : str
        Reason, for the message.
    """

    why: str


class EdgePressureLoadError(InputError):
    """Edge pressures by the paper's Eq. (6) are given: then only a load can be prescribed."""


class BendingError(SolveError):
    """The bend of the bodies by a period, a layer or another regular kernel has not converged.

    Attributes
    ----------
    residual : float
        Residual of Eq. (1), as a share of its largest part.
    solves : int
        Number of solves.
    """

    residual: float
    solves: int


class CompleteContactError(SolveError):
    """The bodies of a row touch all over a period, or so nearly that the gap left is not solved.

    Attributes
    ----------
    load : float
        Load as given; that of complete contact, if none was given.
    complete : float
        Load of one period at which they touch everywhere, from the slopes at 1024 places.
    """

    load: float
    complete: float


class CancelledError(SolveError):
    """The solve was ended from outside. (Ctrl-C raises `KeyboardInterrupt`.)

    Attributes
    ----------
    evaluations : int
        Evaluations of the curves by then.
    last : tuple[float, float]
        The span of `x` sampled last.
    """

    evaluations: int
    last: tuple[float, float]


class OutsideBodiesError(SolveError):
    """`x` is beyond one of the bodies, or NaN.

    Attributes
    ----------
    x : float
        Abscissa asked for.
    range : tuple[float, float]
        The range of `x` that both bodies cover.
    """

    x: float
    range: tuple[float, float]


class InversionError(SolveError):
    """`X(k) = x` could not be inverted.

    Attributes
    ----------
    body : str
        Body with this profile.
    x : float
        Abscissa.
    source : SearchError
        Error of the search, in terms of `k`.
    """

    body: str
    x: float
    source: SearchError


class NoFirstContactError(SolveError):
    """The slope difference of the bodies nowhere goes from negative to positive, so that they do
    not open on both sides of a point of first contact.

    Attributes
    ----------
    x : tuple[float, float]
        Two abscissae.
    slope : tuple[float, float]
        Slope differences at these abscissae.
    """

    x: tuple[float, float]
    slope: tuple[float, float]


class DomainTooShortError(SolveError):
    """The contact that carries the load reaches beyond a body; of several contacts, the first or
    the last does.

    Or the bodies touch at an end before any limit gets there.

    Attributes
    ----------
    end : float
        End of the bodies that the contact reaches first.
    carried : float
        Load carried by the largest contact that stays on the bodies, or by several contacts of the
        largest possible width. It does not depend on the load asked for. Zero where the bodies
        touch at this end first; NaN, like half-width and peak, where it is not known, as of bodies
        with a layer or another kernel.
    load : float
        The load asked for.
    half_width : float
        Half-width of this largest contact; of several contacts, half the distance from the first
        limit to the last.
    peak : float
        Peak pressure of this contact; infinite where it is held at a corner, or where the slope
        jumps.
    kappa_is_default : bool
        True if κ was left at its default of 1: then the stiffness may be missing.
    """

    end: float
    carried: float
    load: float
    half_width: float
    peak: float
    kappa_is_default: bool


class HalfWidthTooLargeError(SolveError):
    """A contact of the half-width asked for reaches beyond a body.

    Attributes
    ----------
    wanted : float
        The half-width asked for.
    half_width : float
        The half-width of the largest contact that stays on the bodies.
    end : float
        End of the bodies that this largest contact reaches.
    load : float
        Load that it carries.
    peak : float
        Its peak pressure; infinite where it is held at a corner, or where the slope jumps; NaN of
        bodies with a layer or another kernel, whose contact is about the largest.
    kappa_is_default : bool
        True if κ was left at its default of 1: then the stiffness may be missing.
    """

    wanted: float
    half_width: float
    end: float
    load: float
    peak: float
    kappa_is_default: bool


class NoEquilibriumError(SolveError):
    """No position of a contact balances the pressures at its two edges, for some half-width.

    Attributes
    ----------
    half_width : float
        Half-width tried last: the one asked for, if one is.
    near : float
        Point of first contact.
    """

    half_width: float
    near: float


class OverflowError(SolveError):
    """The forces on a contact are beyond the range of the number type.

    Attributes
    ----------
    interval : tuple[float, float]
        The contact.
    """

    interval: tuple[float, float]


class BudgetSpentError(SolveError):
    """The search has spent its budget of evaluations.

    Attributes
    ----------
    evaluations : int
        Evaluations of the curves, or values of the slope of the gap, by then.
    budget : int
        Largest number allowed: 2²⁰ and 1024 for each piece of the bodies. `Midpoint` keeps no
        samples: sixteen times this number, plus the evaluations of 4096 pressures.
    last : tuple[float, float]
        The span of `x` sampled last.
    """

    evaluations: int
    budget: int
    last: tuple[float, float]


class LimitSearchError(SolveError):
    """The search for the limits gave up.

    Attributes
    ----------
    best : tuple[float, float]
        The best limits so far.
    source : SearchError
        Error of the search, in terms of the half-width or the distance from the point of first
        contact.
    """

    best: tuple[float, float]
    source: SearchError


class EdgePressureNotMetError(SolveError):
    """The limits are as accurate as the numbers allow, but Eq. (6) is not met.

    Attributes
    ----------
    best : tuple[float, float]
        The best limits.
    at_a : float
        Residual of Eq. (6) at `a`: `P(a - ε_a) - A`.
    at_b : float
        Residual of Eq. (6) at `-b`: `P(ε_b - b) - B`.
    """

    best: tuple[float, float]
    at_a: float
    at_b: float


class TensionError(SolveError):
    """The bodies would have to pull at each other inside the contact: they part there.

    Attributes
    ----------
    x : float
        Abscissa at which the pressure is negative.
    pressure : float
        Pressure there; minus infinity where the slope of the gap jumps down.
    interval : tuple[float, float]
        Solution of the equations with this pressure: the interval from the first limit to the last.
    load : float
        Load per unit length of this solution.
    """

    x: float
    pressure: float
    interval: tuple[float, float]
    load: float


class LiftsOffError(SolveError):
    """The body lifts off at a fixed edge: the singularity of the pressure there is negative, or the
    contact ends before the corner.

    Attributes
    ----------
    x : float
        Abscissa of the corner.
    strength : float
        Strength K of the singularity, see `Solution.edge_singularities`: zero to rounding where the
        contact ends before the corner.
    interval : tuple[float, float]
        Contact that solves the equations with this strength.
    load : float
        Load per unit length of this contact.
    """

    x: float
    strength: float
    interval: tuple[float, float]
    load: float


class OverlapError(SolveError):
    """The bodies would overlap outside the contact: they touch there as well.

    Attributes
    ----------
    x : float
        Abscissa of the overlap.
    gap : float
        Gap there, negative.
    interval : tuple[float, float]
        Solution of the equations with this overlap: the interval from the first limit to the last.
    load : float
        Load per unit length of this solution.
    """

    x: float
    gap: float
    interval: tuple[float, float]
    load: float


class FeatureMissedError(SolveError):
    """The slope of the gap inside the contact differs from the panels by which the contact was
    found: a feature lies between two of their samples.

    Attributes
    ----------
    x : float
        Abscissa of the difference.
    slope : float
        Slope of the gap.
    assumed : float
        Slope according to the panels.
    """

    x: float
    slope: float
    assumed: float


class UnbalancedError(SolveError):
    """The samples of the certificate give the pressure a singularity at a free edge that the found
    contact does not have: the limits were found from a part of the curves only.

    Attributes
    ----------
    x : float
        Abscissa of the limit.
    strength : float
        Strength K of the inverse-square-root singularity there, a pressure.
    allowed : float
        Largest strength that the estimated errors of the limits and of the samples allow.
    """

    x: float
    strength: float
    allowed: float


class UndecidedError(SolveError):
    """The certificate has spent its budget, or the limits are too doubtful for one.

    Attributes
    ----------
    x : float
        Abscissa at which the certificate has stopped.
    evaluations : int
        Evaluations of the curves by then.
    samples : int
        Values of the slope of the gap by then.
    """

    x: float
    evaluations: int
    samples: int


class TiltNotFoundError(SolveError):
    """No tilt makes the load act at the place asked for: the contact would leave the bodies.

    Attributes
    ----------
    load : float
        Load per unit length asked for.
    at : float
        Place where the load was to act: `x₀ + M/F`.
    reached : float
        Nearest place at which a contact was found that carries the load.
    tilt : float
        The tilt of that contact.
    ends : tuple[float, float]
        Ends of the bodies.
    """

    load: float
    at: float
    reached: float
    tilt: float
    ends: tuple[float, float]


class PullOffError(SolveError):
    """The bodies come apart: the tensile load exceeds the adhesion.

    Attributes
    ----------
    load : float
        Load per unit length asked for.
    least : float
        The least load under which a contact was found: less than about a thousandth more, and the
        bodies come apart.
    """

    load: float
    least: float


class PeakTooHighError(SolveError):
    """The contact with this peak pressure reaches beyond a body or a corner.

    Attributes
    ----------
    wanted : float
        The peak pressure asked for.
    half_width : float
        Largest half-width that there is room for.
    found : float
        Peak pressure of the contact with this half-width.
    end : float
        End of the bodies, or the corner, that this contact reaches.
    load : float
        The load that it carries.
    kappa_is_default : bool
        True if κ was left at its default of 1: then the stiffness may be missing.
    """

    wanted: float
    half_width: float
    found: float
    end: float
    load: float
    kappa_is_default: bool


class NoPeakError(SolveError):
    """No contact is found with this peak pressure.

    Attributes
    ----------
    wanted : float
        The peak pressure asked for.
    half_width : float
        The half-width tried last.
    found : float
        Peak pressure there; infinite where the slope of a body jumps, NaN where no contact was
        found.
    """

    wanted: float
    half_width: float
    found: float


class InJumpError(SolveError):
    """The value asked for lies in a jump: a contact arises outside the others, a corner is reached,
    or even the lightest load gives more.

    Attributes
    ----------
    wanted : float
        The half-width, peak pressure or approach asked for.
    load : float
        Load at which the quantity jumps.
    below : float
        Value under smaller loads; 0 where there is none.
    above : float
        Value under larger loads; infinite where the pressure is.
    """

    wanted: float
    load: float
    below: float
    above: float


class LoadUnknownError(SolveError):
    """Corners hold the limits, or nearly: x is too coarse to tell the load from the half-width.

    Attributes
    ----------
    half_width : float
        The half-width asked for.
    load : float
        One of the loads under which the contact has this half-width.
    """

    half_width: float
    load: float


class ApproachTooLargeError(SolveError):
    """No contact that stays on the bodies has this approach.

    Attributes
    ----------
    wanted : float
        The approach asked for.
    approach : float
        Approximate largest approach of a contact that stays on the bodies.
    load : float
        Load at this approach.
    """

    wanted: float
    approach: float
    load: float


class FallsError(SolveError):
    """The quantity falls while the load grows, before it has the value asked for, so that it does
    not determine the load.

    Attributes
    ----------
    quantity : str
        The quantity that is given: an approach.
    load : float
        Least load known under which it falls.
    rate : float
        Its derivative by the load there, negative or zero.
    """

    quantity: str
    load: float
    rate: float


class ToleranceNotReachedError(SolveError):
    """A table of springs with as many points as it may have is less exact than its tolerance.

    Attributes
    ----------
    tolerance : float
        Tolerance as given, a share.
    reached : float
        Error that is left, a share: a tolerance that can be reached.
    """

    tolerance: float
    reached: float


class LoadBeyondSlicesError(SolveError):
    """The load of a roller acts beyond its slices: no pressure between them has this moment.

    Attributes
    ----------
    load : float
        Load on the roller, a force.
    at : float
        Place along the axis at which it acts, moment over load: a length.
    ends : tuple[float, float]
        Middles of the first and the last slice.
    """

    load: float
    at: float
    ends: tuple[float, float]


class LoadBeyondBodiesError(SolveError):
    """The load acts beyond the bodies: no pressure between them has this moment.

    Attributes
    ----------
    load : float
        Load per unit length.
    at : float
        Place at which it acts: `x₀ + M/F`.
    ends : tuple[float, float]
        Ends of the bodies.
    """

    load: float
    at: float
    ends: tuple[float, float]


class OneSliceError(SolveError):
    """A single slice of a roller bears the load: then the moment does not determine the
    misalignment.

    Attributes
    ----------
    z : float
        Place of this slice along the axis: a length.
    """

    z: float


class RollerNotFoundError(SolveError):
    """The approach or the misalignment of a roller under its load was not found.

    Attributes
    ----------
    source : SearchError
        Error of the search, in terms of the approach of the slice that is pressed most, or of the
        misalignment.
    """

    source: SearchError


class SlipsEverywhereError(SolveError):
    """The force exceeds friction: the bodies slip everywhere.

    Attributes
    ----------
    force : float
        Tangential force Q.
    limit : float
        Largest force that friction carries, μF.
    """

    force: float
    limit: float


class SticksEverywhereError(SolveError):
    """The force is so small, relative to friction, that the slip zones and their traction are lost
    in rounding.

    Without slip the traction is Q ∂P/∂F, see `Solution.load_rates`.

    Attributes
    ----------
    force : float
        Tangential force Q.
    limit : float
        Largest force that friction carries, μF.
    """

    force: float
    limit: float


class ReversedSlipError(SolveError):
    """The bodies would stick outside the contact.

    With such a large tension, or such a small force, slip reverses while the force grows, and the
    history counts.

    Attributes
    ----------
    zone : tuple[float, float]
        Zone in which the bodies would stick.
    contact : tuple[float, float]
        Contact nearest to this zone.
    """

    zone: tuple[float, float]
    contact: tuple[float, float]


class SingularError(EvaluationError):
    """A quantity was asked for where the pressure is infinite: at a fixed or adhesive edge, at an
    edge where Eq. (6) has left a singularity, or where the slope of a body jumps.

    Attributes
    ----------
    x : float
        Abscissa asked for.
    """

    x: float


class AboveSurfaceError(EvaluationError):
    """A point is above the surface, or not finite.

    Attributes
    ----------
    x : float
        Abscissa.
    depth : float
        Depth below the surface.
    """

    x: float
    depth: float


class NoStressError(EvaluationError):
    """There is no elastic material at some depths.

    Attributes
    ----------
    depths : tuple[float, float]
        Depths asked for, twice the same if it is one.
    """

    depths: tuple[float, float]


class OutsideTableError(EvaluationError):
    """The table of a spring does not cover this approach.

    Attributes
    ----------
    approach : float
        Approach as given.
    range : tuple[float, float]
        Least and largest approach of the points of the table.
    """

    approach: float
    range: tuple[float, float]


class SliceOutsideTableError(EvaluationError):
    """The table of a spring does not cover the slice of a roller that is pressed most.

    Attributes
    ----------
    z : float
        Place of the slice along the axis, from the middle of the roller: a length.
    approach : float
        Approach of this slice, the largest of all.
    range : tuple[float, float]
        Least and largest approach of the points of the table.
    """

    z: float
    approach: float
    range: tuple[float, float]


class InvalidPositionError(EvaluationError):
    """A point is not inside the contact, or not outside it, as required.

    Attributes
    ----------
    x : float
        Abscissa of the point.
    inside : bool
        True if the point must be strictly inside.
    interval : tuple[float, float]
        Contact.
    """

    x: float
    inside: bool
    interval: tuple[float, float]


class HalfPlanesOnlyError(EvaluationError):
    """The formula of a quantity is for half-planes, and the bodies have layers, a period or another
    kernel.

    Attributes
    ----------
    quantity : str
        Name of the quantity.
    """

    quantity: str


class NoLoadDerivativeError(EvaluationError):
    """The derivatives of the contact by the load are not known.

    Attributes
    ----------
    why : str
        Reason, for the message.
    """

    why: str


class NoUncertaintyError(EvaluationError):
    """The uncertainty by the noise of measured points is not known.

    Attributes
    ----------
    why : str
        Reason, for the message.
    """

    why: str


class LengthMismatchError(EvaluationError):
    """The number of places for pressures is not the number of abscissae.

    Attributes
    ----------
    x : int
        Number of abscissae.
    pressures : int
        Number of places for pressures.
    """

    x: int
    pressures: int


class IntegralError(EvaluationError):
    """An integral over the pressure has not converged.

    Attributes
    ----------
    x : float
        Abscissa for which the integral was taken.
    panels : int
        Number of panels tried.
    """

    x: float
    panels: int


class UnresolvedError(EvaluationError):
    """The quadrature has no correct digit of the pressure: `x` is too close to an edge for its
    segments.

    Attributes
    ----------
    x : float
        Abscissa asked for.
    pressure : float
        Pressure by the quadrature.
    error : float
        Estimated error of this pressure.
    """

    x: float
    pressure: float
    error: float


class ProfileParameterError(InputError):
    """A parameter has a value for which the shape does not exist.

    Attributes
    ----------
    name : str
        Name of the parameter.
    value : float
        Value of the parameter.
    must : str
        Condition on the parameter.
    """

    name: str
    value: float
    must: str


class ProfileJoinedError(InputError):
    """A profile has several pieces where a smooth one is required.

    Attributes
    ----------
    pieces : int
        Number of pieces.
    """

    pieces: int


class ProfileDomainError(InputError):
    """The range of `k` is empty, reversed, or not finite.

    Attributes
    ----------
    from_ : float
        Start of the range.
    to : float
        End of the range.
    """

    from_: float
    to: float


class ProfileNotFiniteError(InputError):
    """The curve returned NaN or an infinity.

    Attributes
    ----------
    quantity : str
        Name of the quantity: `X`, `Y`, `X'`, `Y'`, the slope `Y'/X'` or `slope_at(x)`.
    k : float
        Parameter of the point.
    value : float
        Value of the quantity there.
    """

    quantity: str
    k: float
    value: float


class ProfileDerivativeError(InputError):
    """A derivative does not match its function.

    Attributes
    ----------
    quantity : str
        Name of the derivative: `X'`, `Y'` or `slope_at(x)`.
    k : float
        Parameter of the point.
    given : float
        Derivative given by the profile.
    difference : float
        Derivative by differences.
    """

    quantity: str
    k: float
    given: float
    difference: float


class ProfileTurnsBackError(InputError):
    """`X` does not rise, or fall, all the way.

    Attributes
    ----------
    k : float
        Parameter of the turning point, as closely as it was found.
    x : float
        `X` there.
    domain : tuple[float, float]
        Domain of the curve.
    """

    k: float
    x: float
    domain: tuple[float, float]


class ProfilePiecesError(InputError):
    """A compound profile does not have the pieces that it declares.

    Attributes
    ----------
    count : int
        Number of pieces declared.
    index : int
        Index of a faulty piece.
    """

    count: int
    index: int


class PiecewiseInPieceError(InputError):
    """A piece is faulty by itself.

    Attributes
    ----------
    piece : int
        Number of the piece, from 1, left to right.
    source : LineContactError
        Fault of the piece.
    """

    piece: int
    source: LineContactError


class PiecewiseInSegmentError(InputError):
    """A segment of an `Outline` cannot be drawn.

    Attributes
    ----------
    segment : int
        Number of the line or arc, as drawn, from 1; of the half to which it belongs.
    source : LineContactError
        Fault of the segment, or of the corner in front of it.
    """

    segment: int
    source: LineContactError


class PiecewiseToleranceError(InputError):
    """The tolerance is negative, NaN or infinite.

    Attributes
    ----------
    tolerance : float
        The tolerance as given.
    """

    tolerance: float


class PiecewiseNoPiecesError(InputError):
    """There are no pieces."""


class PiecewiseGapError(InputError):
    """Two neighbours do not meet: `x` between them belongs to neither.

    Attributes
    ----------
    breakpoint : int
        Number of the breakpoint, 1 between the first two pieces.
    left : float
        Right end of the left piece.
    right : float
        Left end of the right piece.
    share : float
        Their difference, as a share of what the tolerance is one of.
    """

    breakpoint: int
    left: float
    right: float
    share: float


class PiecewiseOverlapError(InputError):
    """Two neighbours overlap: `x` between them belongs to both.

    Pieces in the wrong order overlap too.

    Attributes
    ----------
    breakpoint : int
        Number of the breakpoint, 1 between the first two pieces.
    left : float
        Right end of the left piece.
    right : float
        Left end of the right piece.
    share : float
        Their difference, as a share of what the tolerance is one of.
    """

    breakpoint: int
    left: float
    right: float
    share: float


class PiecewiseJumpError(InputError):
    """Two neighbours meet at different heights.

    Attributes
    ----------
    breakpoint : int
        Number of the breakpoint, 1 between the first two pieces.
    x : float
        Abscissa of the breakpoint.
    left : float
        `Y` at the end of the left piece.
    right : float
        `Y` at the start of the right piece.
    share : float
        Their difference, as a share of what the tolerance is one of.
    """

    breakpoint: int
    x: float
    left: float
    right: float
    share: float


class SplineTooFewError(InputError):
    """There are too few points.

    Attributes
    ----------
    points : int
        Number of points.
    """

    points: int


class SplineNotFiniteError(InputError):
    """A coordinate is NaN or infinite.

    Attributes
    ----------
    row : int
        Row of the point.
    x : float
        x of the point.
    y : float
        y of the point.
    """

    row: int
    x: float
    y: float


class SplineDuplicateError(InputError):
    """Two neighbours have equal x, or x so close that their distance is lost.

    Attributes
    ----------
    row : int
        Row of the second point.
    x : float
        x of both points.
    """

    row: int
    x: float


class SplineUnsortedError(InputError):
    """x falls from one point to the next.

    Attributes
    ----------
    row : int
        Row of the second point.
    x : float
        x of the second point.
    before : float
        x of the row before.
    """

    row: int
    x: float
    before: float


class SplineOutlierError(InputError):
    """A point is off the curve through its neighbours.

    Attributes
    ----------
    row : int
        Row of the point, the one that is furthest off.
    x : float
        x of the point.
    y : float
        y of the point.
    expected : float
        `Y` at this x on the cubic through its four neighbours.
    deviations : float
        Distance of the point from this cubic, in standard deviations.
    """

    row: int
    x: float
    y: float
    expected: float
    deviations: float


class SplinePeriodError(InputError):
    """A period is not a positive finite number, or its end is not behind the last point, or far
    behind it: a part of the period is not measured.

    Attributes
    ----------
    period : float
        Period as given; 0 of a body that is turned.
    first : float
        x of the first point.
    last : float
        x of the last point.
    """

    period: float
    first: float
    last: float


class SplineLimitError(InputError):
    """The limit for outliers is not positive.

    Attributes
    ----------
    deviations : float
        The limit as given.
    """

    deviations: float


class SplineOverflowError(InputError):
    """The curve up to a point is beyond the range of the number type.

    Attributes
    ----------
    row : int
        Row of the point.
    x : float
        x of the point.
    before : float
        x of the row before.
    """

    row: int
    x: float
    before: float


class SearchBracketError(SearchError):
    """The bracket has a NaN or infinite end, or its ends are the wrong way round.

    Attributes
    ----------
    lo : float
        Lower end as given.
    hi : float
        Upper end as given.
    """

    lo: float
    hi: float


class SearchNoSignChangeError(SearchError):
    """The function has the same sign at both ends.

    Attributes
    ----------
    lo : float
        Lower end.
    hi : float
        Upper end.
    f_lo : float
        Value at the lower end.
    f_hi : float
        Value at the upper end.
    """

    lo: float
    hi: float
    f_lo: float
    f_hi: float


class SearchNotFiniteError(SearchError):
    """The function returned NaN or an infinity.

    Attributes
    ----------
    x : float
        Point of the evaluation.
    value : float
        Value returned.
    """

    x: float
    value: float


class SearchBudgetError(SearchError):
    """The evaluations ran out.

    Attributes
    ----------
    best : tuple of float and int
        Best point so far: its abscissa, the residual there, and the number of evaluations.
    """

    best: tuple[float, float, int]


class SearchLeftBracketError(SearchError):
    """A strategy has evaluated, or returned, a point outside the bracket it was given.

    Attributes
    ----------
    x : float
        Point outside the bracket.
    lo : float
        Lower end of the bracket.
    hi : float
        Upper end of the bracket.
    """

    x: float
    lo: float
    hi: float


class SearchNotConvergedError(SearchError):
    """A strategy has stopped where the function is still far from zero.

    Attributes
    ----------
    x : float
        Point returned.
    residual : float
        Value of the function there.
    """

    x: float
    residual: float


class SearchToleranceError(SearchError):
    """A tolerance is negative, NaN or infinite.

    Attributes
    ----------
    value : float
        The tolerance as given.
    """

    value: float
